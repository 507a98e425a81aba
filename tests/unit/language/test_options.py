"""Options of actions: sizes of one's own, axes, what encloses and what keeps a gap, and what a user is told."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linprog

from meshforge.common import GeometryError
from meshforge.geometry import (
    Box,
    Capsule,
    Cylinder,
    Ellipsoid,
    Floats,
    Pose,
    Shape,
    Sphere,
    convex_hull,
    distance,
    planes_of,
)
from meshforge.language import Add, Each, Replace, Scale, Shrink
from meshforge.symbolic import SymbolicMesh
from tests.examples import examples
from tests.unit.language.scenes import box, hull, mesh
from tests.unit.language.test_actions import applied


def wheel() -> Shape:
    """A polytope of radius 0.05 and width 0.03 about Y, as a wheel of 64 corners a side."""
    turn = np.arange(64) * (2 * np.pi / 64)
    rims = [np.column_stack([0.05 * np.cos(turn), np.full(64, y), 0.05 * np.sin(turn)]) for y in (-0.015, 0.015)]
    return convex_hull(np.concatenate(rims))


def made(shape: Shape, action: Replace | Shrink) -> Shape:
    return applied(mesh(hull("a", shape)), action).mesh.hulls[0].shape


def test_a_wheel_becomes_a_sphere_of_its_own_radius() -> None:
    for action in (Replace("sphere", radius=0.05), Replace("sphere", "longest")):
        ball = made(wheel(), action)
        assert isinstance(ball, Sphere) and ball.radius == pytest.approx(0.05, rel=1e-12)
        assert np.allclose(ball.pose.translation, 0, atol=1e-12)
    around = made(wheel(), Replace("sphere", "native"))
    assert isinstance(around, Sphere) and around.radius == pytest.approx(np.hypot(0.05, 0.015))
    inside = made(wheel(), Replace("sphere", "inscribed"))
    assert isinstance(inside, Sphere) and inside.radius == pytest.approx(0.015, rel=1e-6)


def test_a_disc_lies_flat_as_a_native_and_as_a_plain_cylinder() -> None:
    for fit in (None, "native"):
        disc = made(wheel(), Replace("cylinder", fit))
        assert isinstance(disc, Cylinder)
        assert np.allclose(np.abs(disc.pose.rotation[:, 2]), [0, 1, 0])
        assert (disc.radius, disc.half_length) == pytest.approx((0.05, 0.015))


@pytest.mark.parametrize("axis", ["X", "Y", "Z"])
@pytest.mark.parametrize("fit", [None, "native", "inscribed", "volume"])
def test_an_axis_that_is_said_is_the_axis(axis: str, fit: str | None) -> None:
    leg = Box(Pose.of_translation([1, 2, 3]), np.array([0.1, 0.1, 0.1]))
    shape = made(leg, Replace("cylinder", fit, axis))  # type: ignore[arg-type]
    assert isinstance(shape, Cylinder)
    assert np.abs(shape.pose.rotation[:, 2]).tolist() == pytest.approx(np.eye(3)["XYZ".index(axis)].tolist())


def test_a_cylinder_and_a_capsule_of_a_radius_are_as_long_as_the_box() -> None:
    bar = Box(Pose.of_translation([1, 2, 3]), np.array([0.5, 0.1, 0.1]))
    round_bar = made(bar, Replace("cylinder", radius=0.05))
    assert isinstance(round_bar, Cylinder) and (round_bar.radius, round_bar.half_length) == (0.05, 0.5)
    grip = made(bar, Replace("capsule", radius=0.05))
    assert isinstance(grip, Capsule) and (grip.radius, grip.half_length) == pytest.approx((0.05, 0.45))
    assert np.allclose(grip.aabb.min, [0.5, 1.95, 2.95])


def highest(shape: Shape, around: Shape) -> float:
    """How far a shape reaches over the faces of a polytope."""
    planes = planes_of(around.vertices, around.faces)
    reach = [shape.support(normal) @ normal - normal @ planes.middle for normal in planes.normals]
    return float((np.array(reach) - planes.offsets).max())


@pytest.mark.parametrize("primitive", ["box", "cylinder", "capsule", "sphere"])
def test_what_is_inscribed_stays_inside_and_touches(primitive: str) -> None:
    for seed in range(5):
        rng = np.random.default_rng(seed)
        cloud = convex_hull(rng.normal(size=(40, 3)) * rng.uniform(0.2, 2, size=3) + 10)
        shape = made(cloud, Replace(primitive, "inscribed"))
        assert shape.kind in (primitive, "sphere")
        assert -1e-6 * cloud.aabb.diagonal <= highest(shape, cloud) <= 1e-12


def test_the_inscribed_sphere_is_the_largest_by_an_independent_solver() -> None:
    cloud = convex_hull(np.random.default_rng(3).normal(size=(60, 3)))
    planes = planes_of(cloud.vertices, cloud.faces)
    rows = np.column_stack([planes.normals, np.ones(len(planes.normals))])
    best = np.asarray(linprog([0, 0, 0, -1], rows, planes.offsets, bounds=[(None, None)] * 4).x)[3]
    ball = made(cloud, Replace("sphere", "inscribed"))
    assert isinstance(ball, Sphere) and ball.radius == pytest.approx(best, rel=1e-7)


def test_the_inscribed_shapes_of_a_box_are_known() -> None:
    block = Box(Pose.of_translation([5, 5, 5]), np.array([1.0, 2.0, 3.0]))
    assert made(block, Replace("box", "inscribed")).volume == pytest.approx(48)
    lying = made(block, Replace("cylinder", "inscribed"))
    assert isinstance(lying, Cylinder)
    assert (lying.radius, lying.half_length) == pytest.approx((2, 1), rel=1e-6)  # 4 pi x 2, of 3 pi and 2 pi x 2
    grip = made(block, Replace("capsule", "inscribed", "Z"))
    assert isinstance(grip, Capsule) and (grip.radius, grip.half_length) == pytest.approx((1, 2), rel=1e-6)


@pytest.mark.parametrize("primitive", ["box", "cylinder", "capsule", "sphere"])
def test_the_same_volume_is_the_same_volume(primitive: str) -> None:
    one, two = box([0, 0, 0], [1, 1, 4]), box([0.5, 0, 0], [1.5, 1, 4])  # they share half of each
    scene = mesh(hull("a", one), hull("b", two))
    shape = applied(scene, Replace(primitive, "volume")).mesh.hulls[0].shape
    assert shape.kind == primitive and shape.volume == pytest.approx(6.0, rel=1e-6)


def finger_gap() -> SymbolicMesh:
    """A wall, and a slanted flat handle 20 mm before it."""
    turn = 0.4
    slant = np.array([[1, 0, 0], [0, np.cos(turn), -np.sin(turn)], [0, np.sin(turn), np.cos(turn)]])
    handle = Box(Pose(slant, np.array([0.05, 0.0, 0.0])), np.array([0.005, 0.02, 0.1]))
    wall = Box(Pose.of_translation([0.0, 0.0, 0.0]), np.array([0.025, 0.2, 0.2]))
    return mesh(hull("handle", handle), hull("wall", wall))


def test_what_encloses_takes_the_gap_and_says_so_and_what_does_not_keeps_it() -> None:
    scene = finger_gap()
    notes = {}
    for fit in ("tight", "inscribed", "volume"):
        result = applied(scene, Replace("capsule", fit), "handle")
        grip, wall = result.mesh.hull_of("handle~1").shape, result.mesh.hull_of("wall").shape
        notes[fit] = distance(grip, wall), result.note
    assert notes["tight"][0] < 0.01
    gap = f"the gap between handle and wall shrinks from 0.02 m to {notes['tight'][0]:.3g} m"
    assert notes["tight"][1] == f"handle sticks out of the asset by 0.0157 m; {gap}"
    assert notes["inscribed"][0] >= 0.02 and notes["inscribed"][1] is None
    assert notes["volume"][0] > notes["tight"][0]


def test_a_gap_to_what_was_selected_too_is_no_loss() -> None:
    scene = finger_gap()
    assert applied(scene, Each(Replace("box")), "handle", "wall").note is None


def trough(width: float = 0.8) -> SymbolicMesh:
    """A floor between two walls, `width` [m] apart, 2 m long and 1 m high."""
    slabs = ((0, width, 0, 0.1), (-0.1, 0, 0, 1), (width, width + 0.1, 0, 1))
    return mesh(*(hull(f"slab{k}", box([a, 0, c], [b, 2, d]), "leg") for k, (a, b, c, d) in enumerate(slabs)))


def fits(scene: SymbolicMesh, action: Replace | Each) -> bool:
    return bool(applied(scene, action).made)


def test_within_is_the_distance_of_surfaces_in_shares_of_the_diagonal() -> None:
    scene = trough()
    mouth = 0.4 / scene.diagonal  # from the middle of the mouth to a wall
    assert fits(scene, Replace("box", within=1.03 * mouth)) and not fits(scene, Replace("box", within=0.95 * mouth))
    lid = mesh(*scene.hulls, *(hull(f"lid{k}", box(*b)) for k, b in enumerate((
        ([0, 0, 0.9], [0.8, 2, 1]), ([0, 0, 0.1], [0.8, 0.1, 0.9]), ([0, 1.9, 0.1], [0.8, 2, 0.9])))))  # fmt: skip
    assert fits(lid, Replace("box", within=1e-6))  # hollow, but closed: the outer surface counts
    bar = mesh(hull("a", box([0, 0, 0], [4, 1, 1])))
    cut = (3 - 0.5 * np.sqrt(3) + 0.5) / 2 / bar.diagonal  # an end of the bar lies out of the ball inside by more
    assert not fits(bar, Replace("sphere", "inscribed", within=cut)) and fits(bar, Replace("box", within=1e-9))
    assert fits(bar, Replace("wedge.obj", within=0.17)) and not fits(bar, Replace("wedge.obj", within=0.16))


def test_what_does_not_fit_stays_as_it_is_and_says_so() -> None:
    scene = mesh(*trough().hulls, hull("post", box([5, 0, 0], [5.1, 0.1, 1]), "leg"))
    result = applied(scene, Each(Replace("box", within=0.02)), label="foot")
    assert result.mesh.hulls[:3] == scene.hulls[:3] and [one.label for one in result.mesh.hulls] == [
        *["leg"] * 3,
        "foot",
    ]
    assert result.made == ("post~1",) and result.note is not None
    assert result.note.startswith("slab0, slab1, slab2 stay: their surfaces would be 0.3")
    assert result.note.endswith(" m apart, more than 0.113 m")


def test_clear_keeps_gaps_to_all_but_what_was_touched() -> None:
    one, far = box([0, 0, 0], [1, 1, 1]), box([0, 0, 1.5], [1, 1, 2.5])
    shelf = hull("shelf", box([-1, -1, -0.1], [2, 2, 0]))
    rounded = Replace("sphere", "native", clear=True)
    assert fits(mesh(hull("a", one), shelf), Replace("box", clear=True))
    assert applied(mesh(hull("a", one), shelf), rounded, "a").made  # grows into what it touched before
    assert not applied(mesh(hull("a", one), hull("b", far)), rounded, "a").made
    assert not fits(mesh(hull("a", one), hull("b", far)), Each(rounded))  # of Each, other components count, too
    assert fits(mesh(hull("a", one), hull("b", far)), Replace("box", clear=True))


@given(st.floats(0.01, 100), st.sampled_from([0.9, 1.1]), st.integers(0, 3), st.permutations(range(3)), st.booleans())
@examples(25)
def test_whether_it_fits_depends_on_neither_scale_nor_turn_nor_order(
    scale: float, factor: float, quarters: int, order: list[int], at_any_angle: bool
) -> None:
    scene, turn = trough(), np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    action = Replace("box", "tight" if at_any_angle else None, within=factor * 0.4 / scene.diagonal, clear=True)
    pose = scale * np.linalg.matrix_power(turn, quarters)
    moved = [hull(one.name, one.shape.transform(pose, np.ones(3))) for one in scene.hulls]
    assert fits(mesh(*(moved[k] for k in order)), action) == fits(scene, action) == (factor > 1)


def test_scaling_parts_that_do_not_touch_says_that_they_move() -> None:
    scene = mesh(hull("a", box([0, 0, 0], [1, 1, 1])), hull("b", box([5, 0, 0], [6, 1, 1])))
    result = applied(scene, Scale("all", 0.5))
    assert result.note == (
        "2 parts that do not touch were scaled as one group, which moves them"
        " (Each(Scale(all, 0.5)) scales each in place)"
    )
    apart = applied(scene, Each(Scale("all", 0.5)))
    assert apart.note is None
    assert [one.aabb.center[0] for one in apart.mesh.hulls] == [0.5, 5.5]
    assert applied(mesh(hull("a", box([0, 0, 0], [1, 1, 1]))), Scale("all", 0.5)).note is None


def test_a_shrunk_hull_is_smaller_by_the_distance_along_every_normal() -> None:
    rng = np.random.default_rng(1)
    cloud = convex_hull(rng.normal(size=(30, 3)))
    inner = made(cloud, Shrink(0.05))
    planes = planes_of(inner.vertices, inner.faces)
    reach: Floats = (cloud.vertices - planes.middle) @ planes.normals.T
    assert highest(inner, cloud) == pytest.approx(-0.05, abs=1e-9)
    assert (reach.max(axis=0) - planes.offsets).min() == pytest.approx(0.05, abs=1e-9)


@pytest.mark.parametrize(
    ("shape", "size"),
    [
        (Box(Pose.identity(), np.array([1.0, 2.0, 3.0])), [1.8, 3.8, 5.8]),
        (Sphere(Pose.identity(), 1.0), [1.8, 1.8, 1.8]),
        (Cylinder(Pose.identity(), 1.0, 2.0), [1.8, 1.8, 3.8]),
        (Capsule(Pose.identity(), 1.0, 2.0), [1.8, 1.8, 5.8]),
        (Ellipsoid(Pose.identity(), np.array([1.0, 2.0, 3.0])), [1.8, 3.8, 5.8]),
    ],
)
def test_a_shrunk_primitive_stays_one(shape: Shape, size: list[float]) -> None:
    inner = made(shape, Shrink(0.1))
    assert inner.kind == shape.kind and inner.aabb.size.tolist() == pytest.approx(size)
    with pytest.raises(GeometryError, match="hull 'a' vanishes when its surface moves inwards by 1 m: 1 m is the most"):
        made(shape, Shrink(1.0))


def test_a_hull_that_alone_takes_the_place_of_one_keeps_its_name_in_a_file() -> None:
    scene = mesh(*(hull(name, box([x, 0, 0], [x + 1, 1, 1])) for name, x in (("a", 0), ("b", 5), ("c", 10))))
    assert applied(scene, Replace("sphere"), "a").mesh.names_in_file == {"a~1": "a"}
    assert applied(scene, Scale("all", 0.5)).mesh.names_in_file == {"a~1": "a", "b~1": "b", "c~1": "c"}
    assert applied(scene, Replace("sphere"), "a", "b").mesh.names_in_file == {}
    twice = applied(applied(scene, Replace("sphere"), "a").mesh, Replace("box"), "a~1").mesh
    assert twice.names_in_file == {"a~2": "a"}
    assert applied(scene, Add("+X", "wedge.obj"), "a").mesh.names_in_file == {}
    taken = replace(twice, hulls=(*twice.hulls, scene.hull_of("a")))
    assert taken.names_in_file == {}
