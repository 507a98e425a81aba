"""A made hull takes the contact attributes of the largest hull; where the others differ, the trace says so."""

from pathlib import Path

from meshforge.geometry import Pose
from meshforge.language import Delete, Each, Merge, Scale
from meshforge.symbolic import Asset, Body, Document, Geom, SymbolicMesh
from tests.unit.language.scenes import apply_action, box

SOFT, HARD = (("friction", "0.2"), ("condim", "3")), (("friction", "1"), ("condim", "3"))


def scene(*contacts: tuple[tuple[str, str], ...]) -> SymbolicMesh:
    """Boxes side by side, each smaller than the one before."""
    geoms = tuple(
        Geom(f"g{k}", "body", box([k, 0, 0], [k + 1, 1, 1 - k / 10]), contact=contact)
        for k, contact in enumerate(contacts)
    )
    return SymbolicMesh.of(Asset(Path("a.xml"), "test", (Body("body", Pose.identity()),), geoms, Document()))


def test_hulls_of_unlike_friction_are_named_with_the_one_that_counts() -> None:
    note = apply_action(scene(SOFT, HARD), 0b11, Merge()).note
    assert note == "friction as g0 has it; the hulls beside it have another"


def test_like_hulls_give_no_note() -> None:
    assert apply_action(scene(SOFT, SOFT), 0b11, Merge()).note is None


def test_formats_without_attributes_give_no_note() -> None:
    assert apply_action(scene((), ()), 0b11, Merge()).note is None


def test_hulls_that_go_or_change_one_by_one_inherit_from_themselves() -> None:
    assert apply_action(scene(SOFT, HARD), 0b11, Delete()).note is None
    assert apply_action(scene(SOFT, HARD), 0b11, Scale("all", 2.0)).note is None


def test_a_made_hull_speaks_for_the_geom_that_it_inherits_from() -> None:
    once = apply_action(scene(SOFT, HARD, HARD), 0b11, Each(Merge()))
    assert once.made == ("g0~1",)
    twice = apply_action(once.mesh, 0b11, Merge(), used=once.used)
    assert twice.note == "friction as g0~1 has it; the hulls beside it have another"
