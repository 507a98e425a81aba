"""What the page is told of assets that came after the others were prepared."""

from pathlib import Path

import pytest

from meshforge.project import Project
from meshforge.studio.session import refresh
from meshforge.studio.session.refresh import NewAssetsQuery
from meshforge.studio.wire.family import Card
from tests.mesh_files import ROOM

PLAN = '{"version": 1, "decomposed": null, "rebuilt": ["a.obj"], "min_confidence": 0.7}'


@pytest.fixture
def project(tmp_path: Path) -> Project:
    for name in ("a", "b"):
        (tmp_path / f"{name}.obj").write_text(ROOM)
    return Project.create(tmp_path / "p", [tmp_path / "*.obj"])


def test_nothing_is_new_where_nothing_was_prepared(project: Project) -> None:
    assert NewAssetsQuery().find(project, ()) == (None, None)


def test_new_assets_are_named_with_what_becomes_of_them(project: Project) -> None:
    project.layout.preparation_plan.write_text(PLAN)
    new, damage = NewAssetsQuery().find(project, ())
    assert new and damage is None
    assert (new.ids, new.rebuilt, new.min_confidence, new.unclear) == (("b.obj",), 1, 0.7, None)


def test_a_damaged_file_is_the_reason_that_nothing_can_be_applied(project: Project) -> None:
    project.layout.preparation_plan.write_text("{")
    new, damage = NewAssetsQuery().find(project, ())
    assert new is None and damage and "preparation.json" in damage


def test_preparations_are_read_again_only_where_one_changed(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    asked = list[Project]()

    def count(store: Project) -> tuple[list[object], None]:
        asked.append(store)
        return [], None

    monkeypatch.setattr(refresh, "list_new", count)
    query, bare = NewAssetsQuery(), [Card(asset="a.obj")]
    done = [Card(asset="a.obj", prepared=("decomposed",))]
    for cards, times in ((bare, 1), (bare, 1), (done, 2), (done, 2), (bare, 3)):
        query.find(project, cards)
        assert len(asked) == times
    project.layout.preparation_plan.write_text(PLAN)
    query.find(project, bare)
    assert len(asked) == 4
