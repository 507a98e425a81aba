"""SDF files as assets: shapes where Gazebo has them, frames, meshes in their units, joints, masses, visuals."""

from pathlib import Path

import numpy as np
import pytest

from meshforge.common import AssetError
from meshforge.formats import read as read_any
from meshforge.formats.visuals import VisualSurfaces
from meshforge.geometry import Pose
from tests.corpus_case import ROOT
from tests.sdf_sample import HULLS, box, link, model, put_text, read, sample

PARTS = ROOT / "sdf" / "parts"


def middle(folder: Path, text: str, name: str = "a/c0") -> list[float]:
    """The centre of a hull, rounded."""
    asset = read(put_text(folder, text))
    return [round(x, 9) + 0.0 for x in next(g.shape.aabb.center for g in asset.geoms if g.name == name).tolist()]


def test_the_sample_has_its_hulls_bodies_joint_masses_and_visual(tmp_path: Path) -> None:
    asset = read(sample(tmp_path))
    assert [geom.name for geom in asset.geoms] == HULLS
    assert [body.name for body in asset.bodies] == ["base", "wheel"]
    np.testing.assert_allclose(asset.body_poses["wheel"].translation, [0.4, 0.3, 0.5])
    (joint,) = asset.mechanism.joints
    assert (joint.name, joint.kind, joint.parent, joint.child) == ("axle", "revolute", "base", "wheel")
    np.testing.assert_allclose(joint.axis, Pose.from_rpy([0, 0, 0], [1.57, 0, 0]).rotation[:, 2], atol=1e-12)
    assert {i.body: i.mass for i in asset.mechanism.inertials} == {"base": 2.5, "wheel": 0.5}
    np.testing.assert_allclose(asset.mechanism.inertials[1].inertia, np.eye(3), atol=1e-12)  # libsdformat's default
    assert isinstance(asset.visuals, VisualSurfaces)
    assert asset.visuals.visuals[0].rgba == (1, 0.25, 0, 1)
    assert asset.missing == ()


@pytest.mark.parametrize(
    ("geometry", "kind", "size"),
    [
        (box(1, 2, 3), "box", [1, 2, 3]),
        ("<sphere><radius>0.5</radius></sphere>", "sphere", [1, 1, 1]),
        ("<cylinder><radius>0.5</radius><length>3</length></cylinder>", "cylinder", [1, 1, 3]),
        ("<capsule><radius>0.5</radius><length>3</length></capsule>", "capsule", [1, 1, 4]),
        ("<ellipsoid><radii>1 2 3</radii></ellipsoid>", "ellipsoid", [2, 4, 6]),
        ("<cone><radius>0.5</radius><length>3</length></cone>", "polytope", [1, 1, 3]),
    ],
)  # fmt: skip
def test_primitives_have_their_sizes(geometry: str, kind: str, size: list[float], tmp_path: Path) -> None:
    (geom,) = read(put_text(tmp_path, model(link(geometry)))).geoms
    assert geom.shape.kind == kind
    np.testing.assert_allclose(geom.shape.aabb.size, size, atol=1e-9)


def test_a_plane_is_opaque_and_knows_where_it_is(tmp_path: Path) -> None:
    plane = "<plane><normal>0 1 0</normal></plane>"
    (piece,) = read(put_text(tmp_path, model(link(plane, more="<pose>0 0 7 0 0 0</pose>")))).non_convex
    assert piece.plane is not None
    np.testing.assert_allclose(piece.plane.rotation[:, 2], [0, 1, 0], atol=1e-12)
    assert piece.plane.translation.tolist() == [0, 0, 7]


def test_poses_count_from_the_frames_that_they_name(tmp_path: Path) -> None:
    frames = (
        '<frame name="f"><pose>1 0 0 0 0 1.5707963267948966</pose></frame>'
        '<frame name="g" attached_to="f"><pose>1 0 0 0 0 0</pose></frame>'
    )
    inside = '<pose relative_to="g">1 0 0 0 0 0</pose><collision name="c0">{}<geometry>{}</geometry></collision>'
    own = f'<link name="a">{inside}</link>'
    assert middle(tmp_path, model(frames, own.format("", box()))) == [1, 2, 0]
    assert middle(tmp_path, model(frames, own.format('<pose relative_to="f">0 0 5 0 0 0</pose>', box()))) == [1, 0, 5]
    at_model = own.format('<pose relative_to="__model__">0 0 5 0 0 0</pose>', box())
    assert middle(tmp_path, model("<pose>0 0 1 0 0 0</pose>", frames, at_model)) == [0, 0, 6]


