"""What each action makes of its hulls."""

import numpy as np
import pytest

from meshforge.common import ProgramError
from meshforge.geometry import Box, Cylinder, Ellipsoid, Floats, Pose, Sphere, convex_hull
from meshforge.language import PRIMITIVES, Action, Add, Delete, Each, Merge, Replace, Scale
from meshforge.symbolic import SymbolicMesh
from tests.unit.language.scenes import Applied, apply_action, box, hull, mesh, table, wedge

TEMPLATES = {"wedge.obj": wedge()}


def applied(scene: SymbolicMesh, action: Action, *names: str, label: str | None = None) -> Applied:
    mask = sum(1 << scene.index[name] for name in names or scene.index)
    return apply_action(scene, mask, action, TEMPLATES, label)


def bounds(scene: SymbolicMesh, name: str) -> list[list[float]]:
    aabb = scene.hull_of(name).aabb
    return [aabb.min.round(9).tolist(), aabb.max.round(9).tolist()]


def test_delete_removes_the_hulls_and_nothing_else() -> None:
    scene = table()
    after = applied(scene, Delete(), "top", "splinter").mesh
    assert after.hulls == tuple(h for h in scene.hulls if h.name not in ("top", "splinter"))


def test_merge_takes_the_name_label_and_body_of_the_largest_hull() -> None:
    result = applied(table(), Merge(), "leg0_low", "leg0_high")
    made = result.mesh.hull_of("leg0_high~1")
    assert result.made == ("leg0_high~1",) and result.sources == (("leg0_low", "leg0_high"),)
    assert (made.label, made.body, made.parent, made.source, made.confidence) == (
        "leg", "body", "leg0_high", "edit", 0.8,
    )  # fmt: skip
    assert bounds(result.mesh, "leg0_high~1") == [[0, 0, 0], [0.1, 0.1, 1]]
    assert np.isclose(made.volume, 0.01)


def test_of_equally_large_hulls_the_first_counts() -> None:
    scene = mesh(hull("b", box([0, 0, 0], [1, 1, 1]), "x"), hull("a", box([1, 0, 0], [2, 1, 1]), "y"))
    assert applied(scene, Merge()).made == ("b~1",)


def test_merging_one_hull_under_a_label_relabels_it() -> None:
    scene = mesh(hull("ball", Sphere(Pose.identity(), 1.0), "knob"))
    after = applied(scene, Merge(), label="handle").mesh.hull_of("ball")
    assert after.label == "handle" and after.source == "edit" and after.parent is None
    assert after.shape is scene.hulls[0].shape


def test_merging_a_round_primitive_is_noted() -> None:
    scene = mesh(hull("ball", Sphere(Pose.identity(), 1.0)), hull("box", box([0, 0, 0], [1, 1, 2])))
    assert applied(scene, Merge()).note == "round primitives were merged by their tessellated points"


def test_flat_input_is_thickened() -> None:
    low = convex_hull(np.array([[x, y, 0] for x in (0.0, 1) for y in (0.0, 1)]), thicken=1e-12)
    high = convex_hull(np.array([[x, y, 0] for x in (1.0, 2) for y in (0.0, 1)]), thicken=1e-12)
    result = applied(mesh(hull("a", low), hull("b", high)), Merge())
    assert result.mesh.hulls[0].aabb.size[2] == pytest.approx(1e-4 * np.sqrt(5))


@pytest.mark.parametrize("primitive", PRIMITIVES)
def test_every_primitive_has_the_bounding_box_of_what_it_replaces(primitive: str) -> None:
    scene = mesh(hull("a", box([0, 0, 0], [1, 2, 4])))
    result = applied(scene, Replace(primitive))
    assert bounds(result.mesh, "a~1") == [[0, 0, 0], [1, 2, 4]]


def test_a_cylinder_stands_along_the_longest_side() -> None:
    scene = mesh(hull("a", box([0, 0, 0], [4, 1, 1])))
    shape = applied(scene, Replace("cylinder")).mesh.hulls[0].shape
    assert isinstance(shape, Cylinder)
    assert np.allclose(np.abs(shape.pose.rotation[:, 2]), [1, 0, 0])
    assert (shape.radius, shape.half_length) == pytest.approx((0.5, 2.0))


