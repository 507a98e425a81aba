"""An SDF with a bit of everything, its mesh files, and what tests do with SDFs again and again."""

from __future__ import annotations

from pathlib import Path

from meshforge.formats.base import Mass, Output, ReadOptions
from meshforge.formats.sdf.format import SdfFormat
from meshforge.symbolic import Asset
from tests.urdf_sample import THREE

SAMPLE = """\
<?xml version="1.0"?>
<!-- a cart -- by hand -->
<sdf version='1.7'>
  <model name="cart">
    <pose>0 0 0.5 0 0 0</pose>
    <link name="base">
      <inertial>
        <pose>0 0 0.1 0 0 0</pose>
        <mass>2.5</mass>
        <inertia><ixx>0.1</ixx><iyy>0.2</iyy><izz>0.3</izz></inertia>
      </inertial>
      <visual name="shown">
        <geometry><mesh><uri>model://cart/meshes/three.obj</uri></mesh></geometry>
        <material><diffuse>1 0.25 0 1</diffuse></material>
      </visual>
      <!-- the plate -->
      <collision name='plate'>
        <pose>0 0 .1 0 0 0.5</pose>
        <geometry>
          <box>
            <size>1   0.6 0.1</size> <!-- long -->
          </box>
        </geometry>
        <surface><friction><ode><mu>0.7</mu></ode></friction></surface>
      </collision>
      <collision name="posts">
        <!-- three posts -->
        <pose>0.1 0 0.2 0 0.25 0</pose>
        <geometry>
          <mesh>
            <uri>model://cart/meshes/three.obj</uri>
            <scale>0.1 0.1 -0.2</scale>
          </mesh>
        </geometry>
        <max_contacts>4</max_contacts>
      </collision>
    </link>
    <frame name="hub" attached_to="base">
      <pose>0.4 0.3 0 1.57 0 0</pose>
    </frame>
    <link name="wheel">
      <pose relative_to="hub"/>
      <inertial><mass>0.5</mass></inertial>
      <collision name="tyre">
        <geometry><cylinder><radius>0.2</radius><length>0.05</length></cylinder></geometry>
      </collision>
    </link>
    <joint name="axle" type="revolute">
      <parent>base</parent><child>wheel</child>
      <axis><xyz>0 0 1</xyz></axis>
    </joint>
    <plugin name="drive" filename="libdrive.so"><left_joint>axle</left_joint></plugin>
  </model>
</sdf>
"""
HULLS = ["base/plate", "base/posts#0", "base/posts#1", "base/posts#2", "wheel/tyre"]


def sample(folder: Path, text: str = SAMPLE) -> Path:
    """The sample, or another text, as the model of a Gazebo folder `cart` with its mesh."""
    (folder / "cart" / "meshes").mkdir(parents=True, exist_ok=True)
    (folder / "cart" / "meshes" / "three.obj").write_text(THREE)
    (folder / "cart" / "model.config").write_text(
        '<model><name>Cart</name><sdf version="1.7">model.sdf</sdf></model>\n'
    )
    path = folder / "cart" / "model.sdf"
    path.write_bytes(text.encode())
    return path


def put_text(folder: Path, text: str, name: str = "model.sdf") -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(text)
    return folder / name


def read(path: Path, *roots: Path) -> Asset:
    return SdfFormat().read(path, ReadOptions(roots))


def write(asset: Asset, name: str = "model.sdf", mass: Mass = "keep") -> Output:
    return SdfFormat().write(asset, name, mass)


def model(*inside: str, version: str = "1.9", attributes: str = "") -> str:
    """An SDF text with a `<model>` around some elements."""
    body = "\n".join(inside)
    return f'<sdf version="{version}">\n<model name="m"{attributes}>\n{body}\n</model>\n</sdf>\n'


def link(*geometries: str, name: str = "a", more: str = "") -> str:
    """A link with a collision a geometry, named after its number."""
    elements = (
        f'<collision name="c{k}"><geometry>{geometry}</geometry></collision>\n' for k, geometry in enumerate(geometries)
    )
    return f'<link name="{name}">\n{more}{"".join(elements)}</link>'


def box(x: float = 1, y: float = 1, z: float = 1) -> str:
    return f"<box><size>{x} {y} {z}</size></box>"
