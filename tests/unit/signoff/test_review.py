"""A family reviewed: what makes an edit doubtful, and which question is asked first."""

from collections.abc import Mapping
from dataclasses import replace

import pytest

from meshforge.common import ProgramError
from meshforge.label_model import model_family
from meshforge.language import Delete, Program
from meshforge.signoff import THRESHOLD, Assessment, ExclusionReason, ReviewQuestion, ReviewState, review_family
from meshforge.signoff.assessment import NO_EDIT
from meshforge.signoff.program_run import run_on_asset
from meshforge.signoff.question import EXCLUDE, NO, NOT_OF_FAMILY, NOT_SOLVED, RIGHT, WRONG
from meshforge.symbolic import Label, SymbolicMesh
from meshforge.synthesis import (
    Ambiguous,
    Answer,
    Demonstration,
    Found,
    LearningOutcome,
    OrientationSuggestion,
    Step,
    synthesize,
)
from tests.synthesis_boxes import table, turned

LABELS = ("drawer", "handle", "leg", "misc", "panel")
FRAME = Program(LABELS, None, ())


def said(mesh: SymbolicMesh, **other: str | None) -> SymbolicMesh:
    """A mesh whose labels come from a model, some of them others."""
    labels = {hull.name: other.get(hull.name, hull.label) for hull in mesh.hulls}
    return mesh.with_labels({name: Label(one, 0.9, "vlm") if one else None for name, one in labels.items()})


def tables(count: int = 6, **other: str | None) -> dict[str, SymbolicMesh]:
    """Tables, the last with some labels that are others."""
    found = {f"t{k}": said(table(legs=4, drawers=k % 3)) for k in range(count)}
    last = f"t{count - 1}"
    return {**found, last: said(found[last], **other)}


def legs_of(name: str) -> frozenset[str]:
    """The legs of a table by its name, whatever they are called."""
    return frozenset(hull.name for hull in table(drawers=int(name[1:]) % 3).hulls if hull.label == "leg")


def shown(meshes: Mapping[str, SymbolicMesh], *names: str) -> dict[str, Demonstration]:
    return {name: Demonstration(meshes[name], [Step(1, legs_of(name), Delete())], name) for name in names}


def learn(state: ReviewState) -> LearningOutcome | None:
    """What a program is learned from: demonstrations, answers, and what a person said of results."""
    if not state.demos:
        return None
    demos = [Demonstration(state.meshes[name], one.steps, name) for name, one in state.demos.items()]
    meant = [Answer(rule, name, some) for name, done in state.meant.items() for rule, some in enumerate(done, 1)]
    return synthesize(demos, state.meshes, None, {}, LABELS, answers=[*state.answers, *meant])


def review(state: ReviewState, bar: float = THRESHOLD) -> Assessment:
    return review_family(state, learn(state), model_family(list(state.meshes.values())), bar)


def snooze(state: ReviewState, question: ReviewQuestion) -> ReviewState:
    return replace(state, snoozed=state.snoozed | {question.id})


def accept(state: ReviewState, asset: str, *done: frozenset[str]) -> ReviewState:
    return replace(state, accepted=state.accepted | {asset}, meant={**state.meant, asset: done})


def test_before_anything_is_shown_a_demonstration_is_asked_for_and_nothing_is_sure() -> None:
    found = review(ReviewState(tables(), FRAME))
    assert found.question is not None
    assert found.question.kind == "demonstrate"
    assert found.signed_off == ()
    assert {one.probability for one in found.assets.values()} == {0.0}


def test_a_wrong_label_that_changes_the_edit_is_the_doubt_of_its_asset() -> None:
    meshes = tables(leg2_low="panel")
    found = review(ReviewState(meshes, FRAME, demos=shown(meshes, "t0")))
    worst = found.assets["t5"]
    assert worst.confidence == min(one.confidence for one in found.assets.values())
    doubt = next(one for one in worst.reasons if one.kind == "label")
    assert doubt.hulls == ("leg2_low",)
    assert doubt.rule == 1
    assert "is called panel, and may be leg" in doubt.text


