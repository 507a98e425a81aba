import json
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from meshforge.batch import IN_PROCESS
from meshforge.common import ProjectError
from meshforge.language import Delete, Program
from meshforge.project import AssetStatus, ProgramState, Project, Status, suggest_first_demonstration
from tests.unit.batch.families import PROGRAM, write_table
from tests.unit.project.tables import FIRST, SECOND, STEPS, THIRD, applied, demonstrated, labelled, learned


def of(project: Project) -> Status:
    return project.status(workers=0)


def asset(project: Project, name: str) -> AssetStatus:
    return next(a for a in of(project).assets if a.id == name)


def test_the_asset_that_tells_most_is_advised_and_one_that_cannot_be_read_passed_over(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    first = suggest_first_demonstration(project, project.assets())
    advised = of(project).next
    assert first in project.assets()
    assert f"best first on {first}." in advised.text
    assert first in (advised.command or "")
    project.path(first).write_text("no obj")
    assert suggest_first_demonstration(project, project.assets()) not in (first, None)
    assert suggest_first_demonstration(project, ()) is None


def test_labels_that_lie_nowhere_are_to_be_given_by_hand_or_read_from_names(tmp_path: Path) -> None:
    write_table(tmp_path / "assets/t.obj", labels=False)
    project = Project.create(tmp_path / "p", [tmp_path / "assets"])
    assert of(project).next.command == f"meshforge demonstrate {project.folder} t.obj 'HULLS => ACTION' ..."
    project.set_vocabulary(("panel", "leg"))
    assert of(project).next.command == f"meshforge label {project.folder} t.obj 'top=LABEL'"
    project.set_vocabulary(("top", "leg"))
    advice = of(project).next
    assert advice.text == "The names of 1 hull contain a label: label all hulls."
    assert advice.command == f"meshforge label {project.folder}"
    (tmp_path / "assets/t.obj").write_text("nothing of use")
    assert of(project).next.command is None


def test_each_asset_says_how_far_it_is(tmp_path: Path) -> None:
    project = demonstrated(tmp_path)
    hulls = project.mesh(FIRST).hulls
    first, third = asset(project, FIRST), asset(project, THIRD)
    names, labels = tuple(hull.name for hull in hulls), tuple(hull.annotation for hull in hulls)
    assert third == AssetStatus(THIRD, 6, 6, names=names, labels=labels, geometry=third.geometry)
    assert first == replace(third, id=FIRST, demonstrated=True, geometry=first.geometry)
    done = asset(applied(tmp_path / "more"), THIRD)
    assert done == replace(
        third, output="edited", after=3, after_labels=("top", "leg", "leg"), output_digest=done.output_digest
    )
    assert done.is_done and done.output_digest


def test_what_changed_since_the_output_was_made_is_named(tmp_path: Path) -> None:
    project = applied(tmp_path)
    write_table(tmp_path / "assets" / FIRST, 4.0)
    project.set_labels(SECOND, {"crumb": "leg"})
    (project.folder / "edited" / THIRD).unlink()
    assert [a.stale for a in of(project).assets] == [("asset",), ("labels",), ("output",)]
    (project.folder / "program.mf").write_text(PROGRAM.replace("Each(Merge)", "Delete"))
    assert [a.stale for a in of(project).assets] == [("asset", "program"), ("labels", "program"), ("program", "output")]
    assert of(project).next.command == f"meshforge apply {project.folder}"
    list(project.apply(execution=IN_PROCESS))
    assert all(a.is_done for a in of(project).assets)


def test_a_label_that_nothing_uses_makes_no_output_stale_and_leaves_what_was_accepted(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.set_verdict(FIRST, "accepted")
    project.set_vocabulary((*project.vocabulary, "wheel"))
    project.synthesize()
    program = project.program()
    assert program and "wheel" in program.labels
    assert [row.stale for row in of(project).assets] == [(), (), ()]
    assert (asset(project, FIRST).review, asset(project, FIRST).result_status.void) == ("accepted", ())


def test_a_failure_is_told_with_its_message(tmp_path: Path) -> None:
    project = learned(tmp_path)
    (project.folder / "labels" / f"{THIRD}.json").unlink()
    list(project.apply(execution=IN_PROCESS))
    found = asset(project, THIRD)
    assert found.output == "failed" and found.error and "no labels" in found.error
    assert of(project).next.kind == "label-all"


def test_a_learned_program_is_outdated_when_what_it_was_learned_from_changes(tmp_path: Path) -> None:
    project = learned(tmp_path)
    assert not of(project).outdated
    project.demonstrate(SECOND, STEPS[:1])
    assert of(project).outdated
    assert of(project).next.command == f"meshforge synthesize {project.folder}"
    (project.folder / "program.mf").write_text("labels top\nAll => Merge\n")
    assert not of(project).outdated


def test_a_learned_program_is_outdated_when_a_result_is_called_wrong_that_was_not_shown(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.set_verdict(SECOND, "wrong")
    assert not of(project).outdated
    project.set_verdict(THIRD, "wrong")
    assert of(project).outdated and "replies" in of(project).next.text
    project.set_verdict(THIRD, None)
    assert not of(project).outdated


def test_a_review_counts_until_the_output_changes(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.set_verdict(FIRST, "accepted")
    project.set_verdict(SECOND, "wrong", "left leg")
    assert [a.review for a in of(project).assets] == ["accepted", "wrong", None]
    assert not of(project).outdated, "nothing is learned from what was said of a demonstrated asset"
    project.set_verdict(THIRD, "accepted")
    assert of(project).next.text == "1 result wrong: correct them, first table1/model.obj."
    project.set_verdict(THIRD, None)
    kept = project.feedback().verdict_on(SECOND)
    assert kept is not None and (kept.verdict, kept.note) == ("wrong", "left leg")
    project.set_labels(FIRST, {"crumb": "leg"})
    list(project.apply(execution=IN_PROCESS))
    assert [a.review for a in of(project).assets] == [None, "wrong", None]
    project.set_verdict(SECOND, None)
    assert project.feedback().verdicts.keys() == {FIRST}


def test_several_outputs_are_reviewed_in_one_go_or_none_is(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.set_verdict([FIRST, THIRD], "accepted", "fine")
    assert [a.review for a in of(project).assets] == ["accepted", None, "accepted"]
    assert [a.review_note for a in of(project).assets] == ["fine", None, "fine"]
    (project.folder / "labels" / f"{SECOND}.json").unlink()
    list(project.apply(execution=IN_PROCESS))
    before = project.layout.events.read_bytes()
    with pytest.raises(ProjectError, match=f"{SECOND} has no output to be accepted"):
        project.set_verdict([FIRST, SECOND], "accepted")
    with pytest.raises(ProjectError, match="there is no asset"):
        project.set_verdict([FIRST, "nobody"], None)
    assert project.layout.events.read_bytes() == before
    project.set_verdict([FIRST, SECOND, THIRD], None)
    assert project.feedback().verdicts == {}


def test_the_status_of_some_assets_is_theirs_in_the_status_of_all(tmp_path: Path) -> None:
    project = applied(tmp_path)
    project.correct(SECOND, ["top"], Delete())
    project.accept(Program.parse('labels top\nIs(top) => Replace("slab.obj")\n'))
    write_table(project.folder / "templates/slab.obj")
    list(project.apply(execution=IN_PROCESS))
    project.set_labels(THIRD, {"crumb": "leg"})
    project.set_verdict(FIRST, "wrong")
    every = of(project)
    some = project.status([THIRD, FIRST], workers=0, others=every.assets)
    assert some == replace(every, assets=(every.assets[0], every.assets[2]))
    assert project.status([], workers=0, others=every.assets).next == every.next
    with pytest.raises(ProjectError, match="there is no asset 'nobody'"):
        project.status(["nobody"])


def test_a_program_stands_by_what_it_was_learned_from(tmp_path: Path) -> None:
    assert demonstrated(tmp_path / "a").program_state() == ProgramState()
    project = learned(tmp_path / "b")
    assert project.program_state() == ProgramState()
    project.demonstrate(SECOND, STEPS[:1])
    assert project.program_state() == ProgramState(outdated=True)
    for text in ("labels top\nAll => Merge\n", "nonsense"):
        (project.folder / "program.mf").write_text(text)
        assert project.program_state() == ProgramState(by_hand=True)
    project.synthesize()
    assert project.program_state() == ProgramState()
    (project.folder / "learned.json").unlink()
    assert project.program_state() == ProgramState(by_hand=True)


def test_in_a_clone_elsewhere_a_learned_program_is_a_learned_one_and_its_record_the_same(tmp_path: Path) -> None:
    project = learned(tmp_path / "here")
    record = (project.folder / "learned.json").read_bytes()
    shutil.copytree(tmp_path / "here", tmp_path / "there/deep", ignore=shutil.ignore_patterns(".meshforge"))
    clone = Project.open(tmp_path / "there/deep/tables")
    assert clone.program_state() == ProgramState()
    clone.synthesize()
    assert (clone.folder / "learned.json").read_bytes() == record


def test_the_status_is_plain_data_for_scripts(tmp_path: Path) -> None:
    data = json.loads(json.dumps(of(applied(tmp_path)).to_json()))
    assert data["assets"][0] == {
        "asset": FIRST,
        "hulls": 6,
        "sources": 0,
        "prepared": [],
        "labelled": 6,
        "doubtful": [],
        "demonstrated": True,
        "output": "edited",
        "stale": [],
        "error": None,
        "flags": [],
        "review": None,
        "excluded": None,
        "sign_off": "unknown",
        "signed_by": None,
        "void": [],
        "found_since": [],
        "probability": None,
        "reasons": [],
    }
    assert data["next"]["command"].startswith("meshforge review")


def test_labels_of_hulls_that_changed_or_are_gone_are_doubtful(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    path = tmp_path / "assets" / FIRST
    path.write_text(path.read_text().replace("o top", "o board").replace("5.1", "6"))
    found = asset(project, FIRST)
    assert (found.labelled, found.doubtful) == (6, ("crumb",))
    path.write_text(path.read_text().replace("o crumb", "o litter"))
    found = asset(project, FIRST)
    assert (found.labelled, found.doubtful) == (5, ("crumb",))
    project.set_labels(FIRST, {"litter": "misc"})
    assert asset(project, FIRST).labelled == 6
    assert "crumb" in project.labels(FIRST).labels


def test_a_program_that_cannot_be_applied_is_told_first(tmp_path: Path) -> None:
    project = applied(tmp_path)
    (project.folder / "program.mf").write_text('labels top\nIs(top) => Replace("slab.obj")\n')
    found = of(project)
    assert found.problem and '"slab.obj" is not there' in found.problem
    assert found.rules == 1 and found.problem.splitlines()[0] in found.next.text
    (project.folder / "program.mf").write_text("nonsense")
    assert of(project).rules is None and "program.mf:1:1" in (of(project).problem or "")


def test_damaged_labels_of_one_asset_do_not_hide_the_others(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    (project.folder / "labels" / f"{SECOND}.json").write_text("{")
    found = of(project)
    assert [a.labelled for a in found.assets] == [6, 0, 6]
    assert found.assets[1].error and "no JSON" in found.assets[1].error