def test_a_joint_stands_at_its_child_and_links_may_count_from_it(tmp_path: Path) -> None:
    joint = '<joint name="j" type="fixed"><pose>0 0 1 0 0 0</pose><parent>b</parent><child>c</child></joint>'
    links = '<link name="b"/><link name="c"><pose>5 0 0 0 0 0</pose></link>'
    assert middle(tmp_path, model(links, joint, link(box(), more='<pose relative_to="j"/>'))) == [5, 0, 1]


def test_degrees_quaternions_and_placement_frames_count(tmp_path: Path) -> None:
    turned = '<pose degrees="true">0 0 0 0 0 90</pose>'
    far = '<collision name="c0"><pose>2 0 0 0 0 0</pose><geometry><box/></geometry></collision>'
    assert middle(tmp_path, model(turned, f'<link name="a">{far}</link>')) == [0, 2, 0]
    quat = '<pose rotation_format="quat_xyzw">0 0 0 0 0 3 3</pose>'
    assert middle(tmp_path, model(quat, f'<link name="a">{far}</link>')) == [0, 2, 0]
    placed = model("<pose>0 0 9 0 0 0</pose>", link(box()), '<frame name="f"><pose>0 0 1 0 0 0</pose></frame>',
                   attributes=' placement_frame="f"')  # fmt: skip
    assert middle(tmp_path, placed) == [0, 0, 8]


def test_nested_models_have_scopes(tmp_path: Path) -> None:
    inner = f'<model name="n"><pose>0 0 5 0 0 0</pose>{link(box())}</model>'
    text = model(inner, link(box(), more='<pose relative_to="n::a">1 0 0 0 0 0</pose>'))
    assert middle(tmp_path, text) == [1, 0, 5]
    assert middle(tmp_path, text, "n::a/c0") == [0, 0, 5]


@pytest.mark.parametrize(("version", "turned"), [("1.4", False), ("1.5", True), ("1.7", True)])
def test_up_to_1_4_the_axis_of_a_joint_is_told_in_the_model(version: str, turned: bool, tmp_path: Path) -> None:
    child = '<link name="b"><pose>0 0 0 1.5707963267948966 0 0</pose></link>'
    joint = '<joint name="j" type="revolute"><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>'
    asset = read(put_text(tmp_path, model(link(box()), child, joint, version=version)))
    np.testing.assert_allclose(asset.mechanism.joints[0].axis, [0, -1, 0] if turned else [0, 0, 1], atol=1e-12)


def test_a_joint_of_the_name_of_a_link_stands_at_its_child(tmp_path: Path) -> None:
    child = '<link name="b"><pose>0 0 3 0 0 0</pose></link>'
    joint = '<joint name="a" type="revolute"><pose>1 0 0 0 0 0</pose><parent>a</parent><child>b</child></joint>'
    (found,) = read(put_text(tmp_path, model(link(box()), child, joint, version="1.6"))).mechanism.joints
    assert found.anchor.tolist() == [1, 0, 3]


def test_an_axis_in_a_frame_that_is_not_there_is_refused(tmp_path: Path) -> None:
    joint = (
        '<joint name="j" type="revolute"><parent>a</parent><child>b</child>'
        '<axis><xyz expressed_in="bb">0 0 1</xyz></axis></joint>'
    )
    with pytest.raises(AssetError, match="there is no frame 'bb' in this model"):
        read(put_text(tmp_path, model(link(box()), '<link name="b"/>', joint)))


def test_models_and_what_is_in_them_may_have_one_name(tmp_path: Path) -> None:
    inner = f'<model name="a"><pose>0 0 5 0 0 0</pose>{link(box())}</model>'
    text = model(inner, link(box(), more="<pose>1 0 0 0 0 0</pose>"), version="1.6")
    assert middle(tmp_path, text) == [1, 0, 0]
    assert middle(tmp_path, text, "a::a/c0") == [0, 0, 5]