def test_a_wrong_label_that_changes_nothing_is_no_doubt() -> None:
    meshes = tables(litter0="handle")
    found = review(ReviewState(meshes, FRAME, demos=shown(meshes, "t0")))
    assert not [doubt for doubt in found.assets["t5"].reasons if doubt.kind == "label"]


def test_a_demonstrated_and_an_accepted_asset_are_signed_off_by_a_person() -> None:
    meshes = tables()
    found = review(accept(ReviewState(meshes, FRAME, demos=shown(meshes, "t0")), "t5", legs_of("t5")))
    assert {"t0", "t5"} <= found.looked_at
    assert {"t0", "t5"} <= set(found.signed_off)


def test_a_demonstrated_asset_is_not_signed_off_while_no_program_fits_and_an_accepted_one_is() -> None:
    meshes = tables()
    hulls = sorted(legs_of("t0"))
    odd = {"t0": Demonstration(meshes["t0"], [Step(1, frozenset(hulls[:1]), Delete())], "t0")}
    opposite = {"t3": Demonstration(meshes["t3"], [Step(1, frozenset(hulls[1:2]), Delete())], "t3")}
    found = review(accept(ReviewState(meshes, FRAME, demos=odd | opposite), "t5", legs_of("t5")))
    assert found.question is not None and found.question.kind in ("demonstrate", "selection")
    assert found.looked_at == {"t5"} and found.signed_off == ("t5",)
    assert {"t0", "t3"} <= set(found.need_review)


@pytest.mark.parametrize("reason", [NOT_OF_FAMILY, NOT_SOLVED])
def test_an_asset_that_is_excluded_is_neither_signed_off_nor_held(reason: ExclusionReason) -> None:
    meshes = tables(leg2_low="panel")
    found = review(ReviewState(meshes, FRAME, demos=shown(meshes, "t0"), excluded={"t5": reason}))
    assert "t5" not in (*found.signed_off, *found.need_review)
    assert found.excluded == {"t5": reason}


def test_a_result_that_was_called_wrong_is_held_and_improbable_while_it_stays() -> None:
    meshes = tables()
    state = ReviewState(meshes, FRAME, demos=shown(meshes, "t0"), wrong=frozenset({"t5"}))
    found = review(replace(state, failed={"t5": (legs_of("t5"),)}))
    assert "t5" in found.need_review
    assert found.assets["t5"].confidence <= NO_EDIT
    assert found.assets["t5"].reasons[0].text == "a person said that this result is wrong"
    other = review(replace(state, failed={"t5": (frozenset(),)}))
    assert "t5" in other.need_review, "nobody looked at the one that is there now"
    assert other.assets["t5"].confidence > 0.5


def test_the_queue_ends_whatever_is_said() -> None:
    meshes = tables(leg2_low="panel", top_0="misc")
    state, asked = ReviewState(meshes, FRAME, demos=shown(meshes, "t0")), list[str]()
    for _ in range(40):
        question = review(state, bar=0.999).question
        if question is None:
            break
        asked.append(question.id)
        state = take_first(state, question)
    else:
        pytest.fail(f"asked {asked}")
    assert len(asked) == len(set(asked))


def take_first(state: ReviewState, question: ReviewQuestion) -> ReviewState:
    """What is known after the first choice of a question; a result is right."""
    first = next(iter(question.choices), None)
    match question.kind:
        case "group" | "repair":
            meshes = dict(state.meshes)
            for place in question.hulls:
                label = Label(first.label, 1.0, "user") if first and first.label else None
                meshes[place.asset] = meshes[place.asset].with_labels({place.hull: label})
            return snooze(replace(state, meshes=meshes), question)
        case "candidate" | "label":
            assert first and first.select is not None and question.rule
            answer = Answer(question.rule, question.asset, first.select)
            return replace(state, answers=(*state.answers, answer))
        case "result" if first and first.id == RIGHT:
            return accept(state, question.asset, legs_of(question.asset))
        case "selection" | "orientation":
            assert first and first.id == NO
    return snooze(state, question)