def test_a_cylinder_over_unequal_sides_is_a_polytope_and_noted() -> None:
    result = applied(mesh(hull("a", box([0, 0, 0], [1, 2, 4]))), Replace("cylinder"))
    assert result.mesh.hulls[0].primitive is None
    assert result.note is not None and "cylinder" in result.note


def test_a_sphere_is_the_ellipsoid_that_fills_the_box() -> None:
    result = applied(mesh(hull("a", box([0, 0, 0], [1, 2, 4]))), Replace("sphere"))
    egg = result.mesh.hulls[0].shape
    assert isinstance(egg, Ellipsoid) and egg.radii.tolist() == [0.5, 1, 2] and result.note is None
    assert egg.pose.translation.tolist() == [0.5, 1, 2]
    cube = applied(mesh(hull("a", box([0, 0, 0], [2, 2, 2]))), Replace("sphere")).mesh.hulls[0].shape
    assert isinstance(cube, Sphere) and cube.radius == pytest.approx(1.0)


@pytest.mark.parametrize("primitive", ["box", "cylinder", "capsule"])
def test_a_tight_fit_follows_a_slanted_leg(primitive: str) -> None:
    slant = rotation(0.5)
    leg = Box(Pose(slant, np.zeros(3)), np.array([0.1, 0.1, 2.0]))
    after = applied(mesh(hull("leg", leg)), Replace(primitive, "tight")).mesh.hulls[0]
    around = applied(mesh(hull("leg", leg)), Replace("box")).mesh.hulls[0]
    assert after.shape.kind == primitive
    assert after.volume < 3 * leg.volume < around.volume


@pytest.mark.parametrize("primitive", ["cylinder", "capsule", "sphere"])
def test_native_shapes_are_made_one_a_body(primitive: str) -> None:
    scene = mesh(hull("a", box([0, 0, 0], [1, 2, 4]), body="base"), hull("b", box([1, 0, 0], [2, 2, 4]), body="door"))
    result = applied(scene, Replace(primitive, "native"))
    assert [(h.name, h.body, h.shape.kind) for h in result.mesh.hulls] == [
        ("a~1", "base", primitive), ("b~1", "door", primitive),
    ]  # fmt: skip


@pytest.mark.parametrize("primitive", ["cylinder", "capsule", "sphere"])
def test_a_native_shape_around_a_needle_has_a_thickness(primitive: str) -> None:
    needle = convex_hull(np.array([[0, 0, 0], [1, 0, 0], [1, 1e-13, 0], [0, 0, 1e-13]]), thicken=1e-13)
    shape = applied(mesh(hull("a", needle)), Replace(primitive, "native")).mesh.hulls[0].shape
    assert shape.kind == primitive
    assert shape.aabb.size[1:].min() >= 1e-4 * (1 - 1e-9)


def rotation(angle: float) -> Floats:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])


def test_a_template_is_mapped_axis_by_axis_and_never_turned() -> None:
    scene = mesh(hull("a", box([10, 0, 0], [11, 2, 4])))
    result = applied(scene, Replace("wedge.obj"))
    assert bounds(result.mesh, "a~1") == [[10, 0, 0], [11, 2, 4]]
    top = result.mesh.hulls[0].vertices
    assert set(top[top[:, 2] > 3.9][:, 1].tolist()) == {2.0}  # the ridge stays at the far side along Y


def test_longest_turns_the_template_first() -> None:
    scene = mesh(hull("a", box([0, 0, 0], [1, 2, 40])))
    result = applied(scene, Replace("wedge.obj", "longest"))
    shape = result.mesh.hulls[0].shape
    assert bounds(result.mesh, "a~1") == [[0, 0, 0], [1, 2, 40]]
    heights = shape.vertices[:, 2].round(9).tolist()
    assert sorted(heights) == [0.0] * 3 + [40.0] * 3  # a prism along Z: three corners at either end


def test_a_template_of_two_hulls_makes_two() -> None:
    both = {"pair.obj": type(wedge())((*wedge().shapes, box([0, 0, 1], [1, 1, 3])), "pair.obj")}
    scene = mesh(hull("a", box([0, 0, 0], [1, 1, 1]), "leg"))
    result = apply_action(scene, 1, Replace("pair.obj"), both)
    assert result.made == ("a~1", "a~2") and result.sources == (("a",), ("a",))
    assert result.mesh.aabb is not None and result.mesh.aabb.size.tolist() == pytest.approx([1, 1, 1])


