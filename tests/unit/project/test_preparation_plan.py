import json
from pathlib import Path

import pytest

from meshforge.batch import IN_PROCESS
from meshforge.common import ProjectError
from meshforge.geometry import VhacdSettings
from meshforge.project import Project, forget_plan, read_preparation_plan
from meshforge.project.preparation_plan import extend_plan, find_new_assets
from tests.unit.project.stools import boxes, create_stools, write_stool

QUICK = VhacdSettings(resolution=1000)


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    """Two stools of hulls."""
    monkeypatch.setenv("MESHFORGE_CACHE", str(tmp_path / "cache"))
    return create_stools(tmp_path, {"a": (0.2, 0.4), "b": (0.22, 0.4)}, spanning="ab")


def write_record(project: Project, asset: str, *steps: dict[str, object]) -> None:
    """A preparation of an asset with decompositions by these settings, which replaced nothing that is there."""
    path = project.layout.preparation(asset) / "preparation.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    rows = [{"do": "decompose", "settings": own, "software": {}, "replaced": []} for own in steps]
    path.write_text(json.dumps({"steps": rows}))


def settings(**more: object) -> dict[str, object]:
    return {"method": "vhacd", "hollow": False, **QUICK.as_dict(), "by": "whole", **more}


def add(project: Project, name: str) -> Project:
    parts = boxes(0.19, 0.4)
    return project.add_assets([write_stool(project.folder.parent / "assets", name, parts, parts)])


def test_nothing_is_planned_where_nothing_was_prepared(project: Project) -> None:
    plan = read_preparation_plan(project)
    assert (plan.decompose, plan.rebuild, plan.unclear) == ((), None, None)
    assert find_new_assets(add(project, "c")) == ({}, None)


def test_the_decomposition_on_which_all_assets_agree_is_planned(project: Project) -> None:
    write_record(project, "a.urdf", settings(by="parts"), settings(by="parts"), settings(only=["top*"]))
    write_record(project, "b.urdf", settings(by="parts"), settings(only=["top*"]))
    plan = read_preparation_plan(project)
    assert [(one.settings, one.only, one.by) for one in plan.decompose] == [
        (QUICK, (), "parts"),
        (QUICK, ("top*",), "whole"),
    ]
    assert plan.unclear is None


def test_no_decomposition_is_planned_where_assets_differ(project: Project) -> None:
    write_record(project, "a.urdf", settings())
    write_record(project, "b.urdf", settings(resolution=2000))
    plan = read_preparation_plan(project)
    assert plan.decompose == () and plan.unclear is not None
    assert "in 2 ways, so new ones are not decomposed (a.urdf; b.urdf)" in plan.unclear


@pytest.mark.parametrize("option", [{"wobble": 3}, {"by": "labels"}])
def test_options_of_another_version_are_not_guessed(project: Project, option: dict[str, object]) -> None:
    write_record(project, "a.urdf", settings(**option))
    plan = read_preparation_plan(project)
    assert plan.decompose == () and plan.unclear is not None and "another version" in plan.unclear


def test_assets_that_come_later_are_new_until_they_are_done(project: Project) -> None:
    write_record(project, "a.urdf", settings())
    list(project.decompose(settings=QUICK, execution=IN_PROCESS))
    later = add(project, "c")
    found, unclear = find_new_assets(later)
    assert list(found) == ["c.urdf"] and found["c.urdf"].decompose[0].settings == QUICK and unclear is None
    extend_plan(later, ["c.urdf"], decomposed=True, rebuilt=True)
    assert find_new_assets(later) == ({}, None)
    forget_plan(later)
    assert find_new_assets(Project.open(project.folder)) == ({}, None)


def test_a_damaged_plan_is_named(project: Project) -> None:
    project.layout.preparation_plan.write_text('{"min_confidence": "often"}')
    with pytest.raises(ProjectError, match=r"preparation\.json"):
        find_new_assets(project)