def test_what_is_put_off_is_not_asked_again() -> None:
    meshes = tables(leg2_low="panel")
    state = ReviewState(meshes, FRAME, demos=shown(meshes, "t0"))
    first = review(state).question
    assert first is not None
    second = review(snooze(state, first)).question
    assert second is None or second.id != first.id


def test_all_questions_are_listed_what_is_worth_most_first() -> None:
    meshes = tables(leg2_low="panel")
    found = review(ReviewState(meshes, FRAME, demos=shown(meshes, "t0")), bar=0.999)
    worths = [one.worth for one in found.questions]
    assert found.question is found.questions[0]
    assert worths == sorted(worths, reverse=True)
    assert len({one.id for one in found.questions}) == len(worths) > 1


def test_with_a_label_that_is_told_the_doubt_is_gone() -> None:
    meshes = tables(leg2_low="panel")
    state = ReviewState(meshes, FRAME, demos=shown(meshes, "t0"))
    told = {**meshes, "t5": meshes["t5"].with_labels({"leg2_low": Label("leg", 1.0, "user")})}
    found = review(replace(state, meshes=told))
    assert not [doubt for doubt in found.assets["t5"].reasons if "leg2_low" in doubt.hulls]
    assert found.assets["t5"].confidence > review(state).assets["t5"].confidence


def test_a_program_that_cannot_run_on_an_asset_is_said_so() -> None:
    meshes = {**tables(), "bare": table().with_labels(dict.fromkeys(table().index))}
    found = review(ReviewState(meshes, FRAME, demos=shown(meshes, "t0")))
    assert found.assets["bare"].confidence < 0.05
    assert found.assets["bare"].reasons[0].text == "the program cannot run: no labels, though the program asks for some"


@pytest.mark.parametrize(("text", "runs"), [("All => Replace(box)", True), ("Is(leg) => Delete", False)])
def test_only_a_program_that_asks_for_labels_needs_some(text: str, runs: bool) -> None:
    bare = table().with_labels(dict.fromkeys(table().index))
    program = Program.parse(f"labels leg, panel\n\n{text}\n")
    assert (run_on_asset("bare", bare, program, {}).error is None) == runs
    if runs:
        assert program.run(bare).mesh.hulls
    else:
        with pytest.raises(ProgramError, match="no labels"):
            program.run(bare)


def test_nobody_is_asked_whether_a_result_is_right_that_cannot_be() -> None:
    meshes = {**tables(), "bare": table().with_labels(dict.fromkeys(table().index))}
    state = ReviewState(meshes, FRAME, demos=shown(meshes, "t0"))
    asked = []
    while question := review(state, bar=1.0).question:
        asked += [question] if question.kind == "result" else []
        state = snooze(state, question)
    bare = [one for one in asked if one.asset == "bare"]
    assert not bare, "it is to be labelled first"
    others = {choice.id for one in asked if one.asset != "bare" for choice in one.choices}
    assert others == {RIGHT, WRONG, *EXCLUDE}


def test_an_empty_family_is_done() -> None:
    found = review_family(ReviewState({}, FRAME), None, model_family([]))
    assert found.question is None
    assert found.is_done


def test_who_refused_to_turn_the_assets_is_not_asked_to_turn_another_one() -> None:
    meshes = {name: turned(mesh, "YZX") if name in ("t1", "t2") else mesh for name, mesh in tables().items()}
    state = ReviewState(meshes, FRAME, demos=shown(meshes, "t0"))
    outcome = learn(state)
    assert isinstance(outcome, Found | Ambiguous)

    def asked(state: ReviewState, asset: str) -> list[ReviewQuestion]:
        orient = Program.parse("orient +Z: Is(leg) -> Is(panel)\n").orient
        assert orient
        suggested = OrientationSuggestion(orient, (3,), "it is shorter", (5,), (asset,))
        found = review_family(state, replace(outcome, suggested=suggested), model_family(list(meshes.values())))
        return [one for one in found.questions if one.kind == "orientation"]

    (first,), (other,) = asked(state, "t1"), asked(state, "t2")
    assert (first.asset, other.asset) == ("t1", "t2")
    assert first.choices[0].id == NO
    assert asked(snooze(state, first), "t2") == []
