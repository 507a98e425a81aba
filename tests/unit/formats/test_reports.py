"""What conversions say: golden texts beside the tests, and what a report is made of."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from meshforge.common import pluralize
from meshforge.formats import Format, Loss, Output, list_formats, read, save
from meshforge.formats.conversion import report_conversion
from meshforge.formats.visuals import Visual, VisualSurfaces
from meshforge.symbolic import Asset, FeatureKind
from tests.conversion_samples import SAMPLES, doors
from tests.gltf_files import SceneFile
from tests.soups import box
from tests.urdf_sample import THREE

GOLDEN = Path(__file__).parents[2] / "golden" / "reports"
SUFFIXES = (".obj", ".stl", ".ply", "", ".urdf", ".xml", ".sdf", ".glb", ".usda")

BUSY_URDF = """\
<robot name="busy">
  <!-- a comment --><!-- and another -->
  <material name="wood"><texture filename="wood.png"/></material>
  <link name="base">
    <contact><lateral_friction value="1"/></contact>
    <visual><geometry><mesh filename="shown.obj"/></geometry><material name="wood"/></visual>
    <collision><geometry><box size="1 1 1"/></geometry></collision>
  </link>
  <link name="a"><collision name="pin"><geometry><capsule radius="0.1" length="1"/></geometry></collision></link>
  <link name="b"/>
  <joint name="left" type="revolute">
    <parent link="base"/><child link="a"/><limit lower="0" upper="1" effort="1" velocity="2"/>
  </joint>
  <joint name="right" type="revolute">
    <parent link="base"/><child link="b"/><mimic joint="left"/><safety_controller k_velocity="1"/>
  </joint>
  <gazebo reference="a"/><gazebo reference="b"/><transmission name="t"/>
</robot>
"""
BUSY_SDF = """\
<sdf version="1.7">
  <!-- a comment -->
  <model name="busy">
    <static>true</static>
    <link name="base">
      <collision name="box">
        <geometry><box><size>1 1 1</size></box></geometry>
        <surface><friction><ode><mu>1</mu></ode></friction></surface>
      </collision>
      <collision name="hill"><geometry><heightmap><uri>hill.png</uri></heightmap></geometry></collision>
      <visual name="v">
        <geometry><mesh><uri>shown.obj</uri></mesh></geometry>
        <material>
          <script><name>Gazebo/Wood</name></script>
          <pbr><metal><albedo_map>wood.png</albedo_map></metal></pbr>
        </material>
      </visual>
      <sensor name="eye" type="camera"/>
      <light name="lamp" type="point"/>
    </link>
    <link name="lid"/>
    <frame name="grip" attached_to="lid"/>
    <joint name="hinge" type="revolute">
      <parent>base</parent><child>lid</child>
      <axis>
        <xyz>1 0 0</xyz>
        <limit><velocity>2</velocity></limit>
        <dynamics><spring_stiffness>3</spring_stiffness></dynamics>
      </axis>
    </joint>
    <plugin name="p" filename="p.so"/>
  </model>
</sdf>
"""
BUSY_MJCF = """\
<mujoco>
  <option timestep="0.001"/>
  <!-- a comment -->
  <asset>
    <material name="steel" rgba="1 1 1 1"/><texture name="sky" type="skybox" builtin="flat" width="8" height="8"/>
  </asset>
  <worldbody>
    <light name="sun" pos="0 0 5"/><camera name="eye" pos="0 0 5"/>
    <geom name="floor" type="plane" size="1 1 1"/>
    <body name="arm"><joint name="elbow" stiffness="2" range="0 90"/>
      <geom name="bone" size=".1" friction="2 1 1"/><site name="tip"/>
      <body name="hand"><joint name="wrist" type="ball"/><geom type="ellipsoid" size=".1 .2 .3"/></body></body>
    <body name="cup" pos="2 0 0"><freejoint name="loose"/><geom type="capsule" size=".1 .1"/></body>
  </worldbody>
  <contact><exclude body1="arm" body2="cup"/></contact>
  <tendon><fixed name="string"><joint joint="elbow" coef="1"/></fixed></tendon>
  <equality><joint name="locked" joint1="elbow"/></equality>
  <actuator><motor name="motor" joint="elbow"/></actuator>
  <sensor><jointpos name="angle" joint="elbow"/></sensor>
  <keyframe><key name="home"/></keyframe>
