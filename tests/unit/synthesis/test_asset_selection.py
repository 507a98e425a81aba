"""What a person is asked, and which mesh is best demonstrated first."""

from collections.abc import Mapping, Sequence

import pytest

from meshforge.symbolic import Label, SymbolicMesh
from meshforge.synthesis import Ambiguous, Found, LearningOutcome, Options, choose_first_demonstration, synthesize
from tests.program_parts import parse_orient
from tests.synthesis_boxes import boxes
from tests.synthesis_cupboards import cupboard, cupboards, shown, with_rare_doors


def learned(meshes: Mapping[str, SymbolicMesh], names: Sequence[str], program: str) -> LearningOutcome:
    return synthesize(shown(meshes, names, program), meshes, options=Options(repair=False))


@pytest.mark.parametrize(
    "program",
    [
        "Is(handle) => Delete",
        "Attach(Is(handle), Is(drawer)) => Delete",
        "Diff(All, Is(body)) => Delete",
        "Is(body) => Delete\nIs(handle) => Delete",
    ],
)
def test_a_question_has_two_or_three_choices_that_differ_and_is_about_an_asset_nobody_spoke_of(program: str) -> None:
    meshes = with_rare_doors()
    outcome = learned(meshes, ["c2"], program)
    assert isinstance(outcome, Ambiguous)
    assert outcome.open_rule.asset in meshes.keys() - {"c2"}
    assert len(set(outcome.open_rule.selections)) == len(outcome.open_rule.selections) in (2, 3)


@pytest.mark.parametrize(("order", "rule"), [(("Is(body)", "Is(handle)"), 2), (("Is(handle)", "Is(body)"), 1)])
def test_a_question_is_about_the_first_rule_whose_doubt_is_worth_it(order: tuple[str, str], rule: int) -> None:
    outcome = learned(with_rare_doors(), ["c0"], "".join(f"{extractor} => Delete\n" for extractor in order))
    assert isinstance(outcome, Ambiguous)
    assert outcome.open_rule.rule == rule
    assert outcome.open_rule.id == f"{rule}:{outcome.open_rule.asset}"


def test_the_choices_of_a_question_are_what_its_readings_differ_by() -> None:
    outcome = learned(with_rare_doors(), ["c0"], "Is(handle) => Delete")
    assert isinstance(outcome, Ambiguous)
    assert [set(one) for one in outcome.open_rule.selections] == [{"pull", "knob"}, {"pull"}, {"knob"}]
    assert any(outcome.open_rule.asset in reading.differs_on for reading in outcome.candidates)


def test_what_differs_on_many_assets_is_sooner_seen_than_asked() -> None:
    """Rivals believed alike: asked about where few assets tell them apart, only reported where many do."""
    rare, common = (learned(meshes, ["c0"], "Is(handle) => Delete") for meshes in (with_rare_doors(), cupboards(12)))
    assert isinstance(rare, Ambiguous)
    assert isinstance(common, Found)
    assert not common.unambiguous
    for outcome in (rare, common):
        assert sum(reading.belief for reading in outcome.candidates if "c1" in reading.differs_on) > 0.3


def test_a_faint_doubt_is_reported_but_not_asked_about() -> None:
    """It is about one cupboard of sixty-two, and would likely not be seen, but it is hardly believed."""
    usual = cupboard(feet=1)
    meshes = {"shown": cupboard(feet=1), **{f"c{k}": usual for k in range(60)}, "odd": cupboard(True, 1)}
    outcome = learned(meshes, ["shown"], "Is(body) => Delete")
    assert isinstance(outcome, Found)
    assert max(reading.belief for reading in outcome.candidates if reading.differs_on == ("odd",)) > 0.03
    assert not outcome.unambiguous


WORDS = ("body", "drawer", "handle", "door", "foot")


def test_the_one_with_doors_feet_and_handles_on_both_tells_most() -> None:
    meshes = cupboards()
    assert choose_first_demonstration(meshes, WORDS) == "c1"  # a door and a foot; c5 has as much, and two feet
    assert choose_first_demonstration({"c0": meshes["c0"], "c2": meshes["c2"]}, WORDS) == "c2"


def test_more_hulls_that_tell_nothing_more_count_against_a_mesh_and_of_equals_the_first_is_taken() -> None:
    alike = {"b": cupboard(feet=2), "a": cupboard(feet=2), "c": cupboard(feet=1)}
    assert choose_first_demonstration(alike, WORDS) == "c"
    assert choose_first_demonstration({name: alike[name] for name in "ba"}, WORDS) == "b"


def test_labels_that_may_be_wrong_or_are_missing_count_against_a_mesh() -> None:
    sure, door = cupboard(), cupboard(door=True)
    assert choose_first_demonstration({"sure": sure, "door": door}, WORDS) == "door"
    doubted = door.with_labels({hull.name: Label(str(hull.label), 0.5, "vlm") for hull in door.hulls})
    assert choose_first_demonstration({"sure": sure, "door": doubted}, WORDS) == "sure"
    assert (
        choose_first_demonstration({"sure": sure, "door": door.with_labels({"knob": None, "door": None})}, WORDS)
        == "sure"
    )


def test_labels_are_judged_by_all_meshes_and_only_those_in_question_are_named() -> None:
    meshes = {f"c{k}": cupboard(door=True) for k in range(6)}
    meshes["wrong"] = meshes["c0"].with_labels({"knob": Label("drawer", 1.0, "vlm")})
    assert choose_first_demonstration(meshes, WORDS, among={"wrong", "c3"}) == "c3"
    assert choose_first_demonstration(meshes, WORDS, among={"wrong"}) == "wrong"
    assert choose_first_demonstration(meshes, WORDS, among=()) is None


def test_only_labels_of_the_vocabulary_count() -> None:
    assert choose_first_demonstration({"plain": cupboard(), "door": cupboard(door=True)}, ("drawer",)) == "plain"


def test_nothing_is_named_where_nothing_can_be_told() -> None:
    bare = boxes(("a", None, (0, 0, 0), (1, 1, 1)))
    assert choose_first_demonstration({}, WORDS) is None
    assert choose_first_demonstration({"bare": bare}, WORDS) is None


def test_a_mesh_that_cannot_be_turned_is_passed_over() -> None:
    orient = parse_orient("orient +X: Is(drawer) -> Is(door)")
    assert choose_first_demonstration({"c0": cupboard(), "c1": cupboard(door=True)}, WORDS, orient) == "c1"
    assert choose_first_demonstration({"c0": cupboard()}, WORDS, orient) is None
