"""Meshes: contacts, names of hulls and labels."""

from pathlib import Path

import numpy as np
import pytest

import meshforge as mf
from meshforge.checks import check
from meshforge.common import MeshForgeError
from meshforge.formats import load
from meshforge.geometry import Aabb, Box, Pose, Sphere
from meshforge.symbolic import Asset, Body, Document, Geom, Hull, Label, SymbolicMesh, split_by_contact
from tests.corpus_path import corpus
from tests.nearest import distance_bracket
from tests.unit.batch.families import write_urdf_table
from tests.unit.rendering.scenes import table


def box(x: float, size: float = 1.0) -> Box:
    return Box.of_bounds(Aabb([x, 0, 0], [x + size, 1, 1]))


def row(*places: float, epsilon: float = 0.002, scale: float | None = None) -> SymbolicMesh:
    return SymbolicMesh(tuple(Hull("abcdefgh"[k], "body", box(x)) for k, x in enumerate(places)), None, epsilon, scale)


def test_boxes_that_share_a_face_are_in_contact() -> None:
    assert row(0, 1, 3).contacts == {(0, 1)}
    assert row(0, 1, 3).neighbours(1) == {0}


def test_a_chain_through_a_hull_outside_the_selection_connects_nothing() -> None:
    assert split_by_contact(row(0, 1, 2), 0b101) == [0b001, 0b100]


def test_hulls_at_exactly_the_threshold_are_in_contact() -> None:
    assert row(0, 1.02, scale=10.0).contacts == {(0, 1)}
    assert row(0, 1.0201, scale=10.0).contacts == frozenset()


def test_the_threshold_refers_to_the_diagonal_of_all_hulls_unless_a_scale_is_given() -> None:
    mesh = row(0, 4)
    assert mesh.contact_distance == pytest.approx(0.002 * np.sqrt(27))
    assert row(0, 4, scale=2.0).contact_distance == pytest.approx(0.004)


def test_pairs_just_beyond_the_threshold_are_near_misses_nearest_first() -> None:
    mesh = row(0, 1.05, 2.08, 3.2, scale=10.0)
    assert mesh.contacts == frozenset()
    assert [(i, j) for i, j, _ in mesh.near_misses] == [(1, 2), (0, 1)]
    assert mesh.near_misses[0][2] == pytest.approx(0.03)


def test_a_native_sphere_touches_a_box_where_its_surface_does() -> None:
    gap = 0.01
    ball = Sphere(Pose.of_translation([2 + gap, 0.5, 0.5]), 1.0)
    mesh = SymbolicMesh((Hull("box", "b", box(0)), Hull("ball", "b", ball)), scale=1.0)
    assert mesh.contacts == frozenset()
    assert mesh.graph == {}
    near = SymbolicMesh(mesh.hulls, scale=5.0)
    assert near.contacts == {(0, 1)}
    assert near.graph[0, 1] == pytest.approx(gap, abs=1e-8)


def test_hulls_that_share_one_shape_keep_their_contacts_through_an_edit() -> None:
    shared, other = box(0), box(1)
    hulls = (Hull("a", "b", shared), Hull("b", "b", shared), Hull("c", "b", other), Hull("d", "b", box(9)))
    mesh = SymbolicMesh(hulls, scale=10.0)
    assert len(mesh.contacts) == 3
    assert mesh.with_hulls(hulls[:3]).contacts == {(0, 1), (0, 2), (1, 2)}
    assert mesh.with_hulls((*hulls[:3], Hull("e", "b", shared))).contacts == {
        (i, j) for i in range(4) for j in range(i + 1, 4)
    }


def test_labels_can_be_set_and_taken_away_without_measuring_again() -> None:
    mesh = row(0, 1)
    graph = mesh.graph
    labelled = mesh.with_labels({"a": Label("leg", 0.5, "vlm"), "b": Label("top")})
    assert labelled.labels == {"a": Label("leg", 0.5, "vlm"), "b": Label("top")}
    assert labelled.with_labels({"a": None}).labels == {"b": Label("top")}
    assert labelled.known_graph == graph
    assert mesh.labels == {}


