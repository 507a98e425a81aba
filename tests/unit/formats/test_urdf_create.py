"""Making a URDF from an asset of another format."""

from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from meshforge.formats import save
from meshforge.formats.base import Output
from meshforge.formats.conversion import report_conversion
from meshforge.formats.urdf.edit import CAPSULE_READERS
from meshforge.formats.urdf.format import UrdfFormat
from meshforge.formats.visuals import Visual, VisualSurfaces
from meshforge.geometry import Aabb, Box, Capsule, Cylinder, Pose, Sphere
from meshforge.symbolic import Asset, Joint, Mechanism, NonConvexPiece, Surface
from tests.conversion_samples import foreign
from tests.urdf_engines import assert_mujoco_agrees, bullet, mujoco_model, yourdf
from tests.urdf_sample import boxes_obj, put, read

TURNED = Pose.from_rpy([1, 2, 3], [0.4, -1.1, 2.0])
BLOCK = Box.of_bounds(Aabb((0, 0, 0), (1, 2, 3)))
BLOCK_OBJ = boxes_obj(((0, 0, 0), (1, 2, 3)))


def created(asset: Asset, tmp_path: Path) -> tuple[Asset, Path, Output]:
    output = UrdfFormat().create(asset, "new.urdf")
    path = put(output, tmp_path / "new.urdf")
    return read(path), path, output


def told(asset: Asset, output: Output) -> tuple[str, ...]:
    return report_conversion(asset, None, UrdfFormat(), output).sentences


CART = foreign(
    {"frame": Pose.identity(), "wheel <1>": TURNED, "lid": Pose.of_translation([0, 0, 1])},
    [
        ("frame/geom0", "frame", BLOCK),
        ("wheel <1>/tyre", "wheel <1>", Cylinder(TURNED, 0.3, 0.1)),
        ("wheel <1>/hub#2", "wheel <1>", Sphere(TURNED, 0.2)),
        ("lid/knob", "lid", BLOCK.tessellate()),
        ("lid/rod", "lid", Capsule(TURNED, 0.1, 0.4)),
    ],
)


def test_bodies_hulls_and_names_come_back(tmp_path: Path) -> None:
    again, _, output = created(CART, tmp_path)
    assert [b.name for b in again.bodies] == [b.name for b in CART.bodies]
    assert [g.name for g in again.geoms] == [g.name for g in CART.geoms]
    for name, pose in CART.body_poses.items():
        np.testing.assert_allclose(again.body_poses[name].rotation, pose.rotation, atol=1e-12)
        np.testing.assert_allclose(again.body_poses[name].translation, pose.translation, atol=1e-12)
    for old, new in zip(CART.geoms, again.geoms, strict=True):
        shape = old.shape.tessellate() if old.shape.kind == "capsule" else old.shape
        assert new.shape.kind == shape.kind
        np.testing.assert_allclose(new.shape.aabb.min, shape.aabb.min, atol=1e-12)
        np.testing.assert_allclose(new.shape.aabb.max, shape.aabb.max, atol=1e-12)
    assert told(CART, output) == (
        "3 links without a mass (frame, wheel <1>, lid): PyBullet takes 1 kg, MuJoCo computes it from the hulls",
        f"1 capsule (lid/rod) is written as triangles: {CAPSULE_READERS}",
    )


def test_all_engines_load_it(tmp_path: Path) -> None:
    _, path, _ = created(CART, tmp_path)
    assert len(bullet(path)["shapes"]) == 3
    assert mujoco_model(path).ngeom == 5
    assert_mujoco_agrees(path)
    assert len(yourdf(path).robot.links) == 3


def test_a_plain_mesh_becomes_one_link(tmp_path: Path) -> None:
    plain = foreign({"body": Pose.identity()}, [("part 1", "body", BLOCK), ("part#2", "body", BLOCK.tessellate())])
    again, path, output = created(plain, tmp_path)
    assert [b.name for b in again.bodies] == ["body"]
    assert [g.name for g in again.geoms] == ["body/part 1", "body/part#2"]
    assert output.names == {"part 1": "body/part 1", "part#2": "body/part#2"}
    assert (tmp_path / "new--part_2.obj").is_file()
    assert b"<joint" not in path.read_bytes()


def test_bodies_that_are_all_elsewhere_get_a_root_of_their_own(tmp_path: Path) -> None:
    moved = foreign({"base": TURNED}, [("base/a", "base", BLOCK)])
    again, _, _ = created(moved, tmp_path)
    assert [b.name for b in again.bodies] == ["base_2", "base"]
    np.testing.assert_allclose(again.geoms[0].shape.aabb.max, BLOCK.aabb.max, atol=1e-12)


