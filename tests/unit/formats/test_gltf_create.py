from pathlib import Path

import numpy as np
import pytest
import trimesh

from meshforge.formats import read, save
from meshforge.geometry import Box, Capsule, Cylinder, Ellipsoid, Pose, Sphere, convex_hull, is_same_shape
from meshforge.geometry.pose import rotation_of_quaternion
from meshforge.symbolic import Asset, Body, Document, Geom, Inertial, Joint, Mechanism, NonConvexPiece, Surface
from tests.gltf_files import KHR, tree_of
from tests.gltf_validation import errors
from tests.soups import angle, box

TURN = Pose.from_rpy([1, 2, 3], [0.3, 0.2, 0.1])
SUFFIXES = [".glb", ".gltf"]


def made(*geoms: Geom, bodies: tuple[Body, ...] = (), **rest: object) -> Asset:
    bodies = bodies or (Body("body", Pose.identity()),)
    return Asset(Path("memory"), "memory", bodies, geoms, Document(), **rest)  # type: ignore[arg-type]


def brick(name: str, body: str = "body") -> Geom:
    return Geom(name, body, convex_hull(box()[0]))


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_pieces_of_one_body_become_nodes_of_their_names_that_collide_and_are_seen(tmp_path: Path, suffix: str) -> None:
    hulls = [Geom(f"part {k}", "body", convex_hull(box((2 * k, 0, 0))[0])) for k in range(3)]
    corner = NonConvexPiece("corner", "body", "not convex", Surface(*angle()))
    saved = save(made(*hulls, non_convex=(corner,)), tmp_path / f"a{suffix}")
    after = read(saved.path)
    assert [geom.name for geom in after.geoms] == ["part 0", "part 1", "part 2"]
    assert [piece.name for piece in after.non_convex] == ["corner"]
    assert errors([saved.path]) == [{}]
    scene = trimesh.load_scene(saved.path)
    assert sorted(scene.graph.nodes_geometry) == ["corner", "part 0", "part 1", "part 2"]
    assert scene.volume == pytest.approx(sum(hull.shape.volume for hull in hulls) + 5)


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_bodies_and_native_shapes_become_those_of_the_physics_extension(tmp_path: Path, suffix: str) -> None:
    bodies = (Body("base", TURN), Body("arm", TURN @ TURN))
    shapes = [
        Box(TURN, np.array([0.5, 1, 2])),
        Sphere(TURN, 0.25),
        Cylinder(TURN, 0.5, 1.5),
        Capsule(TURN, 0.5, 1.5),
        convex_hull(box()[0]),
    ]
    geoms = [Geom(f"{body}/g{k}", body, s) for body in ("base", "arm") for k, s in enumerate(shapes)]
    egg = Geom("arm/egg", "arm", Ellipsoid(TURN, np.array([0.5, 1, 2])))
    saved = save(made(*geoms, egg, bodies=bodies), tmp_path / f"a{suffix}")
    after = read(saved.path)
    back = {geom.name: geom for geom in after.geoms}
    assert list(back) == [geom.name for geom in (*geoms, egg)] and not saved.names
    for geom in geoms:
        now = back[geom.name].shape
        assert is_same_shape(now, geom.shape, 1e-9) or now.kind == geom.shape.kind == "polytope"
        assert now.volume == pytest.approx(geom.shape.volume, rel=1e-6) and back[geom.name].body == geom.body
        np.testing.assert_allclose([now.aabb.min, now.aabb.max], [geom.shape.aabb.min, geom.shape.aabb.max], atol=1e-6)
    assert [(loss.kind.one, loss.names) for loss in saved.report.lost] == [("ellipsoid", ("arm/egg",))]
    for body in bodies:
        np.testing.assert_allclose(after.body_poses[body.name].rotation, body.pose.rotation, atol=1e-12)
        np.testing.assert_allclose(after.body_poses[body.name].translation, body.pose.translation, atol=1e-12)
    assert errors([saved.path]) == [{}]


