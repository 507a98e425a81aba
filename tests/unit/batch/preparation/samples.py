"""Assets with something to prepare: a URDF with an opaque corner, a bare link and hulls, and quick settings."""

from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from meshforge.batch import Preparation, decompose_asset
from meshforge.formats import read
from meshforge.geometry.decomposition.engines import CoacdSettings, VhacdSettings
from meshforge.symbolic import Asset
from tests.urdf_sample import boxes_obj, corner_obj

QUICK = CoacdSettings(resolution=200, mcts_iterations=20, mcts_nodes=8)
VOXELS = VhacdSettings(resolution=5000, max_convex_hulls=4)
PIECES = {"frame/body": "opaque", "cover": "body"}
"""What can be decomposed, and what kind it is of."""

URDF = """\
<?xml version="1.0"?>
<!-- a stand -->
<robot name="stand">
  <link name="frame">
    <visual><geometry><mesh filename="corner.obj"/></geometry></visual>
    <collision name="body">
      <geometry><mesh filename="corner.obj"/></geometry><friction mu="0.3"/>
    </collision>
    <collision name="foot"><origin xyz="0 0 -1"/><geometry><box size="4 1 1"/></geometry></collision>
  </link>
  <link name="cover">
    <visual><geometry><mesh filename="corner.obj" scale="1 1 0.5"/></geometry></visual>
  </link>
  <link name="marker"/>
  <joint name="hinge" type="revolute">
    <parent link="frame"/><child link="cover"/><origin xyz="0 0 2"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="mark" type="fixed"><parent link="frame"/><child link="marker"/></joint>
</robot>
"""


def write_stand(folder: Path, name: str = "stand.urdf") -> Path:
    """The URDF with its mesh: an L-shaped prism of volume 5, 3 by 3 by 1."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "corner.obj").write_text(corner_obj())
    path = folder / name
    path.write_text(URDF)
    return path


def write_boxes(path: Path) -> Path:
    """An OBJ of three boxes in a row, without groups."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(boxes_obj(((0, 0, 0), (1, 1, 1)), ((1, 0, 0), (3, 1, 1)), ((5, 0, 0), (6, 1, 1))))
    return path


def stand(folder: Path) -> tuple[Asset, Preparation]:
    """The stand as it is read, and its preparation."""
    return read(write_stand(folder)), _of_stand()


@cache
def _of_stand() -> Preparation:
    with TemporaryDirectory() as folder:
        return decompose_asset(read(write_stand(Path(folder))), Preparation(), QUICK).preparation
