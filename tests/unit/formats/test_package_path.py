from __future__ import annotations

from pathlib import Path

import pytest

from meshforge.common import AssetError
from meshforge.formats import read

URDF = """<robot name="r"><link name="l"><collision><geometry>
<mesh filename="package://parts/meshes/bar.obj"/></geometry></collision></link></robot>"""
THRESHOLD = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


def test_packages_are_found_in_the_folders_that_ros_package_path_lists(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    robot, bar = tmp_path / "here" / "robot.urdf", tmp_path / "there" / "parts" / "meshes" / "bar.obj"
    for path, text in ((robot, URDF), (bar, THRESHOLD)):
        path.parent.mkdir(parents=True)
        path.write_text(text)
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    with pytest.raises(AssetError, match="ROS_PACKAGE_PATH"):
        read(robot)
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{tmp_path / 'nowhere'}:{tmp_path / 'there'}")
    assert [geom.name for geom in read(robot).geoms] == ["l/geom0"]
