"""How far a project is labelled, in counts."""

from pathlib import Path

from meshforge.labels import NameContradiction, SourceTally
from meshforge.project import Project
from tests.unit.batch.families import table_boxes
from tests.unit.labels.test_label_by_propagation import family

NAMES = tuple(table_boxes())


def test_labels_are_counted_by_source_and_confidence(tmp_path: Path) -> None:
    project = family(tmp_path, 3)
    project.set_labels("t0.obj", {"top": "top", "crumb": "misc"})
    project.set_labels("t1.obj", {"top": "top"}, source="vlm", confidence=0.95)
    project.set_labels("t1.obj", {"crumb": "leg"}, source="vlm", confidence=0.49)
    (tmp_path / "assets/t2.obj").write_text("nothing of use")
    found = Project.open(tmp_path / "p").tally_labels()
    assert found.shares == (SourceTally("vlm", 1, 0, 1), SourceTally("user", 2, 0, 0))
    assert (found.hulls, found.unlabelled) == (2 * len(NAMES), 2 * len(NAMES) - 4)
    assert found.doubtful == (("t1.obj", len(NAMES) - 1), ("t0.obj", len(NAMES) - 2))


def test_an_empty_project_of_labels_has_nothing_but_bare_hulls(tmp_path: Path) -> None:
    found = family(tmp_path, 1).tally_labels()
    assert found.shares == ()
    assert found.unlabelled == found.hulls == len(NAMES)


def test_labels_that_names_speak_against_are_listed_but_not_those_of_people(tmp_path: Path) -> None:
    project = family(tmp_path, 2)
    project.set_labels("t0.obj", {"top": "leg"})
    project.set_labels("t1.obj", {"top": "leg", "crumb": "misc"}, source="vlm", confidence=0.9)
    assert project.tally_labels().contradictions == (NameContradiction("t1.obj", "top", "leg", "top", "top"),)


def test_a_wrong_pattern_of_the_settings_hinders_no_count(tmp_path: Path) -> None:
    family(tmp_path, 1)
    with (tmp_path / "p/meshforge.toml").open("a") as settings:
        settings.write('\n[names]\n"*top*" = "nothing of the vocabulary"\n')
    assert Project.open(tmp_path / "p").tally_labels().hulls == len(NAMES)
