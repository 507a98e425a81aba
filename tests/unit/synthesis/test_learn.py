"""Learning programs: evidence, replay, vocabulary, thresholds and limits."""

from itertools import count

import pytest

from meshforge.common import DemonstrationError, ProgramError
from meshforge.language import (
    All,
    Attach,
    Delete,
    Extractor,
    Geo,
    Is,
    LandmarkPair,
    Merge,
    Orient,
    Replace,
    Rule,
    Template,
)
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Ambiguous, Demonstration, Found, NoProgram, Options, Step, TimedOut, synthesize
from meshforge.synthesis.options import Clock
from tests.synthesis_boxes import boxes
from tests.unit.language.scenes import box

CUPBOARD = boxes(
    ("case", "body", (0, 0, 0), (4, 4, 4)),
    ("drawer", "drawer", (0, -1, 0), (4, 1, 2)),
    ("pull", "handle", (1, -2, 0), (1, 1, 0.5)),
)
WITH_DOOR = boxes(
    ("case", "body", (0, 0, 0), (4, 4, 4)),
    ("door", "door", (4, 0, 0), (1, 4, 4)),
    ("knob", "handle", (5, 1, 1), (1, 1, 1)),
)


def found(*demos: Demonstration, **settings: float) -> Found | Ambiguous:
    outcome = synthesize(demos, options=Options(**settings))  # type: ignore[arg-type]
    assert isinstance(outcome, Found | Ambiguous)
    return outcome


def extractors(outcome: Found | Ambiguous) -> list[Extractor]:
    return [rule.extractor for rule in outcome.program.rules]


def test_nothing_is_evidence() -> None:
    shown = Demonstration(CUPBOARD, [Step(1, {"pull"}, Delete())])
    assert extractors(found(shown)) == [Is("handle")]
    nothing = Demonstration(WITH_DOOR, [Step(1, [], Delete())])
    assert extractors(found(shown, nothing)) == [Attach(Is("handle"), Is("drawer"))]


def test_open_is_no_evidence() -> None:
    shown = Demonstration(CUPBOARD, [Step(1, {"pull"}, Delete())])
    silent = Demonstration(WITH_DOOR, [Step(1, None, Delete())])
    assert extractors(found(shown, silent)) == [Is("handle")]


def test_an_open_step_replays_the_learned_rule() -> None:
    shown = Demonstration(CUPBOARD, [Step(1, {"pull"}, Delete()), Step(2, {"case", "drawer"}, Merge())])
    after = Demonstration(WITH_DOOR, [Step(1, None, Delete()), Step(2, {"case", "door"}, Merge())])
    assert extractors(found(shown, after)) == [Is("handle"), All()]


def test_a_shown_step_may_name_what_an_earlier_one_made() -> None:
    steps = [Step(1, {"case", "drawer"}, Merge(), "corpus"), Step(2, {"case~1"}, Replace("box"))]
    outcome = found(Demonstration(CUPBOARD, steps))
    assert [rule.label for rule in outcome.program.rules] == ["corpus", None]
    assert outcome.program.rules[1] == Rule(Is("corpus"), Replace("box"))


def test_the_vocabulary_is_every_label_of_demonstrations_batch_and_steps() -> None:
    demo = Demonstration(CUPBOARD, [Step(1, {"pull"}, Merge(), "grip")])
    outcome = synthesize([demo], family=iter([WITH_DOOR]))
    assert isinstance(outcome, Found | Ambiguous)
    assert outcome.program.labels == ("body", "door", "drawer", "grip", "handle")


def test_a_given_vocabulary_is_declared_in_its_order_and_decides_between_equals() -> None:
    mesh = boxes(
        ("a", "x", (0, 0, 0), (1, 1, 1)),
        ("b", "y", (1, 0, 0), (1, 1, 1)),
        ("c", "z", (0, 1, 0), (1, 1, 1)),
        ("d", "x", (0, 0, 5), (1, 1, 1)),
        ("e", "x", (5, 0, -5), (1, 1, 1)),
        ("f", "x", (-5, 5, 1), (1, 1, 1)),
        ("g", "x", (3, -5, 1), (1, 1, 1)),
    )
    demo = Demonstration(mesh, [Step(1, {"a"}, Delete())])
    for vocabulary, anchor in ((("x", "y", "z"), "y"), (("z", "y", "x"), "z")):
        outcome = synthesize([demo], vocabulary=vocabulary)
        assert isinstance(outcome, Found)
        assert outcome.program.labels == vocabulary
        assert extractors(outcome) == [Attach(Is("x"), Is(anchor))]