def test_joints_may_name_frames_and_the_world_but_no_types_of_two_axes(tmp_path: Path) -> None:
    text = model(
        link(box()),
        '<link name="b"/><link name="c"/><frame name="f" attached_to="g"/><frame name="g" attached_to="a"/>',
        '<joint name="j" type="prismatic"><parent>f</parent><child>b</child><axis><xyz expressed_in="__model__">0 2 0'
        "</xyz><limit><lower>-1</lower><upper>2</upper><effort>5</effort></limit></axis></joint>",
        '<joint name="w" type="fixed"><parent>world</parent><child>a</child></joint>',
        '<joint name="u" type="universal"><parent>b</parent><child>c</child></joint>',
    )
    asset = read(put_text(tmp_path, text))
    assert [(j.name, j.kind, j.parent, j.child) for j in asset.mechanism.joints] == [
        ("j", "prismatic", "a", "b"),
        ("w", "fixed", "world", "a"),
    ]
    assert "1 joint passed over, not understood (u)" in asset.notes
    assert asset.mechanism.joints[0].limits == (-1, 2)
    assert asset.mechanism.joints[0].effort == 5
    assert asset.mechanism.joints[0].axis.tolist() == [0, 1, 0]
    assert [body.name for body in asset.bodies] == ["world", "a", "b", "c"]


def test_gazebo_obeys_the_unit_of_a_collada_file_in_collisions_and_visuals(tmp_path: Path) -> None:
    mesh = f"<mesh><uri>{PARTS / 'inches.dae'}</uri><scale>2 2 2</scale></mesh>"
    shown = f'<visual name="v"><geometry>{mesh}</geometry></visual>'
    asset = read(put_text(tmp_path, model(link(mesh, more=shown))))
    np.testing.assert_allclose(asset.geoms[0].shape.aabb.size, [0.0508] * 3)
    np.testing.assert_allclose(np.ptp(asset.visuals[0].vertices, axis=0), [0.0508] * 3)


def test_a_submesh_is_a_part_of_its_file_centred_where_that_is_asked(tmp_path: Path) -> None:
    mesh = f"<mesh><uri>{PARTS / 'two.obj'}</uri><submesh><name>right</name>{{}}</submesh></mesh>"
    assert middle(tmp_path, model(link(mesh.format("<center>true</center>")))) == [0, 0, 0]
    away = middle(tmp_path, model(link(mesh.format(""))))
    assert away[0] > 4


def test_the_folder_of_a_model_stands_for_its_newest_file() -> None:
    folder = ROOT / "sdf" / "part"
    assert [geom.name for geom in read_any(folder).geoms] == ["p/new"]
    old = read_any(folder / "model-1_4.sdf")
    assert [geom.name for geom in old.geoms] == ["p/old"]
    assert old.notes[0].startswith("model.config names model.sdf for newer versions")


def test_included_models_are_placed_and_named(tmp_path: Path) -> None:
    part = ROOT / "sdf"
    include = "<include><uri>model://part</uri>{}<pose>0 0 9 0 0 0</pose></include>"
    text = model(link(box()), include.format("<name>q</name>"), include.format(""))
    asset = read(put_text(tmp_path, text), part)
    assert [geom.name for geom in asset.geoms] == ["a/c0", "q::p/new", "part::p/new"]
    assert asset.geoms[1].shape.aabb.center[2] == asset.geoms[2].shape.aabb.center[2] > 8
    assert part / "part" / "model.sdf" in asset.files


def test_variables_of_gazebo_are_searched(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = put_text(tmp_path, model(link("<mesh><uri>model://part/meshes/cube.obj</uri></mesh>")))
    with pytest.raises(AssetError, match="GZ_SIM_RESOURCE_PATH"):
        read_any(path)
    monkeypatch.setenv("GZ_SIM_RESOURCE_PATH", str(ROOT / "sdf"))
    assert len(read_any(path).geoms) == 1