def test_an_empty_mesh_has_no_box_and_no_contacts() -> None:
    empty = SymbolicMesh(())
    assert (empty.aabb, empty.diagonal, empty.contacts, empty.adjacency) == (None, 0.0, frozenset(), ())


def asset() -> Asset:
    geoms = (Geom("base/a", "base", box(0)), Geom("base/b", "base", box(1)))
    return Asset(Path("x.urdf"), "urdf", (Body("base", Pose.identity()),), geoms, Document())


def test_an_asset_becomes_a_mesh_with_the_labels_of_its_hulls() -> None:
    mesh = SymbolicMesh.of(asset(), {"base/b": Label("leg"), "gone": Label("leg")})
    assert [(h.name, h.label, h.parent) for h in mesh.hulls] == [("base/a", None, None), ("base/b", "leg", None)]


def test_a_mesh_becomes_its_asset_again_with_its_hulls_as_geoms() -> None:
    mesh = SymbolicMesh.of(asset())
    made = Hull("base/a~1", "base", box(5), parent="base/a")
    lowered = mesh.with_hulls((mesh.hulls[1], made)).to_asset()
    assert [(g.name, g.parent) for g in lowered.geoms] == [("base/b", None), ("base/a~1", "base/a")]
    assert lowered.geoms[0].shape is mesh.hulls[1].shape


def test_a_mesh_made_in_memory_has_no_asset_to_become() -> None:
    with pytest.raises(MeshForgeError, match="made in memory"):
        row(0).to_asset()


def test_a_hull_is_got_by_its_name() -> None:
    mesh = table()
    assert mesh["leg1"] is mesh.hulls[3]
    assert "leg1" in mesh and "leg2" not in mesh
    assert [hull.name for hull in mesh] == [hull.name for hull in mesh.hulls]


def test_a_name_that_no_hull_has_is_a_key_error_with_the_nearest_one(tmp_path: Path) -> None:
    with pytest.raises(KeyError) as caught:
        mf.load(write_urdf_table(tmp_path))["body/tpo"]
    assert isinstance(caught.value, mf.MeshForgeError)
    assert str(caught.value) == f"{tmp_path}/table.urdf: there is no hull 'body/tpo'\n  Did you mean 'body/top'?"
    with pytest.raises(mf.MeshForgeError, match=r"It has 5 hulls; see `\.index`"):
        table()["zzzz"]


def test_labels_are_given_by_name_when_a_mesh_is_loaded(tmp_path: Path) -> None:
    path = write_urdf_table(tmp_path)
    mesh = mf.load(path, labels={"body/top": "seat", "body/left": mf.Label("side", 0.5, "vlm")})
    assert [h.label for h in mesh.hulls] == ["seat", "side", None, None]  # those of the file beside it do not count
    assert (mesh["body/top"].confidence, mesh["body/top"].source) == (1.0, "user")
    assert mesh["body/left"].confidence == 0.5
    assert all(hull.label is None for hull in mf.load(path, labels={}).hulls)
    with pytest.raises(mf.MeshForgeError, match="Did you mean 'body/top'"):
        mf.load(path, labels={"body/topp": "seat"})


REAL = {
    "cups_mugs/pybullet-URDF-models": ("green_cup/model.urdf", "blue_cup/model.urdf"),
    "soap_bottles/pybullet-URDF-models": ("cleanser/model.urdf",),
}


@pytest.mark.slow
@pytest.mark.parametrize(("family", "asset"), [(family, asset) for family, assets in REAL.items() for asset in assets])
def test_contacts_of_a_real_asset_are_those_of_brute_force(family: str, asset: str) -> None:
    (path,) = sorted(corpus(family).rglob(asset))
    mesh = load(path)
    for i, a in enumerate(mesh.hulls):
        for j, b in enumerate(mesh.hulls[i + 1 :], i + 1):
            if (a.aabb.min - b.aabb.max).max() > mesh.contact_distance:
                assert (i, j) not in mesh.contacts
                continue
            below, above, _ = distance_bracket(a.shape, b.shape)
            assert ((i, j) in mesh.contacts) == (above <= mesh.contact_distance)
            assert above - below < 1e-6 * mesh.diagonal
    assert [finding for finding in check(mesh) if finding.severity == "error"] == []
