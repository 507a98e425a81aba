"""Collision elements of a URDF as hulls and opaque pieces: shapes, places, names, meshes."""

import pickle
from pathlib import Path

import numpy as np
import pytest

from meshforge.geometry import Box, Capsule, Cylinder, Polytope, Pose, Sphere
from tests.urdf_sample import HULLS, THREE, link, read, robot, sample, write


def test_every_collision_of_the_sample_is_a_hull_of_its_kind(tmp_path: Path) -> None:
    asset = read(sample(tmp_path))
    assert [g.name for g in asset.geoms] == HULLS
    assert [g.shape.kind for g in asset.geoms] == ["box", "polytope", "polytope", "polytope", "sphere", "cylinder"]
    assert [b.name for b in asset.bodies] == ["base", "wheel"]
    assert not asset.non_convex and not asset.missing and not asset.notes
    assert asset.files == (tmp_path / "meshes" / "three.obj",)


def test_primitives_have_their_sizes_and_their_place(tmp_path: Path) -> None:
    kinds = ['<box size="1 2 3"/>', '<sphere radius="2"/>', '<cylinder radius="1" length="4"/>',
             '<capsule radius="1" length="4"/>', '<box size="1, 2, 3"/>']  # fmt: skip
    box, sphere, cylinder, capsule, commas = (g.shape for g in read(sample(tmp_path, robot(link(*kinds)))).geoms)
    assert isinstance(box, Box) and box.half.tolist() == [0.5, 1, 1.5]
    assert isinstance(sphere, Sphere) and sphere.radius == 2
    assert isinstance(cylinder, Cylinder) and (cylinder.radius, cylinder.half_length) == (1, 2)
    assert isinstance(capsule, Capsule) and (capsule.radius, capsule.half_length) == (1, 2)
    assert isinstance(commas, Box) and commas.half.tolist() == [0.5, 1, 1.5]


def test_a_scaled_and_turned_mesh_is_where_engines_have_it(tmp_path: Path) -> None:
    hull = next(g.shape for g in read(sample(tmp_path)).geoms if g.name == "base/posts#1")
    corners = np.array([[x, y, z] for x in (3, 4) for y in (0, 1) for z in (0, 2)]) * [0.1, 0.1, -0.2]
    expected = Pose.from_rpy([0.1, 0, 0.2], [0, 0.25, 0]).apply(corners)
    assert isinstance(hull, Polytope) and len(hull.vertices) == 8
    np.testing.assert_allclose(np.sort(hull.vertices, axis=0), np.sort(expected, axis=0), atol=1e-12)
    assert hull.volume == pytest.approx(2 * 0.1 * 0.1 * 0.2)


@pytest.mark.parametrize("scale", ["-1 1 1", "1 -2 1", "-1 -1 -1", "-1 -1 1"])
def test_a_reflected_hull_is_closed_outwards(scale: str, tmp_path: Path) -> None:
    mesh = f'<mesh filename="meshes/three.obj" scale="{scale}"/>'
    hull = read(sample(tmp_path, robot(link(mesh)))).geoms[1].shape
    factors = np.array([float(word) for word in scale.split()])
    assert hull.volume == pytest.approx(2 * abs(np.prod(factors)))
    np.testing.assert_allclose(hull.centroid, np.array([3.5, 0.5, 1]) * factors, atol=1e-12)


def test_an_opaque_piece_counts_among_the_pieces_and_is_shown_where_it_is(tmp_path: Path) -> None:
    text = '<mesh filename="meshes/mixed.obj" scale="1 1 -1"/>'
    path = sample(tmp_path, robot(link(text)))
    flat = "v 5 0 2\nv 6 0 2\nv 5 1 2\n"
    (tmp_path / "meshes" / "mixed.obj").write_text(flat + "f 1 2 3\n" + _shifted(THREE, 3))
    asset = read(path)
    assert [o.name for o in asset.non_convex] == ["a/geom0#0"]
    assert [g.name for g in asset.geoms] == ["a/geom0#1", "a/geom0#2", "a/geom0#3"]
    surface = asset.non_convex[0].surface
    assert surface is not None and np.unique(surface.vertices[:, 2]).tolist() == [-2]
    a, b, c = surface.vertices[surface.faces[0]]
    assert np.cross(b - a, c - a)[2] < 0  # what looked up looks down in the mirror


def _shifted(obj: str, by: int) -> str:
    """The OBJ with all vertex numbers raised."""
    rows = (line.split() for line in obj.splitlines())
    return "\n".join(" ".join([r[0], *(str(int(w) + by) for w in r[1:])]) if r[0] == "f" else " ".join(r) for r in rows)


def test_names_count_all_collisions_of_a_link_and_stay_unique(tmp_path: Path) -> None:
    named = '<collision name="geom2"><geometry><sphere radius="1"/></geometry></collision>'
    ball, twice = '<collision><geometry><sphere radius="1"/></geometry></collision>', named.replace("geom2", "x")
    text = robot(f'<link name="a"><collision/>{named}{ball}{twice}{twice}</link>', f'<link name="b">{ball}</link>')
    asset = read(sample(tmp_path, text))
    assert [g.name for g in asset.geoms] == ["a/geom2", "a/geom2@2", "a/x", "a/x@2", "b/geom0"]
    assert [n for n in asset.notes if "a collision of link 'a' on line 2 has no geometry" in n]


def test_visuals_are_read_when_somebody_looks_and_never_fail(tmp_path: Path) -> None:
    seen = ['<mesh filename="meshes/three.obj" scale="1 1 -2"/>', '<box size="1 1 1"/>', "<mesh/>", "<cone/>",
            '<mesh filename="gone.obj"/>', '<mesh filename="meshes/bad.obj"/>', '<box size="x"/>']  # fmt: skip
    visuals = "".join(f"<visual><geometry>{kind}</geometry></visual>" for kind in seen) + "<visual/>"
    path = sample(tmp_path, robot(f'<link name="a">{visuals}</link>'))
    (tmp_path / "meshes" / "bad.obj").write_text("v 0 0 zero\nf 1 2 3\n")
    asset = read(path)
    assert asset.missing == ("gone.obj",)
    for looked in (asset, pickle.loads(pickle.dumps(asset))):
        heights = {float(surface.vertices[:, 2].min()) for surface in looked.visuals}
        assert heights == {-4.0, -0.5}
        assert looked.visuals[0].vertices.shape[1] == 3 and len(looked.visuals[:1]) == 1


def test_an_asset_pickles_and_writes_the_same_in_another_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sample(tmp_path)
    monkeypatch.chdir(tmp_path)
    asset = pickle.loads(pickle.dumps(read(Path("cart.urdf"))))
    monkeypatch.chdir(tmp_path.parent)
    assert list(write(asset).copies.values()) == [tmp_path / "meshes" / "three.obj"]
