from collections.abc import Iterator
from pathlib import Path

import pytest

from meshforge.batch import read_prepared
from meshforge.common import AssetError, ProjectError
from meshforge.project import Project
from meshforge.store import MeshCache
from meshforge.studio.queries.project import build_card
from meshforge.studio.thumbnails import Thumbnails
from meshforge.studio.workers import Workers
from tests.unit.project.tables import FIRST, SECOND, labelled


@pytest.fixture
def workers() -> Iterator[Workers]:
    made = Workers(1)
    yield made
    made.close()


def cached(project: Project, workers: Workers) -> Project:
    return project.with_cache(MeshCache(lambda path, prepared: workers.run(read_prepared, path, prepared), 4))


def test_an_asset_is_read_once_and_its_labels_are_followed(tmp_path: Path, workers: Workers) -> None:
    bare = labelled(tmp_path)
    project = cached(bare, workers)
    first = project.mesh(FIRST)
    assert first.contacts == bare.mesh(FIRST).contacts
    assert project.mesh(FIRST) is first
    project.set_labels(FIRST, {"crumb": "leg"})
    second = project.mesh(FIRST)
    assert second.hull_of("crumb").label == bare.mesh(FIRST).hull_of("crumb").label == "leg"
    assert all(a.shape is b.shape for a, b in zip(first.hulls, second.hulls, strict=True))


def test_a_file_that_changed_is_read_again(tmp_path: Path, workers: Workers) -> None:
    project = cached(labelled(tmp_path), workers)
    before = len(project.mesh(FIRST).hulls)
    text = project.path(FIRST).read_text()
    project.path(FIRST).write_text(text[: text.index("o crumb")])
    assert len(project.mesh(FIRST).hulls) == before - 1
    project.cut(FIRST, "top", (1, 0.5, 1), (1, 0, 0))
    assert len(project.mesh(FIRST).hulls) == before
    project.path(FIRST).write_text("v broken")
    with pytest.raises(AssetError, match=r"model\.obj"):
        project.mesh(FIRST)
    project.path(FIRST).write_text(text)
    project.unprepare(FIRST)
    assert len(project.mesh(FIRST).hulls) == before


def test_a_picture_is_drawn_of_what_its_digest_says_or_not_at_all(tmp_path: Path, workers: Workers) -> None:
    project = labelled(tmp_path)
    (row,) = project.status([FIRST]).assets
    settings = project.settings
    shown = build_card(row, settings.vocabulary, settings.orient)
    pictures = Thumbnails(tmp_path / "pictures", workers)
    assert shown.picture
    drawn = pictures.get(project, FIRST, "source", shown.picture).result(60)
    assert drawn.startswith(b"\x89PNG")
    assert (tmp_path / "pictures" / f"{shown.picture}.png").read_bytes() == drawn
    with pytest.raises(ProjectError, match="no such picture"):
        pictures.get(project, SECOND, "source", "0" * 32).result(60)
    assert len(list((tmp_path / "pictures").iterdir())) == 1
