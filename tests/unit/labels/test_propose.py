"""What would be taken is shown as it is taken then, and nothing is written by that. Labels that are there to be taken,
told without reading assets."""

from pathlib import Path

import pytest

from meshforge.labels import NameLabeler, OfferCache, Proposal, Proposals
from meshforge.project import Project
from meshforge.symbolic import SymbolicMesh
from tests.unit.batch.families import tree
from tests.unit.labels.test_label_by_names import named
from tests.unit.project.tables import FIRST, SECOND, THIRD, fresh, labelled


def test_names_are_put_together_by_label_and_by_what_says_so(tmp_path: Path) -> None:
    project = named(tmp_path, "door", "leg", base=("door1", "leg1", "leg2", "drr", "x"), oak_door=("a", "b"))
    assert project.label(NameLabeler([("x", "")]), dry_run=True).proposals == Proposals(
        rows=(
            Proposal("door", "body", ("oak_door",), 2, 1, 0.6, 0.6),
            Proposal("door", "hull", ("door1",), 1, 1, 0.7, 0.7),
            Proposal("leg", "hull", ("leg1", "leg2"), 2, 1, 0.7, 0.7),
        ),
        left=(
            Proposal(None, "hull by pattern", ("x",), 1, 1, 0.0, 0.0),
            Proposal(None, "nothing said", ("drr",), 1, 1, 0.0, 0.0),
        ),
    )


def test_what_is_less_sure_has_a_row_of_its_own(tmp_path: Path) -> None:
    project = named(tmp_path, "drawer", base=("drawr1", "drwr"))
    sure, unsure = project.label("names", dry_run=True).proposals.rows
    assert (sure.kind, sure.names, sure.is_unsure) == ("hull nearly", ("drwr",), False)
    assert (unsure.kind, unsure.names, unsure.is_unsure) == ("hull nearly", ("drawr1",), True)


def numbers(rows: tuple[Proposal, ...]) -> int:
    return sum(row.hulls for row in rows)


def test_what_names_propose_is_what_is_taken_then(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    project.set_vocabulary(["top", "leg", "crumb"])
    project.set_labels(FIRST, {"top": "leg", "crumb": "crumb"})
    before = tree(project.folder / "labels")
    shown = project.label(NameLabeler([("left_*", "leg")]), dry_run=True).proposals
    assert tree(project.folder / "labels") == before
    reports = project.label(NameLabeler([("left_*", "leg")])).outcomes
    assert numbers(shown.rows) == sum(report.taken for report in reports) == 10
    assert numbers(shown.left) == sum(report.unlabelled for report in reports)
    assert shown.labelled == 2


def test_what_files_propose_is_what_is_taken_then_and_another_vocabulary_may_be_tried(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    project.set_vocabulary(["top", "leg", "misc"])
    project.set_labels(SECOND, {"top": "leg"})
    before = tree(project.folder / "labels")
    shown = project.label("file", dry_run=True).proposals
    other = project.label("file", vocabulary=["top"], dry_run=True).proposals
    assert tree(project.folder / "labels") == before
    assert [row.label for row in shown.rows] == ["top", "leg", "misc"] and not shown.problems
    assert shown.labelled == 1
    reports = project.label("file").outcomes
    assert numbers(shown.rows) == sum(report.taken for report in reports)
    assert [row.label for row in other.rows] == ["top"]
    assert f"{THIRD}: left_low: the label 'leg' is not in the vocabulary" in other.problems
    again = project.label("file", dry_run=True).proposals
    assert not again.rows and not again.left and again.labelled == 18


def test_a_project_without_vocabulary_shows_that_of_the_files_and_stays_without(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    assert {row.label for row in project.label("file", dry_run=True).proposals.rows} == {"top", "leg", "misc"}
    assert Project.open(project.folder).vocabulary == ()


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
