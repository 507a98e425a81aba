"""A project reviewed and signed off: what a sign-off rests on, when it is void, and what becomes of replies."""

import json
import sys
from datetime import UTC, datetime
from graphlib import TopologicalSorter
from pathlib import Path
from types import FrameType

import pytest

from meshforge.batch import IN_PROCESS
from meshforge.common import ProjectError
from meshforge.language import Delete
from meshforge.project import Project, ProjectReview
from meshforge.signoff import HullPlace, ReviewChoice, ReviewQuestion, ReviewReply
from meshforge.signoff.question import EXCLUDE, NO, NOT_SOLVED, RIGHT, WRONG, YES
from meshforge.symbolic import Label
from meshforge.synthesis import Answer, Step
from tests.unit.project.tables import FIRST, SECOND, THIRD, applied, demonstrated, learned

NOON = datetime(2026, 11, 25, 12, tzinfo=UTC)


def review(project: Project, bar: float = 0.5) -> ProjectReview:
    return project.review(bar, clock=lambda: NOON, execution=IN_PROCESS)


def sign_off_of(project: Project, asset: str) -> str:
    return next(one.result_status.state for one in project.status().assets if one.id == asset)


def result_of(asset: str) -> ReviewQuestion:
    choices = tuple(ReviewChoice(one, one) for one in (RIGHT, WRONG, *EXCLUDE))
    return ReviewQuestion("result", "?", 2.65, 0.5, asset, choices=choices, id="r")


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return applied(tmp_path)


def test_a_demonstrated_asset_is_signed_off_by_a_person_and_a_sure_one_by_the_tool(project: Project) -> None:
    found = review(project)
    assert set(found.assessment.signed_off) == {FIRST, SECOND, THIRD}
    signed = project.sign_offs()
    assert {asset: one.by for asset, one in signed.items()} == {FIRST: "person", SECOND: "person", THIRD: "tool"}
    assert {one.when for one in signed.values()} == {"2026-11-25T12:00:00+00:00"}
    assert project.status().is_signed_off


def test_a_person_who_wrote_the_program_gets_it_reviewed_as_it_is(tmp_path: Path) -> None:
    project = learned(tmp_path)
    text = str(project.program())
    (project.folder / "program.mf").write_text(text.replace("Each(Merge)", "Merge"))
    before = (project.folder / "program.mf").read_text()
    found = review(project)
    assert (project.folder / "program.mf").read_text() == before
    assert set(found.assessment.assets) == {FIRST, SECOND, THIRD}


def test_a_review_calls_functions_of_at_most_ten_modules_and_none_calls_back_one_above_it(tmp_path: Path) -> None:
    """The modules that the page of the review calls itself, without classes that are made there."""
    project, calls = applied(tmp_path), set[tuple[str, str]]()
    review(project)
    project.set_verdict(THIRD, "accepted")

    def note(frame: FrameType, event: str, _: object) -> None:
        caller = frame.f_back
        while event == "call" and caller and not caller.f_globals.get("__name__", "").startswith("meshforge."):
            caller = caller.f_back
        if event == "call" and caller and frame.f_globals.get("__name__", "").startswith("meshforge."):
            calls.add((caller.f_globals["__name__"], frame.f_globals["__name__"]))

    sys.setprofile(note)
    try:
        review(project)
    finally:
        sys.setprofile(None)
    top = "meshforge.project.review"
    called = {below for above, below in calls if above == top} - {top}
    assert len(called) <= 10, called
    order = list(TopologicalSorter({a: {b for x, b in calls if x == a} & called - {a} for a in called}).static_order())
    assert len(order) == len(called) and not any(above != top and below == top for above, below in calls)


@pytest.mark.parametrize("choice", EXCLUDE)
def test_an_asset_that_is_given_up_is_excluded_with_the_reason(project: Project, choice: str) -> None:
    review(project)
    project.reply(result_of(THIRD), ReviewReply("r", choice))
    after = review(project).assessment
    assert after.excluded == {THIRD: EXCLUDE[choice]}
    counts = choice == "not-solved"
    assert THIRD not in (*after.signed_off, *after.need_review) and (THIRD in after.assets) == counts
    status = project.status()
    assert (THIRD in status.not_of_family) != counts and (not counts or sign_off_of(project, THIRD) == "excluded")
    assert (status.is_signed_off, status.is_signed_off_but_unsolved) == (not counts, True)


