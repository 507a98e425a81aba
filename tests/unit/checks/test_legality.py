from pathlib import Path

import numpy as np
import pytest

from meshforge.checks import Finding, check
from meshforge.geometry import Aabb, Box, Capsule, Cylinder, Ellipsoid, Polytope, Pose, Shape, Sphere, convex_hull
from meshforge.symbolic import Asset, Body, Document, Geom, Hull, NonConvexPiece, SymbolicMesh

CUBE = Box.of_bounds(Aabb([0, 0, 0], [1, 1, 1])).tessellate()


def mesh(*shapes: Shape) -> SymbolicMesh:
    return SymbolicMesh(tuple(Hull(f"h{k}", "body", shape) for k, shape in enumerate(shapes)))


def found(*shapes: Shape) -> list[tuple[str, str, tuple[str, ...]]]:
    return [(f.rule, f.severity, f.hulls) for f in check(mesh(*shapes))]


@pytest.mark.parametrize(
    "shape",
    [
        CUBE,
        Box.of_bounds(Aabb([0, 0, 0], [1, 2, 3])),
        Sphere(Pose.identity(), 1.0),
        Cylinder(Pose.identity(), 1.0, 2.0),
        Capsule(Pose.identity(), 1.0, 2.0),
        Ellipsoid(Pose.identity(), np.array([1.0, 2.0, 3.0])),
        convex_hull(np.random.default_rng(0).normal(size=(200, 3)) * [1, 1e-3, 1] + 1e4),
    ],
)
def test_a_hull_that_is_one_has_no_findings(shape: Shape) -> None:
    assert check(mesh(shape)) == ()


def dented() -> Polytope:
    """A cube with the middle of its top pushed in."""
    vertices = np.concatenate([CUBE.vertices, [[0.5, 0.5, 0.5]]])
    top = [k for k, face in enumerate(CUBE.faces) if (CUBE.vertices[face][:, 2] == 1).all()]
    ring = [1, 5, 7, 3]
    fan = [[ring[k], ring[(k + 1) % 4], 8] for k in range(4)]
    return Polytope(vertices, np.concatenate([np.delete(CUBE.faces, top, axis=0), fan]))


@pytest.mark.parametrize(
    ("shape", "rule"),
    [
        (Polytope(np.where(CUBE.vertices > 0, np.nan, 0.0), CUBE.faces), "finite"),
        (Polytope(np.where(CUBE.vertices > 0, np.inf, 0.0), CUBE.faces), "finite"),
        (Sphere(Pose.identity(), float("nan")), "finite"),
        (Polytope(CUBE.vertices[:3], np.array([[0, 1, 2]])), "solid"),
        (Polytope(CUBE.vertices * [1, 1, 0], CUBE.faces), "flat"),
        (Box.of_bounds(Aabb([0, 0, 0], [1, 1, 1e-7])), "flat"),
        (Sphere(Pose.identity(), 0.0), "flat"),
        (Polytope(CUBE.vertices, CUBE.faces[1:]), "closed"),
        (Polytope(CUBE.vertices, CUBE.faces[:, ::-1]), "volume"),
        (Sphere(Pose.identity(), -1.0), "volume"),
        (dented(), "convex"),
    ],
)
def test_a_hull_that_is_none_is_named_with_what_it_lacks(shape: Shape, rule: str) -> None:
    assert found(CUBE, shape) == [(rule, "error", ("h1",))]


def test_a_message_names_the_hulls_and_a_remedy_follows() -> None:
    (finding,) = check(mesh(dented(), CUBE, dented().move(Pose.of_translation([3, 0, 0]))))
    assert finding.message == "h0, h2: not convex"
    assert finding.remedy


def test_many_names_are_cut_short_in_the_message_only() -> None:
    shapes = [dented().move(Pose.of_translation([3 * k, 0, 0])) for k in range(9)]
    (finding,) = check(mesh(*shapes))
    assert finding.message == "h0, h1, h2, h3, h4 and 4 more: not convex"
    assert len(finding.hulls) == 9


def test_exact_duplicates_are_named_together() -> None:
    other = Box.of_bounds(Aabb([5, 5, 5], [6, 6, 6])).tessellate()
    reordered = Polytope(CUBE.vertices[::-1], 7 - CUBE.faces)
    assert found(CUBE, other, reordered) == [("duplicate", "warning", ("h0", "h2"))]


def test_a_name_that_two_hulls_have_is_an_error() -> None:
    twins = SymbolicMesh((Hull("a", "body", CUBE), Hull("a", "body", CUBE.move(Pose.of_translation([2, 0, 0])))))
    assert [(f.rule, f.hulls) for f in check(twins)] == [("name", ("a",))]


def test_a_hull_without_a_body_is_an_error() -> None:
    assert [f.rule for f in check(SymbolicMesh((Hull("a", "", CUBE),)))] == ["body"]


def from_file(body: str, *opaque: NonConvexPiece) -> SymbolicMesh:
    bodies = (Body("base", Pose.identity()),)
    return SymbolicMesh.of(Asset(Path("x.urdf"), "urdf", bodies, (Geom("a", body, CUBE),), Document(), opaque))


def test_a_hull_of_a_body_that_the_asset_lacks_is_an_error() -> None:
    assert [(f.rule, f.hulls) for f in check(from_file("top"))] == [("body", ("a",))]
    assert check(from_file("base")) == ()


def test_geometry_that_is_no_hull_is_told_with_its_reason() -> None:
    (finding,) = check(from_file("base", NonConvexPiece("base/floor", "base", "a plane")))
    expected = Finding("non_convex", "warning", ("base/floor",), "base/floor: no convex hull (a plane)", finding.remedy)
    assert finding == expected


def test_an_empty_mesh_has_no_findings() -> None:
    assert check(SymbolicMesh(())) == ()
