"""Suggested orientations: landmark pairs that bring demonstrations into a common frame."""

from collections.abc import Sequence

import pytest

from meshforge.common import DemonstrationError
from meshforge.language import (
    Action,
    Delete,
    Extractor,
    Merge,
    Orient,
    Program,
    Replace,
    show,
    size_of,
    to_canonical_frame,
)
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, Found, Options, Step, synthesize
from meshforge.synthesis.demonstration import collect_rule_specs
from meshforge.synthesis.options import TimeBudget
from meshforge.synthesis.orientation.attempts import MeshTurner
from meshforge.synthesis.orientation.suggest import Directives, OrientationSuggestion, suggest_orientation
from meshforge.synthesis.task import LearningTask
from tests.program_parts import parse_orient
from tests.synthesis_boxes import Piece, posed, rack, table, turned

LABELS = ("panel", "leg", "handle", "drawer", "misc")
UP = "orient +Z: Is(leg) -> Is(panel)"


def shown(mesh: SymbolicMesh, *starts: str, action: Action | None = None, name: str | None = None) -> Demonstration:
    """One step for each start of names: the hulls whose names begin so."""
    steps = [
        Step(k, {hull.name for hull in mesh.hulls if hull.name.startswith(start)}, action or Delete())
        for k, start in enumerate(starts, 1)
    ]
    return Demonstration(mesh, steps, name)


def learned_now(
    demos: Sequence[Demonstration], orient: Orient | None, labels: Sequence[str], options: Options
) -> tuple[Extractor, ...]:
    try:
        outcome = synthesize(demos, orient=orient, vocabulary=labels, options=options)
    except DemonstrationError:  # the rule of an open step did what a later step contradicts
        return ()
    return tuple(reading.extractor for reading in outcome.candidates) if isinstance(outcome, Found) else ()


def sizes_now(
    demos: Sequence[Demonstration], orient: Orient | None, labels: Sequence[str], options: Options
) -> tuple[int, ...] | None:
    return tuple(map(size_of, learned_now(demos, orient, labels, options))) or None


def task(
    demos: Sequence[Demonstration],
    orient: Orient | None = None,
    labels: Sequence[str] = LABELS,
    batch: Sequence[SymbolicMesh] = (),
    options: Options | None = None,
) -> LearningTask:
    family = {str(number): mesh for number, mesh in enumerate(batch)}
    rules, frame = collect_rule_specs(demos), Program(tuple(labels), orient)
    return LearningTask(rules, tuple(demos), family, frame, {}, (), frozenset(), options or Options())


def suggested(
    *demos: Demonstration,
    now: str | None = None,
    labels: Sequence[str] = LABELS,
    batch: Sequence[SymbolicMesh] = (),
    options: Options | None = None,
) -> OrientationSuggestion | None:
    """The suggestion, whose sizes are those that learning finds in its frame."""
    orient, options = parse_orient(now) if now else None, options or Options()
    known = learned_now(demos, orient, labels, options)
    found = suggest_orientation(task(demos, orient, labels, batch, options), TimeBudget(60.0), known)
    if found:
        assert found.sizes == sizes_now(demos, found.orient, labels, options)
        assert not known or sum(found.sizes) <= sum(map(size_of, known)) - 3
    return found


def directive(found: OrientationSuggestion | None) -> str | None:
    return show(found.orient) if found else None


def fronted(tops: int, height: float, depth: float) -> SymbolicMesh:
    """A rack with a handle on each of the four sides, and a drawer in front of it (-Y), high or low, near or far."""
    sides = [("front", 0.9, -1.0), ("back", 0.9, 2.8), ("left", -1.0, 0.9), ("right", 2.8, 0.9)]
    handles: list[Piece] = [(name, "handle", (x, y, height), (0.2, 0.2, 0.2)) for name, x, y in sides]
    return rack(tops=tops, extra=[*handles, ("drawer", "drawer", (0.8, -depth, 2.0 - height), (0.4, 0.4, 0.4))])


AS_IS = ((1, 0, 0), (0, 1, 0))
OVER = ((1, 0, 0), (0, -1, 0))
ROUND = ((0, 1, 0), (-1, 0, 0))
LYING = ((0, 1, 0), (0, 0, 1))
HANGING = ((0, 0, -1), (1, 0, 0))
TOPS = [rack(), posed(rack(tops=2), *LYING), posed(rack(tops=3), *OVER)]
TILTED = [rack(0.6, 2), posed(rack(-0.6, 3), *OVER), posed(rack(0.3, 2), *LYING)]
FRONTS = [
    posed(fronted(1, 0.2, 2.0), *AS_IS),
    posed(fronted(2, 1.8, 4.0), *ROUND),
    posed(fronted(3, 1.0, 1.5), *OVER),
    posed(fronted(2, 0.4, 3.0), *LYING),
    posed(fronted(1, 2.0, 6.0), *HANGING),
]