def test_a_question_that_is_put_off_stays_so(tmp_path: Path) -> None:
    project = learned(tmp_path)
    project.reply(result_of(THIRD), ReviewReply("r", later=True))
    assert project.feedback().snoozed == ("r",)
    assert review(project).state.snoozed == {"r"}
    project.ask_again()
    assert review(project).state.snoozed == frozenset()


def test_a_choice_that_is_not_there_is_one_clear_message(tmp_path: Path) -> None:
    project = learned(tmp_path)
    with pytest.raises(ProjectError, match=r"question r has no choice 'rigth'(.|\n)*[Dd]id you mean 'right'"):
        project.reply(result_of(THIRD), ReviewReply("r", "rigth"))
    with pytest.raises(ProjectError, match='They go with the choice "wrong"'):
        project.reply(result_of(THIRD), ReviewReply("r", RIGHT, labels={"crumb": "leg"}))
    assert not project.layout.events.exists()


def test_a_damaged_file_of_sign_offs_is_named(tmp_path: Path) -> None:
    project = learned(tmp_path)
    project.layout.sign_offs.write_text('\n{"asset": "a", "by": "nobody"}\n')
    with pytest.raises(ProjectError, match=r"signoffs\.jsonl: line 2: the field by: "):
        review(project)


def test_a_damaged_assessment_is_made_again(tmp_path: Path) -> None:
    project = learned(tmp_path)
    review(project)
    project.layout.assessment.write_text("{")
    assert {one.result_status.probability for one in project.status().assets} == {None}
    review(project)
    assert None not in {one.result_status.probability for one in project.status().assets}


def test_the_same_review_writes_the_same_files(project: Project) -> None:
    review(project)
    before = {name: (project.folder / name).read_bytes() for name in ("signoffs.jsonl", ".meshforge/assessment.json")}
    review(project)
    assert before == {name: (project.folder / name).read_bytes() for name in before}
    assert [json.loads(line)["asset"] for line in before["signoffs.jsonl"].splitlines()] == [FIRST, SECOND, THIRD]


def test_a_result_that_was_accepted_counts_only_while_the_program_does_the_same_there(project: Project) -> None:
    project.set_verdict(THIRD, "accepted")
    assert THIRD in review(project).assessment.looked_at
    (project.folder / "program.mf").write_text("labels top, leg, misc\n\nIs(misc) => Delete\n")
    assert THIRD not in review(project).assessment.looked_at


def test_a_label_of_another_asset_makes_every_probability_unknown_and_no_sign_off_void(tmp_path: Path) -> None:
    project = applied(tmp_path)
    review(project)
    project.set_labels(THIRD, {"crumb": "leg"})
    assert {one.result_status.probability for one in project.status().assets} == {None}
    assert [one.result_status.state for one in project.status().assets] == ["signed off", "signed off", "void"]


def test_what_is_signed_off_no_longer_is_named(tmp_path: Path) -> None:
    project = applied(tmp_path)
    review(project)
    project.set_labels(THIRD, {"crumb": "leg"})
    assert set(review(project, 0.9999).taken_back) == {THIRD}
    assert THIRD not in project.sign_offs()


@pytest.mark.slow
def test_what_cannot_be_read_is_held_until_it_is_excluded(tmp_path: Path) -> None:
    project = learned(tmp_path)
    project.path(THIRD).write_text("no mesh at all")
    found = review(project)
    assert found.assessment.need_review == (THIRD,) and found.assessment.question is not None
    project.reply(found.assessment.question, ReviewReply(found.assessment.question.id, "not-solved"))
    assert review(project).assessment.is_done
    assert review(project).assessment.excluded == {THIRD: NOT_SOLVED}
    assert sign_off_of(project, THIRD) == "excluded"
    project.set_verdict(THIRD, None)
    assert review(project).assessment.need_review == (THIRD,)


def selection_of(asset: str) -> ReviewQuestion:
    """The question whether the first rule was shown on an asset with a slip."""
    choices = (ReviewChoice(NO, "no", select=("crumb",)), ReviewChoice(YES, "yes", select=("crumb", "left_low")))
    return ReviewQuestion("selection", "?", 2.65, 0.5, asset, 1, (), choices, "s")


