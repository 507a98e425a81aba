"""A URDF with a bit of everything, its mesh files, and what tests do with URDFs again and again."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from meshforge.formats.base import Output, ReadOptions
from meshforge.formats.urdf.format import UrdfFormat
from meshforge.geometry import Aabb, Box, Floats, Pose, Shape, Sphere
from meshforge.symbolic import Asset, Geom
from tests.mesh_files import obj
from tests.soups import angle, merge_solids

Corner = tuple[float, float, float]

SAMPLE = """\
<?xml version="1.0"?>
<!-- a cart -- by hand -->
<robot name="cart" xmlns:drake="http://drake.mit.edu">
  <material name='grey'><color rgba="0.5 0.5 0.5 1"/></material>
  <link name="base">
    <contact>
      <lateral_friction value="0.7"/>
      <rolling_friction value="0.01"/>
    </contact>
    <inertial>
      <origin xyz="0 0 0.1"/>
      <mass value="2.5"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.3"/>
    </inertial>
    <visual>
      <geometry><mesh filename="meshes/three.obj"/></geometry>
    </visual>
    <!-- the plate -->
    <collision>
      <origin xyz="0 0 .1" rpy="0 0 0.5"/>
      <geometry>
        <box   size='1 0.6 0.1'/>
      </geometry>
    </collision>
    <collision name = "posts" drake:acceptable="yes">
      <!-- three posts -->
      <origin xyz="0.1 0 0.2" rpy="0 0.25 0"/>
      <geometry>
        <mesh filename='meshes/three.obj' scale="0.1 0.1 -0.2"/>
      </geometry>
      <material name="grey"/>
    </collision>
    <collision>
      <geometry><sphere radius="0.05"/></geometry>
    </collision>
  </link>
  <link name="wheel">
    <inertial>
      <mass value="0.5"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
    </inertial>
    <collision name="tyre"><geometry><cylinder radius="0.2" length="0.05"/></geometry></collision>
  </link>
  <joint name="axle" type="continuous">
    <parent link="base"/><child link="wheel"/>
    <origin xyz="0.4 0.3 0" rpy="1.57 0 0"/>
    <axis xyz="0 0 1"/>
  </joint>
  <gazebo reference="wheel"><mu1>0.9</mu1></gazebo>
</robot>
"""
HULLS = ["base/geom0", "base/posts#0", "base/posts#1", "base/posts#2", "base/geom2", "wheel/tyre"]


def boxes_obj(*corners: tuple[Corner, Corner]) -> str:
    """An OBJ of boxes from corner to corner, without groups."""
    return obj(merge_solids(Box.of_bounds(Aabb(low, high)).tessellate() for low, high in corners)).decode()


def corner_obj() -> str:
    """An OBJ of one L-shaped prism: connected, closed, not convex."""
    return obj(angle()).decode()


THREE = boxes_obj(((0, 0, 0), (1, 1, 1)), ((3, 0, 0), (4, 1, 2)), ((0, 3, 0), (1, 4, 1.5)))


def sample(folder: Path, text: str = SAMPLE) -> Path:
    """The sample, or another text, as a file in a folder with its mesh."""
    (folder / "meshes").mkdir(parents=True, exist_ok=True)
    (folder / "meshes" / "three.obj").write_text(THREE)
    path = folder / "cart.urdf"
    path.write_bytes(text.encode())
    return path


def read(path: Path, *roots: Path) -> Asset:
    return UrdfFormat().read(path, ReadOptions(roots))


def write(asset: Asset, name: str = "cart.urdf") -> Output:
    return UrdfFormat().write(asset, name)


def put(output: Output, path: Path) -> Path:
    """The output on disk, main file at `path`."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(output.main)
    contents: dict[str, bytes | Path] = {**output.copies, **output.made}
    for name, content in contents.items():
        target = Path(os.path.normpath(path.parent / name))
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(content if isinstance(content, bytes) else content.read_bytes())
    return path


def assert_reads_back(edit: Asset, again: Asset) -> None:
    """The pieces of an edited asset have their names, places and sizes after it was written and read."""
    assert [g.name for g in again.geoms] == [g.name for g in edit.geoms]
    assert [o.name for o in again.non_convex] == [o.name for o in edit.non_convex]
    for old, new in zip(edit.geoms, again.geoms, strict=True):
        assert abs(old.shape.aabb.min - new.shape.aabb.min).max() < 1e-9
        assert abs(old.shape.volume - new.shape.volume) <= 1e-9 * old.shape.volume


def without(asset: Asset, *names: str) -> Asset:
    """The asset without some hulls, which must be there."""
    assert set(names) <= {g.name for g in asset.geoms}
    return asset.with_geoms(g for g in asset.geoms if g.name not in names)


def made(asset: Asset, parent: str, shape: Shape, number: int = 1) -> Geom:
    """A made hull that inherits from a hull of the asset."""
    body = next(g.body for g in asset.geoms if g.name == parent)
    return Geom(f"{parent}~{number}", body, shape, parent)


def exchange_hulls(asset: Asset, *kinds: Callable[[Pose, Floats], Shape]) -> Asset:
    """The asset without its first hull and every third after it; turned shapes of the kinds in place of the first."""
    gone = asset.geoms[::3]
    kept = without(asset, *(geom.name for geom in gone))
    turned, new = Pose.from_rpy([0, 0, 0], [0.3, -0.5, 1.1]).rotation, []
    for k, geom in enumerate(gone[: 2 * len(kinds)]):
        shape = kinds[k % len(kinds)](Pose(turned, geom.shape.aabb.center), geom.shape.aabb.size / 2)
        new.append(made(asset, geom.name, shape))
    return kept.with_geoms([*kept.geoms, *new])


def ball_within(pose: Pose, half: Floats) -> Sphere:
    return Sphere(pose, float(half.min()))


def robot(*inside: str) -> str:
    """A URDF text with a `<robot>` around some elements."""
    return '<robot name="r">\n' + "\n".join(inside) + "\n</robot>\n"


def link(*geometries: str, name: str = "a") -> str:
    """A link with a collision element a geometry."""
    elements = "".join(f"<collision><geometry>{g}</geometry></collision>\n" for g in geometries)
    return f'<link name="{name}">\n{elements}</link>'
