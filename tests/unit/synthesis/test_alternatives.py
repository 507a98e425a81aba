"""Orientations that are suggested beside a program, since its rules are more doubtful in the files' own frames."""

from collections.abc import Mapping

import numpy as np
import pytest

from meshforge.language import Delete, Is, LandmarkPair, Replace, parse_extractor, show
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Demonstration, Found, LearningOutcome, Options, Step, outcome_to_json, synthesize
from meshforge.synthesis.demonstration import collect_rule_specs
from meshforge.synthesis.orientation.alternatives import FrameCosts, cost_extractor
from meshforge.synthesis.orientation.landmarks import Landmarks
from tests.program_parts import parse_action
from tests.synthesis_boxes import posed, rack

LABELS = ("panel", "leg")
UP = "orient +Z: Is(leg) -> Is(panel)"


def tilted(mesh: SymbolicMesh, degrees: float) -> SymbolicMesh:
    """The mesh turned about its X axis."""
    cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return posed(mesh, (1, 0, 0), (0, cosine, sine))


def upright(count: int = 9) -> dict[str, SymbolicMesh]:
    """Racks whose foot is right below their boards, so that landmarks lie along Z."""
    return {f"rack {k}": rack(0.02 * k - 0.1, 1 + k % 3) for k in range(count)}


def leaning() -> dict[str, SymbolicMesh]:
    """The same, every third so far over that its topmost board is no longer its highest."""
    return {name: tilted(mesh, 75.0 if k % 3 == 2 else 0.0) for k, (name, mesh) in enumerate(upright().items())}


def learn(meshes: Mapping[str, SymbolicMesh], *names: str, options: Options | None = None) -> LearningOutcome:
    """Of the named meshes the topmost boards are deleted."""
    demos = [
        Demonstration(
            meshes[name], [Step(1, {h.name for h in meshes[name].hulls if h.name[:3] == "top"}, Delete())], name
        )
        for name in names
    ]
    return synthesize(demos, meshes, vocabulary=LABELS, options=options or Options())


def test_a_frame_is_suggested_beside_a_program_that_fits_where_assets_lie_differently() -> None:
    outcome = learn(leaning(), "rack 1")
    assert outcome.program and outcome.suggested
    assert show(outcome.suggested.orient) == UP
    assert outcome.suggested.before == outcome.suggested.sizes == (2,)
    assert outcome.suggested.differs_on == ("rack 2", "rack 5", "rack 8")
    assert outcome.suggested.why == (
        "in the frame where +Z points from the leg hulls to the panel hulls, the rule has an extractor, of 2 nodes, "
        "and selects something else than now on 3 assets"
    )


def test_the_suggestion_is_in_the_json_with_its_sizes() -> None:
    found = outcome_to_json(learn(leaning(), "rack 1"))
    assert found["suggested_orientation"] == UP
    assert found["suggested_because"]["sizes"] == found["suggested_because"]["sizes_before"] == [2]
    assert found["suggested_because"]["differs_on"] == ["rack 2", "rack 5", "rack 8"]


def test_a_contortion_gives_way_to_a_frame_in_which_the_rule_is_plain() -> None:
    meshes = leaning()
    outcome = learn(meshes, "rack 1", "rack 2")
    assert outcome.suggested
    assert show(outcome.suggested.orient) == UP
    assert outcome.suggested.sizes == (2,)


def test_nothing_is_suggested_where_all_assets_stand_upright() -> None:
    outcome = learn(upright(), "rack 1")
    assert isinstance(outcome, Found)
    assert outcome.suggested is None


def test_nothing_is_suggested_for_rules_that_ask_for_labels_only() -> None:
    meshes = leaning()
    demo = Demonstration(meshes["rack 1"], [Step(1, {"leg"}, Replace("box"))], "rack 1")
    assert synthesize([demo], meshes, vocabulary=LABELS).suggested is None


def test_landmarks_that_lie_along_an_axis_on_nearly_all_meshes_support_it() -> None:
    standing, lying = (Landmarks([*meshes.values()], LABELS) for meshes in (upright(), leaning()))
    assert [standing.supports(letter) for letter in "XYZ"] == [False, False, True]
    assert not any(lying.supports(letter) for letter in "XYZ")


def test_landmarks_that_most_meshes_have_along_an_axis_deviate_little() -> None:
    landmarks = Landmarks([*leaning().values()], LABELS)
    pair = LandmarkPair("+Z", Is("leg"), Is("panel"))
    assert landmarks.deviation(pair) < np.radians(8)
    assert 0.5 < landmarks.likeness(pair) <= 1.0


@pytest.mark.parametrize(("text", "more"), [("Geo(Is(leg), +X)", True), ("Attach(Is(leg), Is(panel))", False)])
def test_a_direction_is_doubted_where_no_landmarks_lie_along_it(text: str, more: bool) -> None:
    extractor = parse_extractor(text)
    assert (cost_extractor(extractor, "YZ") > cost_extractor(extractor, "X")) is more


def test_actions_that_go_by_axes_count_where_a_later_rule_asks_for_places() -> None:
    mesh = rack()
    demo = Demonstration(mesh, [Step(1, {"top_0"}, Replace("box")), Step(2, {"leg"}, Delete())])
    rules = collect_rule_specs([demo])
    plain, place = parse_extractor("Is(leg)"), parse_extractor("Geo(Is(panel), +Z)")
    assert FrameCosts(rules, [place, plain]).askew == 0
    assert FrameCosts(rules, [plain, place]).askew > 0


@pytest.mark.parametrize(
    ("text", "depends"),
    [
        ("Replace(box)", True),
        ("Replace(box, tight)", False),
        ("Each(Replace(capsule))", True),
        ("Each(Replace(capsule, native))", True),
        ("Replace(sphere, native)", False),
        ('Add(+Z, "knob.obj")', True),
        ("Scale(all, 0.9)", False),
        ("Scale(X, 0.9)", True),
        ("Merge", False),
        ("Delete", False),
    ],
)
def test_which_actions_depend_on_the_frame(text: str, depends: bool) -> None:
    assert parse_action(text).depends_on_frame is depends
