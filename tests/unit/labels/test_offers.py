"""Labels that are there to be taken, told without reading assets."""

from __future__ import annotations

from pathlib import Path

import pytest

from meshforge.labels import OfferCache
from meshforge.symbolic import SymbolicMesh
from tests.unit.project.tables import FIRST, SECOND, THIRD, fresh, labelled


def test_labels_files_are_offered_until_they_are_taken(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    assert OfferCache().of(project).files == (FIRST, SECOND, THIRD)
    project.label("file")
    assert OfferCache().of(project).files == ()


def test_a_file_is_offered_again_when_it_says_something_else(tmp_path: Path) -> None:
    project, offers = labelled(tmp_path), OfferCache()
    assert offers.of(project).files == ()
    file = tmp_path / "assets" / SECOND.replace(".obj", ".labels.json")
    file.write_text(file.read_text().replace('"crumb": "misc"', '"crumb": "leg"'))
    assert offers.of(project).files == (SECOND,)


def test_what_a_person_said_is_not_offered_to_be_overwritten(tmp_path: Path) -> None:
    project, offers = labelled(tmp_path), OfferCache()
    project.set_labels(FIRST, {"crumb": "leg"})
    assert offers.of(project).files == ()
    project.set_labels(FIRST, {"crumb": None})
    assert offers.of(project).files == (FIRST,)


def test_a_labels_file_that_is_damaged_is_offered_and_says_so_when_it_is_taken(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    (tmp_path / "assets" / FIRST.replace(".obj", ".labels.json")).write_text("{")
    assert OfferCache().of(project).files == (FIRST,)


def test_only_the_assets_that_are_asked_for_count(tmp_path: Path) -> None:
    assert OfferCache().of(fresh(tmp_path), {SECOND}).files == (SECOND,)


def test_offers_follow_labels_and_vocabulary(tmp_path: Path) -> None:
    project, offers = fresh(tmp_path), OfferCache()
    assert offers.of(project).names == {}
    project.set_vocabulary(["crumb"])
    assert offers.of(project).names[FIRST] == {"crumb": "crumb"}
    project.set_labels(FIRST, {"crumb": "crumb"})
    assert set(offers.of(project).names) == {SECOND, THIRD}


def test_assets_are_not_read_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made = fresh(tmp_path)
    before = OfferCache().of(made)

    def read(*_: object) -> SymbolicMesh:
        raise AssertionError("an asset was read")

    monkeypatch.setattr("meshforge.formats.read", read)
    monkeypatch.setattr("meshforge.batch.read_prepared", read)
    assert OfferCache().of(made) == before