def test_add_touches_the_middle_of_the_side_from_outside_as_large_as_fits() -> None:
    scene = mesh(hull("door", box([0, 0, 0], [1, 8, 4]), "door"))
    result = applied(scene, Add("+X", "wedge.obj"), label="handle")
    assert [h.name for h in result.mesh.hulls] == ["door", "door~1"]
    assert bounds(result.mesh, "door~1") == [[1, 0, 0], [17, 8, 4]]
    assert result.mesh.hull_of("door~1").label == "handle" and result.mesh.hull_of("door").label == "door"


def test_add_along_a_negative_direction_is_centred_on_the_other_side() -> None:
    scene = mesh(hull("door", box([0, 0, 0], [4, 8, 4])))
    assert bounds(applied(scene, Add("-Z", "wedge.obj")).mesh, "door~1") == [[0, 3, -1], [4, 5, 0]]


def test_add_keep_keeps_the_size_of_the_template() -> None:
    scene = mesh(hull("door", box([0, 0, 0], [1, 8, 4])))
    assert bounds(applied(scene, Add("+X", "wedge.obj", keep=True)).mesh, "door~1") == [[1, 3, 1.5], [5, 5, 2.5]]


def test_scale_keeps_the_group_together_and_every_hull_its_own() -> None:
    scene = mesh(hull("a", box([0, 0, 0], [1, 1, 1]), "x"), hull("b", box([3, 0, 0], [4, 1, 1]), "y", body="door"))
    result = applied(scene, Scale("X", 0.5))
    assert bounds(result.mesh, "a~1") == [[1, 0, 0], [1.5, 1, 1]]
    assert bounds(result.mesh, "b~1") == [[2.5, 0, 0], [3, 1, 1]]
    assert [(h.label, h.body, h.parent) for h in result.mesh.hulls] == [("x", "body", "a"), ("y", "door", "b")]
    assert result.sources == (("a",), ("b",))


def test_each_scale_scales_every_component_about_its_own_centre() -> None:
    scene = mesh(hull("a", box([0, 0, 0], [1, 1, 1])), hull("b", box([3, 0, 0], [4, 1, 1])))
    result = applied(scene, Each(Scale("all", 2)))
    assert bounds(result.mesh, "a~1") == [[-0.5, -0.5, -0.5], [1.5, 1.5, 1.5]]
    assert bounds(result.mesh, "b~1") == [[2.5, -0.5, -0.5], [4.5, 1.5, 1.5]]


def test_a_scaled_primitive_stays_one_where_the_map_keeps_its_kind() -> None:
    scene = mesh(hull("a", Sphere(Pose.identity(), 1.0)))
    assert isinstance(applied(scene, Scale("all", 2)).mesh.hulls[0].shape, Sphere)
    assert applied(scene, Scale("Z", 2)).mesh.hulls[0].shape.kind == "polytope"


def test_names_count_on_and_are_never_given_twice() -> None:
    scene = mesh(hull("a", box([0, 0, 0], [1, 1, 1])), hull("a~1", box([1, 0, 0], [2, 1, 1])))
    first = applied(scene, Scale("all", 2), "a")
    assert first.made == ("a~2",)
    second = apply_action(first.mesh, 0b10, Scale("all", 2), used=first.used)
    assert second.made == ("a~3",) and second.mesh.hull_of("a~3").parent == "a"
    third = apply_action(second.mesh, 0b01, Scale("all", 2), used=second.used)
    assert third.made == ("a~1~1",) and third.mesh.hull_of("a~1~1").parent == "a~1"


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: Replace("sphere", "tight"),
        lambda: Replace("bar.obj", "tight"),
        lambda: Replace("box", "longest"),
        lambda: Replace("box", "native"),
        lambda: Replace("bar.obj", "native"),
        lambda: Replace(""),
        lambda: Add("X", "bar.obj"),  # type: ignore[arg-type]
        lambda: Scale("all", 0.0),
        lambda: Scale("all", float("nan")),
        lambda: Scale("W", 2.0),  # type: ignore[arg-type]
        lambda: Each(Each(Merge())),
        lambda: Each("Merge"),  # type: ignore[arg-type]
    ],
)
def test_an_action_with_arguments_that_cannot_be_is_refused_at_birth(wrong: object) -> None:
    assert callable(wrong)
    with pytest.raises(ProgramError):
        wrong()
