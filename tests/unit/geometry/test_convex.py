import numpy as np
import pytest

from meshforge.common import GeometryError
from meshforge.geometry import (
    Floats,
    Polytope,
    convex_hull,
    is_closed,
    is_convex,
    is_outward,
    principal_extents,
    spans_volume,
)

CUBE = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
SQUARE = CUBE[CUBE[:, 2] == 0]


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize("place", [0.0, 1.0, 1e3])
def test_size_and_place_do_not_matter(scale: float, place: float) -> None:
    points = CUBE * scale + place * scale * 1e3
    hull = convex_hull(points)
    assert len(hull.vertices) == 8
    assert hull.volume == pytest.approx(scale**3, rel=1e-6)


def test_a_million_metres_from_the_origin_a_hull_keeps_its_vertices() -> None:
    points = np.random.default_rng(0).normal(size=(60, 3)) + 1e6
    hull = convex_hull(points)
    assert hull.volume == pytest.approx(convex_hull(points - 1e6).volume, rel=1e-8)
    assert {tuple(p) for p in hull.vertices} <= {tuple(p) for p in points}


def test_large_coplanar_clusters_make_a_convex_hull() -> None:
    rng = np.random.default_rng(1)
    sides = [np.insert(rng.random((2000, 2)), axis, side, axis=1) for axis in range(3) for side in (0.0, 1.0)]
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    hull = convex_hull(np.concatenate(sides) @ turn)
    assert is_closed(hull.faces)
    assert is_convex(hull.vertices, hull.faces, 1e-9)


@pytest.mark.parametrize(
    ("points", "words"),
    [
        (np.empty((0, 3)), "there are none"),
        (np.array([[0, 0, np.nan], [1, 0, 0], [0, 1, 0], [0, 0, 1]]), "not a finite number"),
        (np.array([[0, 0, np.inf], [1, 0, 0], [0, 1, 0], [0, 0, 1]]), "not a finite number"),
        (np.zeros((1, 3)), "span no volume"),
        (np.zeros((9, 3)), "span no volume"),
        (np.array([[0, 0, 0], [1, 1, 1], [2, 2, 2]]), "span no volume"),
        (SQUARE, "span no volume"),
        (SQUARE + np.array([0, 0, 1e6]), "span no volume"),
        (CUBE * [1, 1, 1e-8], "span no volume"),
        (CUBE * 1e-200, "span no volume"),
    ],
)
def test_points_without_a_hull_are_refused_with_the_name(points: Floats, words: str) -> None:
    with pytest.raises(GeometryError, match=f"leg/geom0: .*{words}"):
        convex_hull(points, name="leg/geom0")


@pytest.mark.parametrize(
    ("points", "size"),
    [
        (SQUARE, (1, 1, 0.01)),
        (SQUARE[:2], (0.01, 1, 0.01)),
        (np.zeros((3, 3)), (0.01, 0.01, 0.01)),
        (CUBE * [1, 1, 1e-9], (1, 1, 0.01)),
        (CUBE * [1, 1, 0.004], (1, 1, 0.01)),
    ],
)
def test_flat_points_are_thickened_about_their_middle(points: Floats, size: tuple[float, float, float]) -> None:
    hull = convex_hull(points, thicken=0.01)
    assert np.allclose(hull.aabb.size, size)
    assert np.allclose(hull.aabb.center, points.mean(axis=0), atol=1e-9)


@pytest.mark.parametrize("seed", range(40))
def test_the_hull_of_a_hull_is_that_hull_in_single_precision_too(seed: int) -> None:
    rng = np.random.default_rng(seed)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    hull = convex_hull((rng.integers(0, 5, size=(100, 3)) @ turn).astype(np.float32))
    again = convex_hull(hull.vertices)
    assert np.array_equal(np.unique(again.vertices, axis=0), np.unique(hull.vertices, axis=0))


@pytest.mark.parametrize("seed", [56, 148, 166, 326, 482, 508])
def test_noise_of_single_precision_leaves_no_needles(seed: int) -> None:
    rng = np.random.default_rng(seed)
    lattice = rng.integers(0, 3, size=(40, 3))
    hull = convex_hull(lattice + rng.normal(size=(40, 3)) * 10.0 ** rng.uniform(-7.5, -6))
    sides = hull.vertices[hull.faces] - hull.vertices[np.roll(hull.faces, 1, axis=1)]
    areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    assert (areas / np.linalg.norm(sides, axis=2).max(axis=1)).min() > 1.3e-7
    assert is_convex(hull.vertices, hull.faces, 1e-7)


def test_principal_extents_are_those_of_the_box_a_cloud_was_made_in() -> None:
    _, axes, extents = principal_extents(CUBE * [3, 1, 2])
    assert np.allclose(extents, [3, 2, 1])
    assert np.linalg.det(axes) == pytest.approx(1.0)


def test_spanning_a_volume_is_what_a_hull_asks_for() -> None:
    assert spans_volume(CUBE)
    assert not spans_volume(SQUARE)
    assert not spans_volume(CUBE[:1])


FACES = convex_hull(CUBE).faces
CORNERS = convex_hull(CUBE).vertices


def test_a_surface_with_a_hole_is_not_closed() -> None:
    assert is_closed(FACES)
    assert not is_closed(FACES[1:])
    assert not is_closed(FACES[:0])


def test_a_surface_with_a_face_turned_over_is_not_closed() -> None:
    turned = FACES.copy()
    turned[3] = turned[3][::-1]
    assert not is_closed(turned)


def test_a_surface_inside_out_is_closed_but_not_outward() -> None:
    assert is_outward(CORNERS, FACES)
    assert is_closed(FACES[:, ::-1])
    assert not is_outward(CORNERS, FACES[:, ::-1])


def test_a_dent_is_not_convex_beyond_the_tolerance() -> None:
    dented = Polytope(np.where(CORNERS.sum(axis=1, keepdims=True) == 3, 0.9, CORNERS), FACES)
    assert is_convex(CORNERS, FACES)
    assert not is_convex(dented.vertices, dented.faces)
    assert not is_convex(CORNERS, FACES[:, ::-1])