def tops(meshes: Sequence[SymbolicMesh]) -> list[Demonstration]:
    return [shown(mesh, "top") for mesh in meshes]


def test_two_racks_one_on_its_side_are_brought_upright() -> None:
    demos = [shown(rack(), "top"), shown(turned(rack(tops=2), "YZX"), "top")]
    found = suggested(*demos)
    assert directive(found) == UP
    assert found and found.sizes == (2,)
    assert found.why == (
        "in the frame where +Z points from the leg hulls to the panel hulls, the rule has an extractor, of 2 nodes, "
        "instead of 5 nodes now"
    )


def test_tables_with_two_rules_are_brought_upright() -> None:
    meshes = [table(), turned(table(drawers=2), "YZX"), turned(table(drawers=3, litter=3), "ZXY")]
    found = suggested(*[shown(mesh, "top", "knob") for mesh in meshes])
    assert directive(found) == UP
    assert found and found.why.endswith("every rule has an extractor, of 2 and 2 nodes, instead of 3 and 5 nodes now")


def test_demonstrations_that_no_extractor_fits_as_they_come_are_made_consistent() -> None:
    assert sizes_now(tops(TILTED), None, LABELS, Options()) is None
    found = suggested(*tops(TILTED))
    assert found and found.sizes == (2,)


def test_nothing_is_suggested_where_the_present_frame_is_as_good() -> None:
    assert suggested(*tops([rack(), rack(0.1, 2)])) is None
    assert suggested(*tops([rack(), turned(rack(tops=2), "YZX")]), now=UP) is None
    assert suggested(*[shown(mesh, "board") for mesh in (rack(), rack(0.1, 2))]) is None


def test_a_frame_that_saves_less_than_a_line_costs_is_not_suggested() -> None:
    meshes = [table(), turned(table(drawers=2), "YZX")]
    demos = [shown(mesh, "top") for mesh in meshes]
    assert sizes_now(demos, None, LABELS, Options()) == (3,)
    assert sizes_now(demos, parse_orient(UP), LABELS, Options()) == (2,)
    assert suggested(*demos) is None


def test_snap_is_suggested_where_only_snap_makes_the_frame_common() -> None:
    found = suggested(*tops(TILTED))
    assert found and found.orient.snap and len(found.orient.pairs) == 1
    assert "of quarter turns where, as nearly as can be, +Z points from the panel" in found.why


def test_snap_alone_is_changed_where_that_is_enough() -> None:
    assert directive(suggested(*tops(TILTED), now=UP)) == UP.replace("orient", "orient snap")
    both = "orient +Z: Is(leg) -> Is(panel), +Y: Is(leg) -> Is(misc)"
    aside: Piece = ("misc", "misc", (0.9, 5.0, 2.0), (0.2, 0.2, 0.2))
    meshes = [rack(0.6, 2, [aside]), posed(rack(-0.6, 3, [aside]), *LYING), posed(rack(0.3, 2, [aside]), *OVER)]
    assert directive(suggested(*tops(meshes), now=both)) == both.replace("orient", "orient snap")


@pytest.mark.slow
@pytest.mark.parametrize("now", [None, UP])
def test_a_second_pair_is_found_where_one_is_not_enough_and_keeps_the_one_that_is_given(now: str | None) -> None:
    found = suggested(*[shown(mesh, "top", "front") for mesh in FRONTS], now=now)
    assert found and len(found.orient.pairs) == 2 and found.sizes == (2, 2)
    assert not now or found.orient.pairs[0] == parse_orient(now).pairs[0]


def test_a_pair_that_is_given_is_replaced_where_keeping_it_does_not_help() -> None:
    aside: Piece = ("misc", "misc", (0.9, 0.9, 3.0), (0.2, 0.2, 0.2))
    below: Piece = ("misc", "misc", (0.9, 0.9, -3.0), (0.2, 0.2, 0.2))
    demos = tops([rack(extra=[aside]), rack(tops=2, extra=[below]), posed(rack(tops=3, extra=[aside]), *LYING)])
    assert directive(suggested(*demos, now="orient +Z: Is(panel) -> Is(misc)")) == UP


