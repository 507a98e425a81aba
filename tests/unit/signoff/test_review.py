"""A family reviewed: what makes an edit doubtful, and which question is asked first."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from meshforge.label_model import model_family
from meshforge.language import Delete, Program
from meshforge.signoff import (
    BAR,
    Assessment,
    HullPlace,
    ReviewChoice,
    ReviewQuestion,
    ReviewReply,
    ReviewState,
    apply_reply,
    list_answers,
    review_family,
)
from meshforge.signoff.question import ASIDE, CORRECT, RIGHT, WRONG
from meshforge.symbolic import Label, SymbolicMesh
from meshforge.synthesis import Demonstration, LearningOutcome, Step, synthesize
from tests.synthesis_boxes import table

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
    """Some meshes with their legs deleted."""
    return {name: Demonstration(meshes[name], [Step(1, legs_of(name), Delete())], name) for name in names}


def learn(state: ReviewState) -> LearningOutcome | None:
    if not state.demos:
        return None
    said_of = [hull.annotation for mesh in state.meshes.values() for hull in mesh.hulls]
    posterior = model_family(list(state.meshes.values())).infer(said_of)
    demos = [Demonstration(state.meshes[name], one.steps, name) for name, one in state.demos.items()]
    return synthesize(demos, state.meshes, None, {}, LABELS, answers=list(list_answers(state, posterior)))


def review(state: ReviewState, bar: float = BAR) -> Assessment:
    return review_family(state, learn(state), model_family(list(state.meshes.values())), bar)


def test_before_anything_is_shown_a_demonstration_is_asked_for_and_nothing_is_sure() -> None:
    found = review(ReviewState(tables(), FRAME))
    assert found.question is not None
    assert found.question.kind == "demonstrate"
    assert found.signed_off == ()
    assert {one.probability for one in found.assets.values()} == {0.0}


def test_a_wrong_label_that_changes_the_edit_is_the_doubt_of_its_asset() -> None:
    meshes = tables(leg2_low="panel")
    found = review(ReviewState(meshes, FRAME, demos=shown(meshes, "t0")))
    worst = min(found.assets.values(), key=lambda one: one.probability)
    assert worst.asset == "t5"
    doubt = next(one for one in worst.doubts if one.kind == "label")
    assert doubt.hulls == ("leg2_low",)
    assert doubt.rule == 1
    assert "is called panel, and may be leg" in doubt.text


def test_a_wrong_label_that_changes_nothing_is_no_doubt() -> None:
    meshes = tables(litter0="handle")
    found = review(ReviewState(meshes, FRAME, demos=shown(meshes, "t0")))
    assert not [doubt for doubt in found.assets["t5"].doubts if doubt.kind == "label"]


def test_a_demonstrated_and_an_accepted_asset_are_signed_off_by_a_person() -> None:
    meshes = tables()
    done = (legs_of("t5"),)
    found = review(ReviewState(meshes, FRAME, demos=shown(meshes, "t0"), accepted={"t5": done}))
    assert {"t0", "t5"} <= found.looked_at
    assert {"t0", "t5"} <= set(found.signed_off)


def test_a_demonstrated_asset_is_not_signed_off_while_no_program_fits_and_an_accepted_one_is() -> None:
    meshes = tables()
    hulls = sorted(legs_of("t0"))
    odd = {"t0": Demonstration(meshes["t0"], [Step(1, frozenset(hulls[:1]), Delete())], "t0")}
    opposite = {"t3": Demonstration(meshes["t3"], [Step(1, frozenset(hulls[1:2]), Delete())], "t3")}
    found = review(ReviewState(meshes, FRAME, demos=odd | opposite, accepted={"t5": (legs_of("t5"),)}))
    assert found.question is not None and found.question.kind in ("demonstrate", "selection")
    assert found.looked_at == {"t5"} and found.signed_off == ("t5",)
    assert {"t0", "t3"} <= set(found.held)


def test_an_asset_set_aside_is_neither_signed_off_nor_held() -> None:
    meshes = tables(leg2_low="panel")
    found = review(ReviewState(meshes, FRAME, demos=shown(meshes, "t0"), aside=frozenset({"t5"})))
    assert "t5" not in (*found.signed_off, *found.held)


def test_the_queue_ends_whatever_is_said() -> None:
    meshes = tables(leg2_low="panel", top_0="misc")
    state, asked = ReviewState(meshes, FRAME, demos=shown(meshes, "t0")), list[str]()
    for _ in range(40):
        question = review(state, bar=0.999).question
        if question is None:
            break
        asked.append(question.id)
        state = apply_reply(state, question, reply_to(question), ())
    else:
        pytest.fail(f"asked {asked}")
    assert len(asked) == len(set(asked))


def reply_to(question: ReviewQuestion) -> ReviewReply:
    """The first choice; a result is right."""
    return ReviewReply(question.id, 0)


def test_what_is_put_off_is_not_asked_again() -> None:
    meshes = tables(leg2_low="panel")
    state = ReviewState(meshes, FRAME, demos=shown(meshes, "t0"))
    first = review(state).question
    assert first is not None
    second = review(apply_reply(state, first, ReviewReply(first.id, later=True))).question
    assert second is None or second.id != first.id


def test_a_label_that_is_told_is_a_persons_and_the_doubt_is_gone() -> None:
    meshes = tables(leg2_low="panel")
    state = ReviewState(meshes, FRAME, demos=shown(meshes, "t0"))
    place = HullPlace("t5", "leg2_low")
    question = ReviewQuestion("q", "group", "?", 3.0, 1.0, "t5", None, (place,), ())
    after = apply_reply(state, question, ReviewReply("q", None, {place: "leg"}))
    assert after.meshes["t5"].hull_of("leg2_low").annotation == Label("leg", 1.0, "user")
    found = review(after)
    assert not [doubt for doubt in found.assets["t5"].doubts if "leg2_low" in doubt.hulls]
    assert found.assets["t5"].probability > review(state).assets["t5"].probability


def test_a_mended_result_teaches_only_where_labels_are_trusted() -> None:
    meshes = tables(leg2_low="panel")
    wanted = (legs_of("t5"),)
    state = ReviewState(meshes, FRAME, demos=shown(meshes, "t0"), mended={"t5": wanted, "t4": wanted})
    said_of = [hull.annotation for mesh in meshes.values() for hull in mesh.hulls]
    posterior = model_family(list(meshes.values())).infer(said_of)
    assert "t5" not in {answer.asset for answer in list_answers(state, posterior)}


@pytest.mark.parametrize(("said_word", "kept"), [(RIGHT, "accepted"), (WRONG, "mended"), (ASIDE, "aside")])
def test_a_verdict_is_kept_where_it_belongs(said_word: str, kept: str) -> None:
    meshes = tables()
    state = ReviewState(meshes, FRAME, demos=shown(meshes, "t0"))
    held = review(state, bar=1.0)
    question = next(one for one in [held.question] if one)
    words = (RIGHT, WRONG, ASIDE)
    result = ReviewQuestion("r", "result", "?", 2.65, 0.5, "t5", None, (), tuple(map(ReviewChoice, words)))
    place = words.index(said_word)
    after = apply_reply(state, result, ReviewReply("r", place, mended=(frozenset(),)), (frozenset(),))
    assert "t5" in getattr(after, kept)
    assert question.seconds > 0


def test_a_program_that_cannot_run_on_an_asset_is_said_so() -> None:
    meshes = {**tables(), "bare": table().with_labels(dict.fromkeys(table().index))}
    found = review(ReviewState(meshes, FRAME, demos=shown(meshes, "t0")))
    assert found.assets["bare"].probability < 0.05
    assert found.assets["bare"].doubts[0].text == "the program cannot run: no hull has a label"


def test_nobody_is_asked_whether_a_result_is_right_that_cannot_be() -> None:
    meshes = {**tables(), "bare": table().with_labels(dict.fromkeys(table().index))}
    state = ReviewState(meshes, FRAME, demos=shown(meshes, "t0"))
    asked = []
    while question := review(state, bar=1.0).question:
        asked += [question] if question.kind == "result" else []
        state = apply_reply(state, question, ReviewReply(question.id, later=True))
    bare = [one for one in asked if one.asset == "bare"]
    assert [choice.text for one in bare for choice in one.choices] == [CORRECT, ASIDE]
    assert bare[0].text.startswith("The program cannot run on bare: no hull has a label. ")
    assert {choice.text for one in asked if one.asset != "bare" for choice in one.choices} == {RIGHT, WRONG, ASIDE}


def test_the_same_family_gives_the_same() -> None:
    meshes = tables(leg2_low="panel")
    state = ReviewState(meshes, FRAME, demos=shown(meshes, "t0"))
    assert review(state) == review(state)


def test_a_family_of_one_is_reviewed() -> None:
    meshes = tables(1)
    found = review(ReviewState(meshes, FRAME, demos=shown(meshes, "t0")))
    assert found.is_done
    assert found.question is None


def test_an_empty_family_is_done() -> None:
    found = review_family(ReviewState({}, FRAME), None, model_family([]))
    assert found.question is None
    assert found.is_done
