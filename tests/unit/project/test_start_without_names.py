import shutil
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.batch import IN_PROCESS
from meshforge.batch.outcome import Edited, Failed, Skipped
from meshforge.common import ProjectError, UsageError
from meshforge.geometry import digest
from meshforge.language import Delete, Each, Merge
from meshforge.project import Project, list_renamed_files
from meshforge.store import History, Layout, list_files
from meshforge.symbolic import NO_PART, Label, is_class_name, name_class
from meshforge.synthesis import Answer, Step
from tests.unit.project.tables import FIRST, LEGS, SECOND, STEPS, THIRD, fresh, learned

PARTS = {"crumb": "part_a", **dict.fromkeys(LEGS, "part_b")}


def shown(folder: Path) -> Project:
    """A project without a label, learned from what was shown on one asset."""
    project = fresh(folder)
    project.demonstrate(FIRST, STEPS)
    project.synthesize()
    return project


def labels_of(project: Project, asset: str) -> dict[str, str]:
    return {hull.name: hull.label for hull in project.mesh(asset).hulls if hull.label}


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return shown(tmp_path)


def test_without_names_a_program_asks_for_the_hulls_of_steps_and_edits_the_others(project: Project) -> None:
    assert str(project.program()).splitlines()[2:] == ["Is(part_a) => Delete", "Is(part_b) => Each(Merge)"]
    assert [labels_of(project, asset) for asset in project.assets()] == [PARTS] * 3
    assert not any(project.labels(asset).labels for asset in project.assets()), "nobody labelled anything"
    done = list(project.apply(execution=IN_PROCESS))
    assert [(one.before, one.after) for one in done if isinstance(one, Edited)] == [(6, 3)] * 3


def test_a_hull_of_no_step_is_known_to_be_no_part_and_shown_without_a_label(project: Project) -> None:
    top = project.mesh(SECOND).hull_of("top")
    assert top.annotation and (top.annotation.name, top.label) == (NO_PART, None)
    assert project.tally_labels().unlabelled == 0
    first = project.mesh(FIRST).hulls
    assert {hull.source for hull in first} == {"step"} and {hull.source for hull in project.mesh(THIRD).hulls} == {
        "class"
    }


def test_a_class_gets_a_name_and_gives_it_back(project: Project) -> None:
    learned_files = frozenset({Layout.program.name, Layout.previous_program.name, Layout.learned.name})
    history = History(project.folder, lambda: learned_files)
    with history.record("named", {}, list_renamed_files(project)):
        project.rename_label("part_b", "leg")
    assert "Is(leg)    => Each(Merge)" in str(project.program()) and project.vocabulary == ("leg",)
    sources = {asset: {one.source for one in project.labels(asset).labels.values()} for asset in (FIRST, SECOND)}
    assert sources == {FIRST: {"user"}, SECOND: {"propagated"}}
    named = project.synthesize().program
    assert named and str(named).splitlines()[1:] == str(project.program()).splitlines()[1:]
    history.undo()
    assert not project.vocabulary and not project.labels(FIRST).labels
    assert "Is(part_b)" in str(project.synthesize().program)


def test_a_name_for_a_class_keeps_results_and_sign_offs_and_so_does_taking_it_back(project: Project) -> None:
    list(project.apply(execution=IN_PROCESS))
    project.set_verdict(THIRD, "accepted")
    project.review(0.5, execution=IN_PROCESS)
    assert project.status(workers=0).is_signed_off
    history = History(project.folder, lambda: frozenset(file.name for file in list_files() if file.learned))
    with history.record("named", {}, list_renamed_files(project)):
        project.rename_label("part_b", "leg")
    beside = (project.layout.edited / SECOND).with_suffix(".labels.json")
    for has_name in (True, False):
        assert project.status(workers=0).is_signed_off and ('"leg"' in beside.read_text()) is has_name
        assert {type(one) for one in project.apply(execution=IN_PROCESS)} == {Skipped}
        project.review(0.5, execution=IN_PROCESS)
        assert project.status(workers=0).is_signed_off and project.feedback().verdicts.keys() == {THIRD}
        history.undo()


def test_two_parts_do_not_get_one_name_and_no_label_a_made_one(project: Project) -> None:
    project.rename_label("part_b", "leg")
    for name in ("leg", "Leg"):
        with pytest.raises(ProjectError, match=r"there is a label 'leg' already\n.*ASSET 'HULLS=leg'"):
            project.rename_label("part_a", name)
    with pytest.raises(ProjectError, match=r"there is no label 'part_c'\n  Did you mean 'part_a'"):
        project.rename_label("part_c", "foot")
    with pytest.raises(ProjectError, match="there is no label 'no part'"):
        project.rename_label(NO_PART, "rest")
    with pytest.raises(UsageError, match="'part_c' is a name that MeshForge gives"):
        project.rename_label("leg", "part_c")
    with pytest.raises(UsageError, match="'part_a' is a name that MeshForge gives"):
        project.set_vocabulary(["part_a"])


