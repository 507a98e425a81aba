"""What becomes of a result that is called wrong, and of assets that are given up."""

from pathlib import Path

import pytest

from meshforge.formats import load
from meshforge.language import Delete, Each, Merge, Program
from meshforge.project import Project
from meshforge.signoff import THRESHOLD
from meshforge.signoff.reasons import CALLED_WRONG_BEFORE, CHANGED, CONTRADICTED
from meshforge.symbolic import Label
from meshforge.synthesis import Step
from tests.unit.cli.in_process import Run
from tests.unit.project.racks import BLOCK, LEGS, shown_racks
from tests.unit.project.replying import (
    ALSO,
    ASKED,
    LAST,
    OTHER,
    SHOWN,
    THREE,
    copy,
    find_question,
    look,
    probabilities,
    reply_by_method,
    say,
    write,
)


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the family, reviewed once."""
    folder = tmp_path_factory.mktemp("plain")
    look(shown_racks(folder))
    return folder


@pytest.fixture
def project(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    """Six racks of which two are demonstrated and one becomes a block."""
    return copy(made, tmp_path, monkeypatch)


def test_where_other_hulls_are_meant_the_output_is_made_with_these_and_signed_off_by_a_person(project: Project) -> None:
    found = say(project, "wrong", selections={"1": THREE})
    assert found.state.corrected == {ASKED} and ASKED in found.assessment.signed_off
    write(project, ASKED)
    project.renew_sign_offs()
    program = project.program()
    assert program is not None
    made = load(project.layout.edited / ASKED).hulls
    own = program.run(project.mesh(ASKED)).mesh.hulls
    assert (len(made), len(own)) == (5, 4), "the leg that is left out stays by itself"
    assert project.sign_offs()[ASKED].by == "person"
    status = next(one for one in project.status().assets if one.id == ASKED)
    assert (status.result_status.state, status.stale) == ("signed off", ())


def test_a_corrected_result_counts_for_a_program_from_when_on_it_does_what_was_meant(project: Project) -> None:
    before = probabilities(look(project))
    during = probabilities(say(project, "wrong", selections={"1": THREE}))
    assert during[OTHER] < before[OTHER]
    (project.folder / "program.mf").write_text("labels top, leg, rail\n\nDiff(Is(leg), Geo(Is(leg), +X)) => Delete\n")
    other = look(project)
    assert ASKED not in other.state.corrected, "it was said of rules that did something else"
    (project.folder / "program.mf").unlink()
    project.set_verdict(ASKED, None)
    again = say(project, "wrong", selections={"1": sorted(LEGS)})
    assert probabilities(again)[OTHER] > before[OTHER]


def test_labels_of_a_wrong_result_are_a_persons_and_it_needs_another_look(project: Project) -> None:
    found = say(project, "wrong", labels={"left_low": "rail"})
    assert project.mesh(ASKED).hull_of("left_low").annotation == Label("rail", 1.0, "user")
    assert ASKED in found.assessment.need_review
    assert found.assessment.assets[ASKED].reasons[0].text == CALLED_WRONG_BEFORE
    question = find_question(found, "result", ASKED)
    assert question.choice("right") is not None
    reply_by_method(project, question, {"choice": "right"})
    assert ASKED in look(project).assessment.signed_off


def test_what_cannot_be_said_of_a_wrong_result_is_refused_with_nothing_kept(project: Project) -> None:
    question = find_question(look(project), "result", ASKED)
    for fields, problem in (
        ({"selections": {"1": ["nobody"]}}, "nobody"),
        ({"selections": {"7": THREE}}, "there is no rule 7"),
        ({"labels": {"rail": "lek"}}, "lek"),
        ({"labels": {"nobody": "leg"}}, "nobody"),
    ):
        with pytest.raises(Exception, match=problem):
            reply_by_method(project, question, {"choice": "wrong", **fields})
        assert not project.layout.events.exists()
    assert project.mesh(ASKED).hull_of("rail").label == "rail"


def test_a_result_that_was_called_wrong_is_never_signed_off_without_another_look(project: Project) -> None:
    wrong = say(project, "wrong", OTHER)
    say(project, "right")
    project.set_labels(OTHER, {"left_low": "rail"})
    risen = say(project, "right", LAST)
    assert probabilities(risen)[OTHER] > probabilities(wrong)[OTHER]
    write(project)
    project.renew_sign_offs()
    assert OTHER in look(project).assessment.need_review and OTHER not in project.sign_offs()


def test_an_edit_by_hand_counts_as_a_wrong_result_also_once_it_is_accepted(project: Project) -> None:
    write(project)
    before = probabilities(look(project))
    project.correct(ASKED, ["top"], Delete())
    edited = look(project)
    assert ASKED in edited.assessment.need_review and probabilities(edited)[OTHER] < before[OTHER]
    accepted = say(project, "right")
    assert ASKED in accepted.assessment.signed_off
    assert "top" not in {hull.name for hull in load(project.layout.edited / ASKED).hulls}
    assert probabilities(accepted)[OTHER] == probabilities(edited)[OTHER]


def test_a_wrong_result_of_a_demonstrated_asset_needs_review_until_something_else_is_shown(project: Project) -> None:
    write(project)
    project.set_verdict(SHOWN, "wrong")
    assert SHOWN in look(project).assessment.need_review
    project.demonstrate(SHOWN, [Step(1, LEGS | {"rail"}, Each(Merge()))])
    project.set_labels(SHOWN, {"rail": "leg"})
    assert SHOWN in look(project).assessment.signed_off


def test_a_program_by_hand_that_contradicts_a_demonstration_is_the_first_reason_there(project: Project) -> None:
    before = probabilities(look(project))
    (project.folder / "program.mf").write_text("labels top, leg, rail\n\nGeo(Is(leg), +X) => Each(Merge)\n")
    found = look(project)
    assert {SHOWN, ALSO} <= set(found.assessment.need_review)
    assert found.assessment.assets[SHOWN].reasons[0].text == CONTRADICTED
    assert probabilities(found)[OTHER] < before[OTHER]
    accepted = say(project, "right", SHOWN)
    assert SHOWN in accepted.assessment.signed_off and ALSO in accepted.assessment.need_review


@pytest.mark.parametrize("text", ["Is(leg) => Delete", "Is(leg) => Each(Merge)\nIs(top) => Scale(all, 0.5)"])
def test_a_program_by_hand_with_another_action_or_one_more_contradicts_what_was_shown(
    project: Project, text: str
) -> None:
    (project.folder / "program.mf").write_text(f"labels top, leg, rail\n\n{text}\n")
    found = look(project).assessment
    assert {SHOWN, ALSO} <= set(found.need_review)
    assert found.assets[SHOWN].reasons[0].text == CONTRADICTED


def test_a_result_that_is_not_the_accepted_one_any_more_needs_review_however_sure_it_is(project: Project) -> None:
    write(project)
    accepted = say(project, "right", OTHER)
    assert OTHER in accepted.assessment.signed_off
    (project.folder / "program.mf").write_text("labels top, leg, rail\n\nIs(leg) => Delete\n")
    for written in (False, True):
        if written:
            write(project)
        found = look(project).assessment
        assert OTHER in found.need_review and CHANGED in {reason.text for reason in found.assets[OTHER].reasons}
    assert OTHER in say(project, "right", OTHER).assessment.signed_off


def test_an_accepted_result_that_comes_out_the_same_with_other_labels_stays_accepted(project: Project) -> None:
    write(project)
    say(project, "right", OTHER)
    project.set_labels(OTHER, {"rail": None})  # which no rule takes
    write(project)
    (row,) = [row for row in project.status(workers=0).assets if row.id == OTHER]
    assert (row.review, row.stale) == ("accepted", ())
    assert OTHER in look(project).assessment.signed_off


@pytest.mark.slow
def test_what_is_not_solved_counts_and_what_is_not_of_the_family_does_not(project: Project, run: Run) -> None:
    write(project)
    for asset in (BLOCK, ASKED):
        say(project, "not-of-family", asset)
    for asset in (OTHER, LAST):
        say(project, "right", asset)
    told = run("review", "racks")
    assert told.code == 0
    assert told.out.startswith(
        f"4 of 4 are at least {100 * THRESHOLD:g}% sure, or were looked at, 2 excluded: not of this family."
    )
    assert run("status", "racks", "--signed-off").code == 0
    project.set_verdict(BLOCK, None)
    say(project, "not-solved", BLOCK)
    run("review", "racks")
    told = run("status", "racks", "--signed-off")
    assert told.code == 1
    assert (
        f"4 of 5 are at least {100 * THRESHOLD:g}% sure, or were looked at, 1 excluded: not solved, 1 excluded: not of"
        in told.out
    )
    assert run("status", "racks", "--signed-off", "--allow-excluded").code == 0


@pytest.mark.parametrize("choice", ["not-of-family", "not-solved"])
def test_where_all_are_excluded_nothing_is_signed_off(project: Project, run: Run, choice: str) -> None:
    write(project)
    for asset in (SHOWN, ALSO):
        project.demonstrate(asset, ())
    project.accept(Program.parse("labels top, leg, rail\n\nDiff(Is(leg), Is(rail)) => Each(Merge)\n"))
    for asset in project.assets():
        found = look(project)
        reply_by_method(project, find_question(found, "result", asset), {"choice": choice})
    told = run("status", "racks", "--signed-off", "--allow-excluded")
    assert told.code == 1 and "Nothing is signed off" in told.out
