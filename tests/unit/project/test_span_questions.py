"""Whether a hull that likely spans parts is to be split: when that is asked, and what the answers do."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from meshforge.batch import IN_PROCESS
from meshforge.common import ProjectError, StoppedError
from meshforge.labels import SpanReport
from meshforge.project import Project, span_splits
from meshforge.project.span_questions import add_span_doubts, ask_about_spans, list_span_questions
from meshforge.signoff import Assessment, AssetConfidence, GroupQuestion, ReviewReply, SpanQuestion
from meshforge.signoff.question import NO, NOT_SOLVED, YES, ExclusionReason
from meshforge.store import SpanPart, SpansFile
from tests.unit.project.stools import create_stools
from tests.unit.project.test_spans import files, split

C, D = "c.urdf", "d.urdf"
HULL = "base/h0"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two labelled stools and two with a hull that spans parts, which were looked for."""
    folder = tmp_path_factory.mktemp("stools")
    sizes = {"a": (0.2, 0.4), "b": (0.22, 0.45), "c": (0.18, 0.38), "d": (0.19, 0.42)}
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("MESHFORGE_CACHE", str(folder / "cache"))
        create_stools(folder, sizes, "cd").list_spans(execution=IN_PROCESS)
    return folder


@pytest.fixture
def project(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    monkeypatch.setenv("MESHFORGE_CACHE", str(made / "cache"))
    shutil.copytree(made, tmp_path, dirs_exist_ok=True)
    return Project.open(tmp_path / "p")


def asked(project: Project) -> SpanQuestion | None:
    return next(iter(list_span_questions(project, dict(project.meshes_by_id()))), None)


def ask(project: Project) -> SpanQuestion:
    question = asked(project)
    assert question
    return question


def answer(project: Project, choice: str | None, later: bool = False) -> SpanQuestion:
    """Reply to the question that is asked now, and give it."""
    question = ask(project)
    project.reply(question, ReviewReply(question.id, choice, later=later))
    return question


def test_it_is_asked_what_a_hull_holds_how_sure_that_is_and_which_parts_it_would_have(project: Project) -> None:
    question = ask(project)
    assert question.kind == "span" and question.hulls == ((question.asset, HULL),)
    assert question.text.startswith(f"{HULL} of {question.asset} holds seat and leg, 9")
    assert question.text.endswith("%: split so?")
    texts = {choice.id: choice.text.split(" (")[0] for choice in question.choices}
    assert list(texts.items()) == [(NO, "no, it is one part"), (YES, "split so: leg")], "things stay by default"
    assert "seat (" in question.choices[1].text


def test_parts_of_one_label_are_told_together(project: Project) -> None:
    found = project.last_spans()
    line = found.assets[C][HULL]
    rows = [("wall", 0.92), ("handle", 0.93), ("wall", 0.754), ("wall", 0.8)]
    parts = tuple(SpanPart(label=label, share=share) for label, share in rows)
    project.write_spans(SpansFile(assets={C: {HULL: line.model_copy(update={"parts": parts})}}))
    assert ask(project).choices[1].text == "split so: 3 wall (75% to 92%), handle (93%)"


def test_a_hull_that_no_plane_divides_is_named_and_not_asked_about(
    project: Project, monkeypatch: pytest.MonkeyPatch
) -> None:
    divide = SpanReport.divide
    monkeypatch.setattr(SpanReport, "divide", lambda *given: [(*divide(*given)[0][:2], 0.6)])
    project.list_spans(execution=IN_PROCESS)
    assert asked(project) is None
    assert [len(row.spans) for row in project.status().assets] == [0, 0, 1, 1]
    with pytest.raises(ProjectError, match="no plane divides this hull"):
        span_splits.split_as_found(project, C, HULL)


def test_nothing_is_asked_where_nobody_has_looked(project: Project) -> None:
    project.layout.spans.unlink()
    assert asked(project) is None


def test_looking_that_is_stopped_keeps_nothing(project: Project) -> None:
    project.layout.spans.unlink()
    with pytest.raises(StoppedError):
        project.list_spans(execution=replace(IN_PROCESS, stop=lambda: True))
    assert not project.layout.spans.exists()


def test_yes_does_what_the_command_does_for_that_hull_and_is_undone_to_the_last_byte(
    project: Project, tmp_path: Path
) -> None:
    shutil.copytree(tmp_path / "p", tmp_path / "q")
    before = files(project)
    first = answer(project, YES).asset
    assert ask(project).asset != first
    split(other := Project.open(tmp_path / "q"), first)
    own, theirs = files(project), files(other)
    assert own[f"prepared/{first}/hulls.obj"] == theirs[f"prepared/{first}/hulls.obj"]
    assert own[f"labels/{first}.json"] == theirs[f"labels/{first}.json"]
    (step,), (same,) = project.preparation(first).steps, other.preparation(first).steps
    assert step.replaced == same.replaced
    project.unprepare(first)
    assert {name: data for name, data in files(project).items() if name != "events.jsonl"} == before
    assert ask(project).asset == first


@pytest.mark.slow
def test_a_hull_that_a_person_calls_one_part_is_neither_asked_about_nor_named_nor_split(project: Project) -> None:
    first, second = answer(project, NO).asset, answer(project, NO).asset
    assert {first, second} == {C, D} and asked(project) is None
    assert not project.preparation(first).steps
    assert [row.spans for row in project.status().assets] == [{}, {}, {}, {}]
    results = {result.asset: result for result in split(project)}
    assert not any(result.made for result in results.values())
    (note,) = results[C].notes
    assert note.startswith(f"{HULL} holds seat and leg, ")
    assert note.endswith("left as it is, since a person said that it is one part")
    assert asked(project) is None, "looking again changes nothing"


def test_it_is_asked_again_once_the_geometry_is_another(project: Project) -> None:
    first = answer(project, NO).asset
    assert first not in project.spans().assets
    said = project.layout.single_parts.read_text()
    project.layout.single_parts.write_text(said.replace('": "', '": "0'))
    assert first in project.spans().assets, "it was another hull that is one part"


def test_later_asks_about_another_hull_and_is_asked_again_on_request(project: Project) -> None:
    first = answer(project, None, later=True)
    second = answer(project, None)
    assert {first.asset, second.asset} == {C, D} and asked(project) is None
    project.ask_again()
    assert ask(project) == first


def test_a_hull_that_is_another_now_is_not_asked_about_and_cannot_be_split_so(project: Project) -> None:
    question = ask(project)
    box = project.mesh(question.asset).hull_of(HULL).aabb
    project.cut(question.asset, HULL, ((box.min + box.max) / 2).tolist(), (0, 0, 1))
    assert ask(project).asset != question.asset
    before = files(project)
    with pytest.raises(ProjectError, match="nothing is known of parts of this hull as it is now"):
        project.reply(question, ReviewReply(question.id, YES))
    with pytest.raises(ProjectError, match=f"there is no hull '{HULL}'"):
        project.reply(question, ReviewReply(question.id, NO))
    assert files(project) == before


@pytest.mark.parametrize("damage", ["gone", "cut short", "of another finding"])
def test_parts_that_are_not_kept_any_more_are_named_and_nothing_is_written(project: Project, damage: str) -> None:
    question = ask(project)
    path = project.layout.span_parts(question.asset)
    if damage == "gone":
        path.unlink()
    elif damage == "cut short":
        path.write_bytes(path.read_bytes()[:200])
    else:
        found = project.layout.spans.read_text()
        project.layout.spans.write_text(found.replace("seat and leg", "leg and seat"))
    before = files(project)
    with pytest.raises(ProjectError, match=r"the parts of this hull are not kept any more(.|\n)*--split-spanning"):
        span_splits.split_as_found(project, question.asset, HULL)
    assert files(project) == before


def test_a_damaged_record_of_what_was_found_asks_nothing(project: Project) -> None:
    project.layout.spans.write_text("{")
    assert asked(project) is None


def test_before_there_is_a_program_it_is_asked_first_then_by_what_an_answer_is_worth(project: Project) -> None:
    meshes = dict(project.meshes_by_id())
    own = ask(project)

    def kind(gain: float, has_program: bool, *excluded: str) -> str:
        other = GroupQuestion("?", own.seconds, gain, "a.urdf", id="group-1")
        away: dict[str, ExclusionReason] = dict.fromkeys(excluded, NOT_SOLVED)
        sure = {name: AssetConfidence(name, 0.5) for name in meshes}
        found = Assessment(sure, excluded=away, questions=(other,))
        question = ask_about_spans(project, meshes, found, has_program).question
        assert question
        return str(question.kind)

    assert kind(own.gain + 1, False) == "span"
    assert kind(own.gain + 1, True) == "group"
    assert kind(own.gain / 2, True) == "span"
    assert kind(own.gain / 2, True, C, D) == "group"
    nothing = ask_about_spans(project, meshes, Assessment({}), True)
    assert nothing.question == own


def test_an_edit_is_no_surer_than_that_no_hull_spans_parts(project: Project) -> None:
    meshes = dict(project.meshes_by_id())
    sure = Assessment({name: AssetConfidence(name, 0.99) for name in meshes})
    found = add_span_doubts(project, meshes, sure, {D})
    chance = project.last_spans().assets[C][HULL].chance
    assert found.assets[C].probability == pytest.approx(1 - chance) and C in found.held
    assert [doubt.text for doubt in found.assets[C].doubts] == [project.last_spans().assets[C][HULL].told]
    assert {found.assets[name].probability for name in meshes if name != C} == {0.99}, "a person saw that of d"
    span_splits.mark_as_one_part(project, C, HULL)
    assert add_span_doubts(project, meshes, sure, ()).assets[C].probability == 0.99


@pytest.mark.slow
def test_a_review_asks_it_while_nothing_is_demonstrated(project: Project) -> None:
    found = project.review()
    assert found.assessment.question and found.assessment.question.kind == "span"
    project.reply(found.assessment.question, ReviewReply(found.assessment.question.id, YES))
    again = project.review().assessment.question
    assert again and again.kind == "span" and again.asset != found.assessment.question.asset