@pytest.mark.parametrize("flat", [True, False])
def test_opaque_pieces_are_meshes_as_they_are_unless_they_are_flat(flat: bool, tmp_path: Path) -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0 if flat else 1]], dtype=float)
    surface = Surface(points, np.array([[0, 2, 1], [0, 1, 3]]))
    opaque = [
        NonConvexPiece("lid/open", "lid", "open", surface),
        NonConvexPiece("lid/floor", "lid", "a plane has no end"),
    ]
    again, _, output = created(foreign({"lid": Pose.identity()}, [("lid/a", "lid", BLOCK)], *opaque), tmp_path)
    assert [o.name for o in again.non_convex] == ([] if flat else ["lid/open"])
    said = told(foreign({"lid": Pose.identity()}, [("lid/a", "lid", BLOCK)], *opaque), output)
    assert "1 piece without a surface (lid/floor) is left out: a plane has no end" in said
    assert [n for n in said if "lid/open" in n] == [
        "1 opaque piece (lid/open) is left out: engines refuse a mesh that is flat"
        if flat
        else "1 non-convex piece (lid/open) is written as it is: MuJoCo and Bullet will collide with its hull"
    ]


def jointed(*joints: Joint, bodies: dict[str, Pose] | None = None) -> Asset:
    """Bodies with a hull each, with joints between them."""
    poses = bodies or {"base": Pose.identity(), "arm": TURNED}
    asset = foreign(poses, [(f"{name}/a", name, BLOCK) for name in poses if name != "world"])
    return replace(asset, mechanism=Mechanism(joints))


def elements(path: Path, tag: str) -> dict[str, ElementTree.Element]:
    return {element.attrib["name"]: element for element in ElementTree.parse(path).getroot().iter(tag)}


def test_a_link_has_its_frame_on_the_axis_of_its_joint(tmp_path: Path) -> None:
    axis = np.array([0.6, 0.0, 0.8])
    away = TURNED.translation + np.array([0.5, 0, 0])
    again, _, _ = created(jointed(Joint("j", "revolute", "base", "arm", away, axis)), tmp_path)
    joint = again.mechanism.joints[0]
    np.testing.assert_allclose(joint.axis, axis, atol=1e-12)
    np.testing.assert_allclose(np.cross(joint.anchor - away, axis), 0, atol=1e-12)
    assert np.linalg.norm(joint.anchor - TURNED.translation) == pytest.approx(0.4)  # the nearest point of the axis
    np.testing.assert_allclose(again.geoms[1].shape.aabb.max, BLOCK.aabb.max, atol=1e-12)


def test_limits_are_told_as_urdf_wants_them(tmp_path: Path) -> None:
    bodies = {name: Pose.identity() for name in ("base", "a", "b", "c")}
    x = np.array([1.0, 0, 0])
    joints = (
        Joint("endless", "revolute", "base", "a", np.zeros(3), x),
        Joint("hinge", "revolute", "base", "b", np.zeros(3), x, (-1.0, 0.5), effort=3.0, velocity=4.0),
        Joint("rail", "prismatic", "base", "c", np.zeros(3), x),
    )
    _, path, output = created(jointed(*joints, bodies=bodies), tmp_path)
    found = elements(path, "joint")
    assert {name: joint.attrib["type"] for name, joint in found.items()} == {
        "endless": "continuous",
        "hinge": "revolute",
        "rail": "prismatic",
    }
    limits = {name: limit.attrib for name, joint in found.items() if (limit := joint.find("limit")) is not None}
    assert limits == {
        "hinge": {"lower": "-1", "upper": "0.5", "effort": "3", "velocity": "4"},
        "rail": {"lower": "-1000", "upper": "1000", "effort": "1000", "velocity": "1000"},
    }
    assert "prismatic joints without limits (rail) are limited to 1000 m each way" in output.notes