def test_a_frame_that_fails_on_a_demonstrated_mesh_is_never_suggested() -> None:
    legless = rack(tops=2)
    legless = legless.with_hulls(hull for hull in legless.hulls if hull.label != "leg")
    demos = tops([*TOPS, posed(legless, *HANGING)])
    assert suggested(*demos) is None
    mark: Piece = ("mark", "misc", (0.9, 0.9, 3.0), (0.2, 0.2, 0.2))
    marked = [*TOPS[1:], rack(extra=[mark]), posed(legless, *HANGING)]
    assert suggested(*tops(marked)) is None


def test_the_axis_is_the_one_that_turns_the_fewest_assets() -> None:
    lying = [turned(rack(tops=k), "YZX") for k in (2, 3)]
    demos = tops([rack(), *lying])
    assert directive(suggested(*demos)) == "orient +X: Is(leg) -> Is(panel)"
    assert directive(suggested(*demos, batch=[rack(0.01 * k) for k in range(3)])) == UP
    assert directive(suggested(*demos, batch=[*lying, rack()])) == UP, "a demonstrated mesh counts once"


def test_of_pairs_as_good_the_one_is_suggested_that_holds_on_most_of_the_batch() -> None:
    mark: Piece = ("mark", "misc", (0.9, 0.9, 3.0), (0.2, 0.2, 0.2))
    demos = tops([rack(extra=[mark]), turned(rack(tops=2, extra=[mark]), "YZX")])
    assert directive(suggested(*demos)) == UP
    legless = [mesh.with_hulls(mesh.hulls[1:]) for mesh in (rack(extra=[mark]), rack(tops=2, extra=[mark]))]
    assert directive(suggested(*demos, batch=legless)) == "orient +Z: Is(panel) -> Is(misc)"


@pytest.mark.slow
@pytest.mark.parametrize("meshes", [TOPS, TILTED, FRONTS[:3]])
def test_the_order_of_the_demonstrations_does_not_matter(meshes: list[SymbolicMesh]) -> None:
    found = [suggested(*tops(order)) for order in (meshes, meshes[::-1], [*meshes[1:], meshes[0]])]
    assert found[0] and all(other == found[0] for other in found)


def test_what_earlier_rules_make_is_met_by_later_ones_in_the_frame() -> None:
    demos = [
        Demonstration(mesh, [Step(1, {"board_0", "board_1"}, Merge()), Step(2, {"board_0~1"}, Replace("box"))])
        for mesh in (rack(), turned(rack(tops=2), "YZX"), turned(rack(tops=3), "ZXY"))
    ]
    found = suggested(*demos)
    assert found and found.sizes == (4, 2)


def test_an_open_step_is_filled_in_by_the_rule_of_the_frame() -> None:
    meshes = (rack(), turned(rack(tops=2), "YZX"), turned(rack(tops=3), "ZXY"))
    demos = [shown(mesh, "top", "board_1") for mesh in meshes[:2]]
    found = suggested(*demos, Demonstration(meshes[2], [Step(1, None, Delete()), Step(2, {"board_1"}, Delete())]))
    assert directive(found) == UP
    assert found and found.sizes == (2, 2)


@pytest.mark.parametrize("text", [UP, UP.replace("orient", "orient snap"), "orient +X: All -> Is(drawer)"])
@pytest.mark.parametrize("contact", [None, 0.05])
def test_a_mesh_is_turned_as_a_run_does_it(text: str, contact: float | None) -> None:
    orient = parse_orient(text)
    for mesh in (table(drawers=2), turned(table(), "YZX")):
        staged, _ = to_canonical_frame(mesh, orient, contact)
        mine, _ = MeshTurner(mesh, contact).turn(orient)
        assert mine.contacts == staged.contacts and mine.contacts
        assert mine.graph.keys() == staged.graph.keys()
        assert mine.contact_distance == staged.contact_distance
        assert [hull.aabb.min.tolist() for hull in mine.hulls] == [hull.aabb.min.tolist() for hull in staged.hulls]


@pytest.mark.slow
@pytest.mark.parametrize("meshes", [TOPS, TILTED, FRONTS[:3]])
def test_no_directive_with_one_pair_does_better(meshes: list[SymbolicMesh]) -> None:
    demos, options = tops(meshes), Options(max_size=7)
    tried = [sizes_now(demos, o, LABELS, options) for o in Directives(meshes, [], LABELS).with_one_pair()]
    found = suggested(*demos, options=options)
    assert found and sum(found.sizes) <= min(sum(sizes) for sizes in tried if sizes)