</mujoco>
"""
BUSY_OBJ = "# made by hand\nmtllib x.mtl\nusemtl oak\n" + THREE.replace("f ", "vt 0 0\nf ", 1)
BUSY_PLY = """\
ply
format ascii 1.0
comment by hand
element vertex 4
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 4
property list uchar int vertex_indices
end_header
0 0 0 1 2 3
1 0 0 1 2 3
0 1 0 1 2 3
0 0 1 1 2 3
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
"""


def busy(name: str, text: str) -> Callable[[Path], Asset]:
    """Reads an asset out of a text, in a folder."""

    def reading(folder: Path) -> Asset:
        (folder / "shown.obj").write_text("mtllib shown.mtl\n" + THREE)
        (folder / "shown.mtl").write_text("newmtl oak\n")
        (folder / "wood.png").write_bytes(b"")
        (folder / name).write_text(text)
        return read(folder / name)

    return reading


SOURCES: dict[str, Callable[[Path], Asset]] = {
    **{name: (lambda folder, make=make: make()) for name, make in SAMPLES.items()},  # type: ignore[misc]
    "busy_urdf": busy("busy.urdf", BUSY_URDF),
    "busy_mjcf": busy("busy.xml", BUSY_MJCF),
    "busy_sdf": busy("busy.sdf", BUSY_SDF),
    "busy_obj": busy("busy.obj", BUSY_OBJ),
    "busy_ply": busy("busy.ply", BUSY_PLY),
    "doors_of_a_glb": lambda folder: read(save(SAMPLES["doors"](), folder / "doors.glb").path),
}


def said(source: str, folder: Path) -> str:
    """What converting an asset to every format says, with what it holds."""
    asset = SOURCES[source](folder)
    parts = []
    for suffix in SUFFIXES:
        saved = save(asset, folder / "out" / suffix.removeprefix(".") / f"thing{suffix}")
        held = ", ".join(pluralize(f.count, f.kind.one, f.kind.many) for f in saved.report.kept)
        parts.append("\n".join([f"== to {suffix or 'a folder'}, which holds: {held or 'hulls'}", *saved.notes]))
    return "\n\n".join(parts) + "\n"


@pytest.mark.parametrize("source", SOURCES)
def test_reports_are_as_they_were(source: str, tmp_path: Path) -> None:
    assert said(source, tmp_path) == (GOLDEN / f"{source}.txt").read_text()


@pytest.mark.parametrize("known", list_formats(), ids=lambda known: known.name)
def test_every_format_says_what_it_is_called_and_what_it_holds(known: Format) -> None:
    assert known.title
    assert not known.holds & set(known.instead)


def test_things_that_a_creator_left_out_do_not_count_as_held() -> None:
    asset, urdf = SAMPLES["opaque"](), next(known for known in list_formats() if known.name == "urdf")
    lost = tuple(Loss(FeatureKind.NON_CONVEX, (name,), "flat") for name in ("room/walls", "room/other"))
    told = report_conversion(asset, None, urdf, Output(b"", lost=lost))
    assert FeatureKind.NON_CONVEX not in {feature.kind for feature in told.kept}
    assert [str(loss) for loss in told.lost if loss.kind is FeatureKind.NON_CONVEX] == [
        "2 opaque pieces (room/walls, room/other) are left out: flat"
    ]


@pytest.mark.parametrize("suffix", [".urdf", ".xml", ".sdf", ".glb"])
def test_a_visual_that_cannot_be_read_is_told(suffix: str, tmp_path: Path) -> None:
    bad = tmp_path / "bad.wrl"
    bad.write_text("nothing of the kind")
    asset = replace(doors(), visuals=VisualSurfaces((Visual("door", bad, np.eye(3), np.zeros(3)),)))
    notes = save(asset, tmp_path / "out" / f"m{suffix}").notes
    assert "1 visual (door) is left out: their files cannot be read" in notes


def test_what_the_vertices_of_a_gltf_have_besides_their_places_is_told(tmp_path: Path) -> None:
    scene = SceneFile()
    part = scene.primitive(box())
    part["attributes"] |= {"COLOR_0": scene.accessor(np.ones((8, 4), "<f4"))}
    part["attributes"] |= {"TEXCOORD_0": scene.accessor(np.ones((8, 2), "<f4"))}
    scene.node("box", mesh=scene.mesh(part))
    saved = save(read(scene.write(tmp_path / "a.glb")), tmp_path / "a.stl")
    assert [loss.names for loss in saved.report.lost if loss.kind is FeatureKind.OTHERS] == [("COLOR_0", "TEXCOORD_0")]


def test_within_a_format_nothing_is_lost(tmp_path: Path) -> None:
    saved = save(SOURCES["busy_urdf"](tmp_path), tmp_path / "out" / "m.urdf")
    assert (saved.notes, saved.report.lost, saved.report.kept) == ((), (), ())
