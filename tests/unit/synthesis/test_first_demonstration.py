"""Which mesh is best demonstrated first."""

from __future__ import annotations

from meshforge.symbolic import Label
from meshforge.synthesis import choose_first_demonstration
from tests.program_parts import parse_orient
from tests.synthesis_boxes import boxes
from tests.synthesis_cupboards import cupboard, cupboards

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