def test_thresholds_are_used_and_declared() -> None:
    mesh = boxes(
        ("high", "x", (0, 0, 0), (1, 1, 10)),
        ("lower", "x", (2, 0, 0), (1, 1, 9)),
        ("lowest", "x", (4, 0, 0), (1, 1, 5)),
    )
    demo = Demonstration(mesh, [Step(1, {"high", "lower"}, Delete())])
    outcome = found(demo, extremity=0.2)
    assert extractors(outcome) == [Geo(Is("x"), "+Z")]
    assert outcome.program.extremity == 0.2
    near = boxes(
        ("a", "x", (0, 0, 0), (1, 1, 1)), ("b", "y", (1.1, 0, 0), (1, 1, 1)), ("c", "x", (1.1, 9, 9), (0.2, 0.2, 0.2))
    )
    by_contact = Demonstration(near, [Step(1, {"a"}, Delete())])
    assert found(by_contact, contact=0.05).program.contact == 0.05


def test_orientation_that_fails_names_the_demonstration() -> None:
    orient = Orient((LandmarkPair("+Z", Is("leg"), Is("panel")),))
    with pytest.raises(ProgramError, match="cupboard"):
        synthesize([Demonstration(CUPBOARD, [Step(1, {"pull"}, Delete())], "cupboard")], orient=orient)


def test_a_demonstration_without_labels_cannot_carry_a_program_that_asks_for_some() -> None:
    bare = boxes(("case", None, (0, 0, 0), (1, 1, 1)))
    shown = Demonstration(CUPBOARD, [Step(1, {"pull"}, Delete())])
    with pytest.raises(ProgramError, match="bare: no labels"):
        synthesize([shown, Demonstration(bare, [Step(1, [], Delete())], "bare")])


@pytest.mark.parametrize(
    ("layers", "extractor"),
    [
        ("S+T+G", Geo(Is("handle"), "+Z")),
        ("S+G", Geo(Is("handle"), "+Z")),
        ("S+T", Attach(Is("handle"), Is("drawer"))),
        ("S", None),
    ],
)
def test_layers_limit_what_the_search_may_use(layers: str, extractor: Extractor | None) -> None:
    mesh = SymbolicMesh(CUPBOARD.hulls + boxes(("low", "handle", (1, 9, -1), (1, 1, 0.5))).hulls)
    demo = Demonstration(mesh, [Step(1, {"pull"}, Delete())])
    outcome = synthesize([demo], options=Options(layers=layers, repair=False))  # type: ignore[arg-type]
    if extractor is None:
        assert isinstance(outcome, NoProgram)
        assert "'pull' of demonstration 1 was selected and 'low' of demonstration 1 was not" in outcome.why
    else:
        assert isinstance(outcome, Found)
        assert extractors(outcome) == [extractor]


def test_a_limit_of_size_that_is_too_low_gives_the_nearest_miss() -> None:
    shown = Demonstration(CUPBOARD, [Step(1, {"pull"}, Delete())])
    nothing = Demonstration(WITH_DOOR, [Step(1, [], Delete())], "with a door")
    outcome = synthesize([shown, nothing], options=Options(max_size=2, repair=False))
    assert isinstance(outcome, NoProgram)
    assert outcome.why == "no extractor of up to 2 nodes matches"


def ticking() -> Clock:
    ticks = count()
    return lambda: float(next(ticks))


def test_time_that_runs_out_gives_the_rules_so_far_and_the_nearest_miss() -> None:
    steps_apart = boxes(*((f"h{k}", f"l{k}", (3 * k, 5 * k % 7, 3 * k % 5), (1, 1, 1)) for k in range(9)))
    steps = [Step(1, {"h8"}, Delete()), Step(2, {"h1", "h3", "h5", "h7"}, Delete())]
    outcome = synthesize([Demonstration(steps_apart, steps)], options=Options(budget=20, clock=ticking()))
    assert isinstance(outcome, TimedOut)
    assert [rule.extractor for rule in outcome.rules] == [Is("l8")]
    assert [(reading.rule, reading.extractor) for reading in outcome.candidates] == [(1, Is("l8"))]
    assert outcome.program is None
    assert outcome.nearest is not None
    assert outcome.nearest.rule == 2
    assert outcome.nearest.missing


def test_no_time_at_all_gives_no_rule() -> None:
    demo = Demonstration(CUPBOARD, [Step(1, {"case", "pull"}, Delete())])
    outcome = synthesize([demo], options=Options(budget=0, clock=ticking()))
    assert isinstance(outcome, TimedOut)
    assert outcome.rules == ()


def test_a_template_that_changed_is_another_one_though_its_name_is_the_same() -> None:
    part, other = box([0, 0, 0], [1, 1, 1]), box([2, 0, 0], [3, 1, 1])
    shown = Demonstration(CUPBOARD, [Step(1, {"drawer"}, Replace("tray.obj")), Step(2, {"drawer~2"}, Delete())])
    both = synthesize([shown], templates={"tray.obj": Template((part, other), "tray.obj")})
    assert isinstance(both, Found | Ambiguous)
    with pytest.raises(DemonstrationError, match="drawer~2"):
        synthesize([shown], templates={"tray.obj": Template((part,), "tray.obj")})
    assert Template((part,), "a").digest == Template((box([0, 0, 0], [1, 1, 1]),), "b").digest
    assert len({Template(shapes, "a").digest for shapes in ((part,), (other,), (part, other), (other, part))}) == 4
