"""Making an MJCF of an asset of another format, where MuJoCo is particular."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats import SaveResult, read, save
from meshforge.formats.visuals import Visual, VisualSurfaces
from meshforge.geometry import Aabb, Box, Pose, Sphere, convex_hull
from meshforge.symbolic import Asset, Inertial, Joint, Mechanism, NonConvexPiece, Surface
from tests.conversion_samples import TURNED, block, foreign, wedge
from tests.mesh_files import ply, stl_ascii
from tests.soups import angle
from tests.urdf_sample import boxes_obj

ORIGIN, UP = np.zeros(3), np.array([0.0, 0.0, 1.0])


def made(asset: Asset, folder: Path) -> tuple[Asset, Any, SaveResult]:
    """The asset written as MJCF and read back, and the model that MuJoCo compiles."""
    saved = save(asset, folder / "out" / "m.xml")
    return read(saved.path), mujoco.MjModel.from_xml_path(str(saved.path)), saved


def pair(kind: Any = "revolute", **more: Any) -> Asset:
    asset = foreign(
        {"base": Pose.identity(), "arm": TURNED},
        [("base/foot", "base", block(0, 0, 0)), ("arm/bone", "arm", Sphere(TURNED, 0.2))],
    )
    return replace(asset, mechanism=Mechanism((Joint("j", kind, "base", "arm", TURNED.translation, UP, **more),)))


def with_mass(asset: Asset, body: str, mass: float, *moments: float) -> Asset:
    inertial = Inertial(body, mass, ORIGIN, np.diag(moments))
    return replace(asset, mechanism=replace(asset.mechanism, inertials=(inertial,)))


def test_the_root_called_world_is_the_world(tmp_path: Path) -> None:
    asset = foreign({"world": Pose.identity(), "cup": TURNED}, [("world/table", "world", block(0, 0, 0))])
    joint = Joint("loose", "floating", "world", "cup", ORIGIN, UP)
    mass = Inertial("world", 5.0, ORIGIN, np.eye(3))
    after, model, saved = made(replace(asset, mechanism=Mechanism((joint,), (mass,))), tmp_path)
    assert [body.name for body in after.bodies] == ["world", "cup"]
    assert [geom.name for geom in after.geoms] == ["world/table"]
    assert model.jnt_type.tolist() == [mujoco.mjtJoint.mjJNT_FREE]
    assert "1 mass (world) is left out: the world of MuJoCo has none" in saved.notes


def test_no_other_body_is_called_world(tmp_path: Path) -> None:
    asset = foreign(
        {"base": Pose.identity(), "world": TURNED},
        [("base/a", "base", block(0, 0, 0)), ("world/b", "world", block(1, 2, 3))],
    )
    joint = Joint("j", "revolute", "base", "world", TURNED.translation, UP)
    after, _, saved = made(replace(asset, mechanism=Mechanism((joint,))), tmp_path)
    assert [body.name for body in after.bodies] == ["world", "base", "world_2"]
    assert saved.names == {"world/b": "world_2/b"}


def test_a_floating_body_on_a_still_one_moves_freely_in_the_world(tmp_path: Path) -> None:
    after, model, saved = made(pair("floating"), tmp_path)
    assert model.jnt_type.tolist() == [mujoco.mjtJoint.mjJNT_FREE]
    assert model.body_parentid.tolist() == [0, 0, 0]
    np.testing.assert_allclose(after.geoms[1].shape.centroid, TURNED.translation, atol=1e-12)
    assert not [note for note in saved.notes if "freejoint" in note]


def test_names_that_bodies_share_are_kept_by_the_body_s_name(tmp_path: Path) -> None:
    asset = foreign(
        {"a": Pose.identity(), "b": Pose.identity()},
        [("a/part", "a", block(0, 0, 0)), ("b/part", "b", block(2, 0, 0)), ("b/geom1", "b", block(4, 0, 0))],
    )
    after, model, saved = made(asset, tmp_path)
    assert [geom.name for geom in after.geoms] == ["a/part", "b/part", "b/geom1"]
    assert [model.geom(k).name for k in range(3)] == ["a/part", "b/part", ""]
    assert saved.names == {}


def test_joints_of_one_name_get_names_of_their_own(tmp_path: Path) -> None:
    asset = foreign({name: Pose.identity() for name in "abc"}, [(f"{n}/x", n, block(0, 0, 0)) for n in "abc"])
    twins = tuple(Joint("j", "revolute", "a", child, ORIGIN, UP) for child in "bc")
    _, model, _ = made(replace(asset, mechanism=Mechanism(twins)), tmp_path)
    assert [model.joint(k).name for k in range(2)] == ["j", "j@2"]


def test_each_hull_is_a_file_of_its_own_and_a_mesh_of_its_own(tmp_path: Path) -> None:
    asset = foreign({"a": Pose.identity()}, [("a/x y", "a", wedge(0)), ("a/x_y", "a", wedge(5))])
    _, model, saved = made(asset, tmp_path)
    assert model.nmesh == 2
    assert sorted(path.name for path in saved.files) == ["m--a_x_y.obj", "m--a_x_y_2.obj", "m.xml"]


def test_a_hull_far_from_its_body_keeps_its_digits(tmp_path: Path) -> None:
    box = Box.of_bounds(Aabb((1000, 2000, -500), (1000.001, 2000.002, -499.997))).tessellate()
    shape = convex_hull(box.vertices)
    after, _, _ = made(foreign({"a": Pose.identity()}, [("a/far", "a", shape)]), tmp_path)
    np.testing.assert_allclose(after.geoms[0].shape.aabb.size, shape.aabb.size, rtol=1e-5)


@pytest.mark.parametrize("side", [1e-3, 1e-4, 1e-5])
def test_tiny_hulls_compile_alone_or_on_a_body_that_moves(side: float, tmp_path: Path) -> None:
    tiny = convex_hull(Box.of_bounds(Aabb((0, 0, 0), (side, side, side))).tessellate().vertices)
    asset = foreign({"a": Pose.identity(), "b": Pose.identity()}, [("a/x", "a", tiny), ("b/x", "b", tiny)])
    joint = Joint("j", "revolute", "a", "b", ORIGIN, UP)
    after, model, _ = made(replace(asset, mechanism=Mechanism((joint,))), tmp_path)
    assert len(after.geoms) == model.ngeom == 2


@pytest.mark.parametrize(
    ("mass", "moments", "wanted"),
    [
        (2.0, (0.1, 0.2, 0.25), (0.1, 0.2, 0.25)),
        (2.0, (0.1, 0.2, 0.3), (0.1, 0.2, 0.3)),  # flat: two are just as much as the third
        (2.0, (0.1, 0.1, 0.7), (0.3, 0.3, 0.3)),
        (2.0, (0.0, 0.0, 0.0), (2e-9, 2e-9, 2e-9)),
        (1e-12, (1e-30, 1e-30, 1e-30), (1e-9, 1e-9, 1e-9)),
    ],
)
def test_mass_and_moments_are_such_as_mujoco_takes(
    mass: float, moments: tuple[float, ...], wanted: tuple[float, ...], tmp_path: Path
) -> None:
    _, model, saved = made(with_mass(pair(), "arm", mass, *moments), tmp_path)
    assert model.body_mass[2] == pytest.approx(max(mass, 1e-6 if mass < 1e-9 else 0))
    assert sorted(model.body_inertia[2]) == pytest.approx(sorted(wanted), rel=1e-6)
    mended = [note for note in saved.notes if "no rigid body has" in note]
    assert len(mended) == (mass > 1e-9 and moments != wanted)


def test_a_moving_body_of_nothing_gets_a_little_mass(tmp_path: Path) -> None:
    asset = foreign({"a": Pose.identity(), "b": Pose.identity()}, [("a/x", "a", block(0, 0, 0))])
    joint = Joint("j", "revolute", "a", "b", ORIGIN, UP)
    _, model, saved = made(replace(asset, mechanism=Mechanism((joint,))), tmp_path)
    assert model.body_mass[2] == pytest.approx(1e-6)
    assert "moving bodies without a mass to speak of get 1e-06 kg (b)" in saved.notes


def test_a_plane_stands_still_or_is_left_out(tmp_path: Path) -> None:
    asset = pair()
    planes = tuple(NonConvexPiece(f"{b}/floor", b, "a plane has no end", plane=TURNED) for b in ("base", "arm"))
    after, model, saved = made(replace(asset, non_convex=planes), tmp_path)
    assert [piece.name for piece in after.non_convex] == ["base/floor"]
    place = after.non_convex[0].plane
    assert place is not None
    np.testing.assert_allclose(place.rotation, TURNED.rotation, atol=1e-7)
    assert (model.geom_type == mujoco.mjtGeom.mjGEOM_PLANE).sum() == 1
    assert [note for note in saved.notes if "arm/floor" in note] == [
        "1 endless plane (arm/floor) is left out: MuJoCo has planes on bodies that do not move only"
    ]


def shown(folder: Path, name: str, text: str | bytes, **more: Any) -> Asset:
    """A body that shows a mesh file, twice as large and mirrored."""
    path = folder / "in" / name
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    visual = Visual("base", path, TURNED.rotation * np.array([2.0, 2.0, -2.0]), TURNED.translation, **more)
    return replace(pair(), visuals=VisualSurfaces((visual,)))


ONE = boxes_obj(((0, 0, 0), (1, 2, 3)))
TWO = "o left\n" + ONE + "o right\n" + ONE.replace("v 0.0", "v 5.0")
TRIANGLE = np.eye(3), np.array([[0, 1, 2]])


def test_a_visual_is_copied_as_it_is_and_does_not_collide_nor_weigh(tmp_path: Path) -> None:
    asset = shown(tmp_path, "box.obj", ONE, rgba=(0.1, 0.2, 0.3, 0.5))
    after, model, saved = made(asset, tmp_path)
    assert (tmp_path / "out" / "m--visuals" / "box.obj").read_text() == ONE
    visual = int(np.flatnonzero(model.geom_contype == 0)[0])
    assert (model.geom_group[visual], model.geom_conaffinity[visual]) == (2, 0)
    np.testing.assert_allclose(model.geom_rgba[visual], [0.1, 0.2, 0.3, 0.5], atol=1e-7)
    alone = mujoco.MjModel.from_xml_path(str(save(pair(), tmp_path / "alone.xml").path))
    np.testing.assert_allclose(model.body_mass, alone.body_mass)
    assert len(after.geoms) == 2
    np.testing.assert_allclose(after.visuals[0].vertices, asset.visuals[0].vertices, atol=1e-6)
    assert after.visuals[0].rgba == pytest.approx((0.1, 0.2, 0.3, 0.5))
    assert saved.path.name == "m.xml"


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("two.obj", TWO),
        ("mixed.obj", "vt 0 0\nvn 0 0 1\n" + ONE.replace("f 1 ", "f 1/1/1 ", 1)),
        ("few.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("text.stl", stl_ascii(TRIANGLE)),
        ("one.ply", ply(TRIANGLE)),
    ],
)
def test_a_visual_that_mujoco_shows_in_part_or_refuses_is_an_obj(name: str, text: str | bytes, tmp_path: Path) -> None:
    asset = shown(tmp_path, name, text)
    _, model, saved = made(asset, tmp_path)
    assert not [path for path in saved.files if path.name == name]
    assert model.mesh_facenum[0] == sum(len(surface.faces) for surface in asset.visuals)


def test_a_visual_that_is_sheared_is_written_as_it_looks(tmp_path: Path) -> None:
    asset = shown(tmp_path, "box.obj", ONE)
    assert isinstance(asset.visuals, VisualSurfaces)
    sheared = replace(asset.visuals.visuals[0], linear=np.array([[1, 1, 0], [0, 1, 0], [0, 0, 1.0]]))
    asset = replace(asset, visuals=VisualSurfaces((sheared,)))
    after, _, _ = made(asset, tmp_path)
    np.testing.assert_allclose(after.visuals[0].vertices, asset.visuals[0].vertices, atol=1e-5)


def test_an_opaque_piece_is_the_mesh_that_mujoco_hulls_whatever_its_body_shows(tmp_path: Path) -> None:
    surface = Surface(*angle())
    pieces = (
        NonConvexPiece("base/shell", "base", "not convex", surface),
        NonConvexPiece("arm/shell", "arm", "not convex", surface),
    )
    asset = replace(shown(tmp_path, "box.obj", ONE), non_convex=pieces)
    after, model, saved = made(asset, tmp_path)
    assert [visual.body for visual in after.visuals] == ["base"]
    assert int((model.geom_contype != 0).sum()) == 4
    assert [geom.name for geom in after.geoms] == ["base/foot", "base/shell", "arm/bone", "arm/shell"]
    assert saved.hulled == ("base/shell", "arm/shell")
    assert [note for note in saved.notes if "convex" in note] == [
        "each of 2 non-convex pieces (base/shell, arm/shell) is written as it is: MuJoCo will collide with its hull "
        "(71% full)"
    ]


def test_a_flat_opaque_piece_which_mujoco_refuses_is_lost_and_said_to_be(tmp_path: Path) -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0.9, 0.1, 0]], dtype=float)
    flat = NonConvexPiece("arm/sheet", "arm", "flat", Surface(points, np.array([[0, 1, 3], [1, 2, 3]])))
    after, _, saved = made(replace(pair(), non_convex=(flat,)), tmp_path)
    assert [geom.name for geom in after.geoms] == ["base/foot", "arm/bone"] and saved.hulled == ()
    assert "1 opaque piece (arm/sheet) is left out: MuJoCo refuses a mesh that is flat" in saved.notes
    with pytest.raises(AssetError, match="arm/sheet would collide no more: MuJoCo refuses a mesh that is flat"):
        saved.report.refuse_lost_collision("here", "Make a hull of it.")


def test_a_body_of_a_mesh_alone_has_the_mass_of_its_hull(tmp_path: Path) -> None:
    surface = Surface(*angle())
    asset = replace(pair(), non_convex=(NonConvexPiece("arm/shell", "arm", "not convex", surface),))
    asset = replace(asset, geoms=asset.geoms[:1])
    _, model, saved = made(asset, tmp_path)
    assert model.body("arm").mass[0] == pytest.approx(1000 * convex_hull(surface.vertices).volume)
    assert "MuJoCo computes the masses that the file does not say, at 1000 kg/m^3 (base, arm)" in saved.notes


def test_without_visuals_hulls_are_shown_and_with_them_they_are_in_group_three(tmp_path: Path) -> None:
    assert made(pair(), tmp_path / "a")[1].geom_group.tolist() == [0, 0]
    model = made(shown(tmp_path, "box.obj", ONE), tmp_path / "b")[1]
    assert sorted(model.geom_group.tolist()) == [2, 3, 3]