def test_a_world_that_only_holds_one_body_is_left_out(tmp_path: Path) -> None:
    bodies = {"world": Pose.identity(), "cup": TURNED}
    free = Joint("loose", "floating", "world", "cup", np.zeros(3), np.array([0, 0, 1.0]))
    asset = jointed(free, bodies=bodies)
    again, _, output = created(asset, tmp_path)
    assert [body.name for body in again.bodies] == ["cup"]
    np.testing.assert_array_equal(again.body_poses["cup"].translation, 0)
    np.testing.assert_allclose(again.geoms[0].shape.aabb.max, BLOCK.aabb.max, atol=1e-12)
    said = told(asset, output)
    assert "1 joint (loose) is left out: the root link of a URDF has none" in said
    assert any(note.startswith("'cup' moves freely: it is the root link") for note in said)
    hinged = jointed(replace(free, kind="revolute"), bodies=bodies)
    assert [body.name for body in created(hinged, tmp_path)[0].bodies] == ["world", "cup"]


def test_two_free_bodies_float_in_the_world(tmp_path: Path) -> None:
    bodies = {"world": Pose.identity(), "cup": TURNED, "lid": Pose.identity()}
    up = np.array([0, 0, 1.0])
    joints = tuple(Joint("", "floating", "world", child, np.zeros(3), up) for child in ("cup", "lid"))
    again, path, _ = created(jointed(*joints, bodies=bodies), tmp_path)
    assert [(joint.name, joint.kind) for joint in again.mechanism.joints] == [
        ("cup_floating", "floating"),
        ("lid_floating", "floating"),
    ]
    assert mujoco_model(path).njnt == 2


def test_joints_of_one_body_have_light_links_between_them(tmp_path: Path) -> None:
    x, z = np.array([1.0, 0, 0]), np.array([0, 0, 1.0])
    slide = Joint("slide", "prismatic", "base", "arm", np.zeros(3), x, (0.0, 1.0))
    turn = Joint("", "ball", "base", "arm", np.array([4.0, 5, 6]), z)
    asset = jointed(slide, turn)
    again, path, output = created(asset, tmp_path)
    assert [joint.kind for joint in again.mechanism.joints] == ["prismatic", "revolute", "revolute", "revolute"]
    assert [body.name for body in again.bodies] == ["base", "arm_slide", "arm_arm_ball_x", "arm_arm_ball_y", "arm"]
    assert [inertial.mass for inertial in again.mechanism.inertials] == [1e-6] * 3
    for joint in again.mechanism.joints[1:]:  # all three axes go through the middle of the ball
        np.testing.assert_allclose(np.cross(joint.anchor - [4, 5, 6], joint.axis), 0, atol=1e-12)
    assert mujoco_model(path).njnt == 4
    said = told(asset, output)
    assert "1 ball joint is written as three joints that turn about one point: URDF has no ball joints" in said
    assert "links of 1e-06 kg stand between joints of one body (arm_slide, arm_arm_ball_x, arm_arm_ball_y)" in said


def test_visuals_are_copied_with_what_lies_beside_them_or_become_objs(tmp_path: Path) -> None:
    folder = tmp_path / "in"
    (folder / "b").mkdir(parents=True)
    (folder / "a.obj").write_text("mtllib b/a.mtl\n" + BLOCK_OBJ)
    (folder / "b" / "a.mtl").write_text("newmtl oak\n")
    ply = folder / "b" / "c.ply"
    save(foreign({"x": Pose.identity()}, [("x", "x", BLOCK)]), ply)
    linear = TURNED.rotation * np.array([2.0, 3.0, -4.0])
    visuals = (
        Visual("base", folder / "a.obj", linear, TURNED.translation, (1.0, 0.5, 0.25, 1.0)),
        Visual("base", ply, np.eye(3), np.zeros(3)),
        Visual("arm", Capsule(TURNED, 0.1, 0.4), np.eye(3), np.zeros(3)),
        Visual("arm", Sphere(TURNED, 0.1), np.eye(3), np.zeros(3)),
    )
    asset = replace(jointed(), visuals=VisualSurfaces(visuals))
    again, path, output = created(asset, tmp_path / "out")
    assert sorted(output.copies) == ["new--visuals/a.obj", "new--visuals/b/a.mtl"]
    assert b'<mesh filename="new--visuals/a.obj" scale="2 3 -4"/>' in output.main
    assert len(again.visuals) == len(asset.visuals) == 4
    for old, new in zip(asset.visuals, again.visuals, strict=True):
        assert (new.body, new.rgba) == (old.body, old.rgba)
        np.testing.assert_allclose(new.vertices.max(axis=0), old.vertices.max(axis=0), atol=1e-6)
        np.testing.assert_allclose(new.vertices.min(axis=0), old.vertices.min(axis=0), atol=1e-6)
    assert [len(link.visuals) for link in yourdf(path).robot.links] == [2, 2]
