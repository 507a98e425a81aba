"""What a person did on a hull survives that hull's split, and comes back when the split is undone."""

from __future__ import annotations

import shutil
from pathlib import Path

from meshforge import batch
from meshforge.formats import read
from meshforge.language import Merge
from meshforge.project import Project
from meshforge.project.prepare import exchange_preparation
from meshforge.project.selections import Successors
from meshforge.symbolic import Label
from meshforge.synthesis import Answer, LabelCorrection
from tests.unit.batch.families import tree
from tests.unit.deaths import deaths, needs_fork
from tests.unit.project.tables import FIRST, LEGS, applied

KEPT = ("labels/", "demonstrations/", "corrections/", "answers.json", "prepared/")
PARTS = {"crumb#0", "crumb#1"}
PLANE = ((5.05, 5.05, 5.05), (0, 0, 1))


def kept(project: Project) -> dict[str, bytes]:
    files = tree(project.folder).items()
    return {name: data for name, data in files if name.startswith(KEPT) and not name.endswith(".tmp")}


def said(folder: Path) -> Project:
    """A project where a person said all there is to say about hulls of its first asset."""
    project = applied(folder)
    project.correct(FIRST, ["left_low~1"], Merge())
    project.add_answer(Answer(1, FIRST, ["crumb"], [["crumb", "top"]]))
    project.reject(LabelCorrection(FIRST, "crumb", "misc", "leg"))
    project.confirm(LabelCorrection(FIRST, "crumb", project.mesh(FIRST).hull_of("crumb").label, "top"))
    return project


def test_selections_of_a_split_hull_name_its_parts_and_come_back_bit_for_bit(tmp_path: Path) -> None:
    project = said(tmp_path)
    before = kept(project)
    project.cut(FIRST, "crumb", *PLANE)
    assert project.steps(FIRST)[0].select == frozenset(PARTS)
    assert project.steps(FIRST)[1].select == frozenset(LEGS)
    (line,) = project.answers().answers
    assert (line.select, line.refused) == (("crumb#0", "crumb#1"), (("crumb#0", "crumb#1", "top"),))
    assert {one.hull for one in project.answers().confirmed} == PARTS
    assert {one.hull for one in project.answers().rejected} == PARTS
    flag = "crumb, which is demonstrated for rule 1, was split into crumb#0, crumb#1: look whether all parts are meant"
    assert flag in project.status(workers=0).assets[0].flags
    project.unprepare(FIRST)
    assert kept(project) == before


def test_an_edit_by_hand_of_a_split_hull_is_one_of_its_parts(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.correct(FIRST, ["top"], Merge())
    before = kept(project)
    project.cut(FIRST, "top", (1, 0, 0), (1, 0, 0))
    (edit,) = project.corrections(FIRST)
    assert [name for name, _ in edit.hulls] == ["top#0", "top#1"]
    assert edit.find_problem(project.mesh(FIRST)) is None
    project.unprepare(FIRST)
    assert kept(project) == before


def test_splits_of_splits_are_all_undone_at_once(tmp_path: Path) -> None:
    project = said(tmp_path)
    before = kept(project)
    project.cut(FIRST, "crumb", *PLANE)
    middle = kept(project)
    project.cut(FIRST, "crumb#0", project.mesh(FIRST).hull_of("crumb#0").aabb.center.tolist(), (1, 0, 0))
    assert project.steps(FIRST)[0].select == frozenset({"crumb#0#0", "crumb#0#1", "crumb#1"})
    project.unprepare(FIRST)
    assert kept(project) == middle
    project.cut(FIRST, "crumb#0", project.mesh(FIRST).hull_of("crumb#0").aabb.center.tolist(), (1, 0, 0))
    project.unprepare(FIRST, everything=True)
    assert kept(project) == before


def test_what_a_person_changed_since_the_split_is_not_overwritten(tmp_path: Path) -> None:
    project = said(tmp_path)
    project.cut(FIRST, "crumb", *PLANE)
    project.add_answer(Answer(1, FIRST, ["top"]))
    project.correct_selection(FIRST, 1, ["crumb#0", "crumb#1", "top"])
    assert not any("demonstrated" in flag for flag in project.status(workers=0).assets[0].flags)
    project.unprepare(FIRST)
    assert project.steps(FIRST)[0].select == frozenset({"crumb", "top"})
    assert project.answers().answers[0].select == ("top",)


def test_parts_get_the_labels_of_what_split_their_hull_and_a_persons_comes_back(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.set_labels(FIRST, {"top": "top"})
    before = kept(project)
    known = {"top#0": Label("leg", 0.9, "consensus"), "top#1": Label("top", 0.8, "consensus")}
    after = batch.cut_hull(read(project.path(FIRST)), batch.Preparation(), "top", (1, 0, 0), (1, 0, 0))
    exchange_preparation(project, FIRST, after, None, known)
    labels = project.mesh(FIRST).labels
    assert labels["top#0"] == Label("leg", 0.9, "propagated")
    assert labels["top#1"] == Label("top", 1.0, "user")
    project.unprepare(FIRST)
    assert kept(project) == before
    exchange_preparation(project, FIRST, after, None, known)
    project.set_labels(FIRST, {"top#0": "misc", "top#1": "misc"})
    notes = project.unprepare(FIRST).notes
    assert project.mesh(FIRST).hull_of("top").label == "misc"
    assert "top gets its label from its parts, which were labelled since it was split" in notes


@needs_fork
def test_a_killed_split_or_undo_loses_nothing_and_flags_what_is_gone(tmp_path: Path) -> None:
    project = said(tmp_path)
    before = kept(project)
    shutil.copytree(project.folder, tmp_path / "before")

    def split_anew() -> None:
        shutil.rmtree(project.folder)
        shutil.copytree(tmp_path / "before", project.folder)
        project.cut(FIRST, "crumb", *PLANE)

    died = 0
    for _ in deaths(split_anew):
        died += 1
        here = project.mesh(FIRST).index
        if not project.steps(FIRST)[0].select <= here.keys():  # type: ignore[operator]
            assert any(flag.startswith("crumb, ") for flag in project.status(workers=0).assets[0].flags)
        if project.preparation(FIRST).steps:
            project.unprepare(FIRST)
            assert {k: v for k, v in kept(project).items() if "prepared" not in k and "labels" not in k} == {
                k: v for k, v in before.items() if "labels" not in k
            }
    assert died > 3


def test_a_hull_stands_for_its_parts_only_where_all_are_named() -> None:
    parts = Successors({"a": ("a#0", "a#1")}, {})
    assert parts.carry(["a", "b"]) == ["a#0", "a#1", "b"]
    assert parts.carry_back(["b", "a#1", "a#0"]) == ["b", "a"]
    assert parts.carry_back(["a#0", "b"]) == ["a#0", "b"]