def test_colliders_are_drawn_where_the_asset_shows_nothing_and_the_drawing_goes_with_them(tmp_path: Path) -> None:
    ball = Geom("ball", "body", Sphere(Pose.of_translation([0, 3, 0]), 1.0))
    path = save(made(brick("brick"), ball, Geom("rod", "body", Box(TURN, np.ones(3)))), tmp_path / "a.glb").path
    assert sorted(trimesh.load_scene(path).graph.nodes_geometry) == ["ball", "brick", "rod"]
    asset = read(path)
    kept = [geom for geom in asset.geoms if geom.name == "rod"]
    new = [
        Geom("ball~1", "body", Capsule(Pose.of_translation([0, 3, 0]), 1.0, 1.0), "ball"),
        Geom("brick~1", "body", convex_hull(box((5, 0, 0))[0]), "brick"),
    ]
    out = save(asset.with_geoms([*kept, *new]), tmp_path / "b.glb").path
    assert [geom.name for geom in read(out).geoms] == ["rod", "ball~1", "brick~1"]
    assert sorted(trimesh.load_scene(out).graph.nodes_geometry) == ["ball~1", "brick~1", "rod"]
    assert errors([out]) == [{}]


def test_what_is_shown_is_shown_and_no_collision(tmp_path: Path) -> None:
    asset = made(brick("a/x", "a"), bodies=(Body("a", TURN),), visuals=(Surface(*angle(), "a"),))
    path = save(asset, tmp_path / "a.glb").path
    after = read(path)
    assert [geom.name for geom in after.geoms] == ["a/x"]
    assert [(len(surface.faces), surface.body) for surface in after.visuals] == [(20, "a")]
    np.testing.assert_allclose(after.visuals[0].vertices, angle()[0], atol=1e-6)
    assert list(trimesh.load_scene(path).graph.nodes_geometry) == ["a-visual"]


def test_names_that_an_engine_would_take_for_its_own_do_not_decide_what_is_collision(tmp_path: Path) -> None:
    path = save(made(brick("UCX_a"), brick("b-col"), brick("c")), tmp_path / "a.glb").path
    assert [geom.name for geom in read(path).geoms] == ["UCX_a", "b-col", "c"]


def test_masses_go_along_and_joints_are_told_as_lost(tmp_path: Path) -> None:
    inertia = TURN.rotation @ np.diag([1.0, 2.0, 3.0]) @ TURN.rotation.T
    mechanism = Mechanism(
        joints=(Joint("hinge", "revolute", "a", "b", np.zeros(3), np.array([0.0, 0, 1])),),
        inertials=(Inertial("b", 2.5, np.array([1.0, 2, 3]), inertia),),
    )
    bodies = (Body("a", Pose.identity()), Body("b", TURN))
    saved = save(made(brick("a/x", "a"), brick("b/x", "b"), bodies=bodies, mechanism=mechanism), tmp_path / "a.glb")
    motions = [node["extensions"][KHR]["motion"] for node in tree_of(saved.path.read_bytes())["nodes"][:2]]
    assert motions[0] == {"isKinematic": True}
    x, y, z, w = motions[1].pop("inertiaOrientation")
    axes = TURN.rotation @ rotation_of_quaternion([w, x, y, z])
    np.testing.assert_allclose(axes @ np.diag(motions[1].pop("inertiaDiagonal")) @ axes.T, inertia, atol=1e-12)
    np.testing.assert_allclose(TURN.apply(np.array([motions[1].pop("centerOfMass")]))[0], [1, 2, 3], atol=1e-12)
    assert motions[1] == {"mass": 2.5}
    assert [str(loss) for loss in saved.report.lost] == [
        "1 joint (hinge) is left out: MeshForge does not convert joints to glTF"
    ]


def test_endless_planes_come_back(tmp_path: Path) -> None:
    floor = NonConvexPiece("a/floor", "a", "a plane has no end", plane=TURN)
    path = save(made(brick("a/x", "a"), bodies=(Body("a", TURN @ TURN),), non_convex=(floor,)), tmp_path / "a.glb").path
    (piece,) = read(path).non_convex
    assert piece.name == "a/floor" and piece.plane is not None
    np.testing.assert_allclose(piece.plane.rotation[:, 2], TURN.rotation[:, 2], atol=1e-12)
    np.testing.assert_allclose(piece.plane.translation, TURN.translation, atol=1e-12)