def test_a_slip_that_is_admitted_corrects_the_demonstration_and_what_was_meant_stays(tmp_path: Path) -> None:
    project = demonstrated(tmp_path)
    project.reply(selection_of(FIRST), ReviewReply("s", NO))
    assert project.steps(FIRST)[0].select == frozenset({"crumb"})
    assert "s" in project.feedback().snoozed
    project.reply(selection_of(FIRST), ReviewReply("s", YES))
    assert project.steps(FIRST)[0].select == frozenset({"crumb", "left_low"})
    assert project.steps(SECOND)[0].select == frozenset({"crumb"})


def test_a_repair_that_a_person_did_not_want_is_not_proposed_again(tmp_path: Path) -> None:
    project = demonstrated(tmp_path)
    was = project.mesh(FIRST).hull_of("crumb").label
    assert was
    choices = tuple(map(ReviewChoice.of_label, ("leg", was)))
    question = ReviewQuestion("repair", "?", 2.65, 0.5, FIRST, 1, (HullPlace(FIRST, "crumb"),), choices, "r")
    project.reply(question, ReviewReply("r", was))
    (line,) = project.feedback().fixes.values()
    assert (line.hull, line.was, line.to, line.accepted) == ("crumb", was, "leg", False)
    assert project.mesh(FIRST).hull_of("crumb").annotation == Label(was, 1.0, "user")


def test_a_slip_in_an_answer_is_replaced_and_a_verdict_that_was_one_is_taken_back(project: Project) -> None:
    project.add_answer(Answer(1, SECOND, ["crumb"]))
    project.demonstrate(SECOND, ())
    project.set_verdict(THIRD, "accepted")
    for asset in (SECOND, THIRD):
        project.reply(selection_of(asset), ReviewReply("s", YES))
    meant = frozenset({"crumb", "left_low"})
    said = project.feedback()
    assert {line.asset: line.answer.select for line in said.answers.values()} == {SECOND: meant, THIRD: meant}
    assert THIRD not in said.verdicts


def test_an_output_that_stands_out_though_the_review_did_not_know_is_signed_off_by_no_tool(tmp_path: Path) -> None:
    project = learned(tmp_path)
    review(project)
    list(project.apply(execution=IN_PROCESS))
    odd = dict.fromkeys((SECOND, THIRD), ("volume +300%, the family +0%",))
    assert project.renew_sign_offs(odd, clock=lambda: NOON) == {}
    assert {asset: one.by for asset, one in project.sign_offs().items()} == {FIRST: "person", SECOND: "person"}
    assert project.renew_sign_offs(clock=lambda: NOON) == {} and THIRD not in project.sign_offs()
    status = next(one.result_status for one in project.status().assets if one.id == THIRD)
    assert (status.state, [doubt.kind for doubt in status.reasons]) == ("needs review", ["alarm"])
    review(project)
    assert sign_off_of(project, THIRD) == "signed off"


def test_an_output_that_is_found_to_stand_out_stays_signed_off_and_that_is_said(project: Project) -> None:
    review(project)
    assert project.renew_sign_offs({THIRD: ("volume +300%, the family +0%",)}, clock=lambda: NOON) == {}
    status = next(one.result_status for one in project.status().assets if one.id == THIRD)
    assert (status.state, status.found_since) == ("signed off", ("volume +300%, the family +0%",))


def test_a_sign_off_stays_at_a_lower_bar_and_is_taken_back_where_more_is_asked_for(project: Project) -> None:
    review(project)
    assert review(project, 0.4).taken_back == {}
    (why,) = review(project, 0.9999).taken_back.values()
    assert why.endswith("sure, and more is asked for now")
    assert project.sign_offs().keys() == {FIRST, SECOND}


def test_while_nothing_fits_what_was_shown_is_signed_off_no_longer_and_what_was_accepted_is(project: Project) -> None:
    project.set_verdict(THIRD, "accepted")
    assert review(project).assessment.looked_at == {FIRST, SECOND, THIRD}
    for asset, hull in ((FIRST, "top"), (SECOND, "crumb")):
        project.demonstrate(asset, [Step(1, {hull}, Delete())])
    found = review(project)
    assert found.outcome is not None and found.outcome.program is None
    assert found.assessment.looked_at == {THIRD}
    assert found.taken_back.keys() == {FIRST, SECOND}
    assert project.sign_offs().keys() == {THIRD}