def test_the_hulls_of_two_steps_are_a_class_of_their_own(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    project.demonstrate(FIRST, [Step(1, LEGS, Each(Merge())), Step(2, {"crumb", "left_low~1"}, Delete())])
    project.synthesize()
    assert set(labels_of(project, FIRST).values()) == {"part_a", "part_ab", "part_b"}


def test_an_answer_says_of_what_class_hulls_are(project: Project) -> None:
    project.add_answer(Answer(1, THIRD, {"crumb", "top"}))
    project.add_answer(Answer(2, THIRD, LEGS))
    project.update_classes(dict(project.meshes_by_id()))
    assert labels_of(project, THIRD) == {**PARTS, "top": "part_a"}
    assert {hull.source for hull in project.mesh(THIRD).hulls} == {"step"}


def test_classes_go_with_the_demonstration_and_make_way_for_labels(tmp_path: Path) -> None:
    project = shown(tmp_path / "a")
    project.label("file")
    assert "part" not in str(project.synthesize().program)
    assert not project.layout.classes.ids
    taken_back = shown(tmp_path / "b")
    taken_back.demonstrate(FIRST, [])
    assert "program.mf" in taken_back.forget_learned()
    assert not taken_back.layout.classes.ids and taken_back.program() is None
    assert not taken_back.status(workers=0).outdated


def test_a_new_asset_gets_classes_when_the_program_is_applied(project: Project, tmp_path: Path) -> None:
    (tmp_path / "assets/table9").mkdir()
    shutil.copyfile(tmp_path / "assets/table1/model.obj", tmp_path / "assets/table9/model.obj")
    new = Project.open(project.folder)
    assert not labels_of(new, "table9/model.obj")
    done = list(new.apply(execution=IN_PROCESS))
    assert labels_of(new, "table9/model.obj") == PARTS
    assert [(one.before, one.after) for one in done if isinstance(one, Edited)] == [(6, 3)] * 4


def test_hulls_that_were_cut_since_get_classes_when_the_program_is_applied(project: Project) -> None:
    project.cut(THIRD, "crumb", (5.05, 5.05, 5.05), (1, 0, 0))
    done = list(project.apply([THIRD], execution=IN_PROCESS))
    assert [(one.before, one.after) for one in done if isinstance(one, Edited)] == [(7, 3)]


def test_a_class_that_is_taken_away_is_no_part_and_a_label_just_goes(project: Project) -> None:
    project.rename_label("part_b", "leg")
    project.set_labels(SECOND, {"crumb": None, "left_low": None})
    labels = project.labels(SECOND).labels
    assert labels["crumb"].name == NO_PART and "left_low" not in labels


def test_a_name_for_some_hulls_of_a_class_takes_no_others_from_its_step(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    project.demonstrate(FIRST, [Step(1, {"crumb", *LEGS}, Delete())])
    project.synthesize()
    project.set_vocabulary(["dirt"])
    project.set_labels(FIRST, {"crumb": "dirt"})
    assert "Union(Is(dirt), Is(part_a)) => Delete" in str(project.synthesize().program)
    assert labels_of(project, SECOND) == dict.fromkeys(PARTS, "part_a")
    done = list(project.apply(execution=IN_PROCESS))
    assert [(one.before, one.after) for one in done if isinstance(one, Edited)] == [(6, 1)] * 3


def test_a_guess_is_a_name_where_its_step_takes_a_hull_with_that_name_and_else_gives_way(project: Project) -> None:
    project.delete_rule(1)
    project.set_vocabulary(["leg", "wheel"])
    first, *others = sorted(LEGS)
    project.set_labels(FIRST, {first: "leg"})
    hulls = {hull.name: digest(hull.shape) for hull in project.mesh(FIRST).hulls}
    for guess, program in (("leg", "Is(leg) =>"), ("wheel", "Union(Is(leg), Is(part_a)) =>")):
        labels = {**project.labels(FIRST).labels, **dict.fromkeys(others, Label(guess, 0.9, "propagated"))}
        project.write_labels(FIRST, hulls, labels, ["leg", "wheel"])
        assert program in str(project.synthesize().program)
        assert labels_of(project, FIRST)[others[0]] == ("leg" if guess == "leg" else "part_a")


@pytest.mark.parametrize(
    "content", ["", "{", "[]", '{"version": 9, "hulls": {}}', '{"hulls": {"top": {"source": "x"}}}']
)
def test_classes_that_are_damaged_are_none_and_made_again(project: Project, content: str) -> None:
    places = [project.layout.classes(asset) for asset in project.assets()]
    whole = [place.read_text() for place in places]
    places[1].write_text(content)
    assert [asset.labelled for asset in project.status(workers=0).assets] == [6, 0, 6]
    assert not any(isinstance(one, Failed) for one in project.apply(execution=IN_PROCESS))
    assert labels_of(project, SECOND) == PARTS
    for place in places:
        place.write_text(content)
    project.synthesize()
    assert [place.read_text() for place in places] == whole


def test_a_dry_run_writes_no_classes_and_labels_need_none(tmp_path: Path) -> None:
    project = fresh(tmp_path / "a")
    project.demonstrate(FIRST, STEPS)
    assert "part_a" in str(project.synthesize(accept=False).program)
    assert not project.layout.classes.ids and not learned(tmp_path / "b").layout.classes.ids


rules = st.frozensets(st.integers(1, 40), max_size=6)


@given(rules, rules)
def test_classes_of_other_steps_have_other_names(one: frozenset[int], other: frozenset[int]) -> None:
    assert is_class_name(name_class(one))
    assert (name_class(one) == name_class(other)) == (one == other)


@pytest.mark.parametrize("word", ["part_left", "part_", "part", "leg", "Part_a", "part_ba", "part_a_1", ""])
def test_other_names_are_free(word: str) -> None:
    assert not is_class_name(word)
