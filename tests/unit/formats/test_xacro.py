"""Xacro files: read as the URDF that they expand to, written as plain URDF."""

import sys
from pathlib import Path

import pytest

import meshforge as mf
from meshforge.formats import is_asset
from tests.unit.cli.in_process import Run

ROBOT = """<?xml version="1.0"?>
<robot name="stool" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="leg.xacro"/>
  <xacro:property name="width" value="0.4"/>
  <link name="base">
    <collision name="seat"><geometry><box size="${width} ${width} 0.05"/></geometry></collision>
    <xacro:leg name="left" x="${-width / 2}"/>
    <xacro:leg name="right" x="${width / 2}"/>
  </link>
</robot>
"""
LEG = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="leg" params="name x">
    <collision name="${name}">
      <origin xyz="${x} 0 -0.2"/><geometry><box size="0.04 0.04 0.4"/></geometry>
    </collision>
  </xacro:macro>
</robot>
"""


@pytest.fixture
def stool(tmp_path: Path) -> Path:
    pytest.importorskip("xacro")
    (tmp_path / "in").mkdir()
    (tmp_path / "in/leg.xacro").write_text(LEG)
    (tmp_path / "in/stool.urdf.xacro").write_text(ROBOT)
    return tmp_path / "in/stool.urdf.xacro"


def test_a_xacro_file_is_read_as_what_it_expands_to(stool: Path) -> None:
    mesh = mf.load(stool)
    assert list(mesh.index) == ["base/seat", "base/left", "base/right"]
    assert mesh["base/right"].aabb.max[0] == pytest.approx(0.22)
    assert mesh.asset and mesh.asset.files == (stool.with_name("leg.xacro"),)
    assert "plain URDF, stool.urdf, without its macros" in mesh.asset.notes[0]


def test_an_edit_is_written_as_plain_urdf_and_never_as_xacro(stool: Path, tmp_path: Path) -> None:
    mesh = mf.load(stool)
    edited = mesh.with_hulls(mesh.hulls[:2])
    mf.save(edited, tmp_path / "out/stool.urdf")
    assert list(mf.load(tmp_path / "out/stool.urdf").index) == ["base/seat", "base/left"]
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["stool.urdf"]
    with pytest.raises(mf.MeshForgeError, match=r"xacro files are read, not written\n.*ends in \.urdf"):
        mf.save(edited, tmp_path / "out/stool.urdf.xacro")
    assert stool.read_text() == ROBOT


def test_macros_for_others_are_no_assets(stool: Path) -> None:
    assert is_asset(stool) and not is_asset(stool.with_name("leg.xacro"))


def test_find_looks_where_package_addresses_do(stool: Path) -> None:
    package = stool.parent.parent / "stools"
    (package / "urdf").mkdir(parents=True)
    (package / "urdf/leg.xacro").write_text(LEG)
    stool.write_text(ROBOT.replace('"leg.xacro"', '"$(find stools)/urdf/leg.xacro"'))
    assert len(mf.load(stool).hulls) == 3


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("${width / 2}", "${wdith / 2}", "wdith"),
        ("${width / 2}", "$(arg x)", "NAME:=VALUE"),
        ('"leg.xacro"', '"absent.xacro"', "absent"),
        ("</robot>", "", "stool.urdf.xacro:"),
        ("${width / 2}", "${1 / 0}", "division by zero"),
    ],
)
def test_a_fault_is_one_message_with_the_file(stool: Path, old: str, new: str, message: str) -> None:
    stool.write_text(ROBOT.replace(old, new))
    with pytest.raises(mf.MeshForgeError) as caught:
        mf.load(stool)
    assert str(stool) in str(caught.value) and message in str(caught.value)


def test_without_the_package_the_extra_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "xacro", None)
    (tmp_path / "stool.xacro").write_text(ROBOT)
    with pytest.raises(mf.MeshForgeError, match=r"pip install 'meshforge\[xacro\]'"):
        mf.load(tmp_path / "stool.xacro")


def test_the_command_line_takes_xacro_and_writes_urdf(run: Run, stool: Path, tmp_path: Path) -> None:
    program, out = str(tmp_path / "p.mf"), str(tmp_path / "out")
    assert "base/seat" in run("info", str(stool)).out
    (tmp_path / "p.mf").write_text("All => Delete\n")
    done = run("apply", program, str(stool), "--out", out, "--workers", "1")
    assert done.code == 0, done
    assert (tmp_path / "out/stool.urdf").is_file() and not (tmp_path / "out/stool.urdf.xacro").exists()
    assert "unchanged" not in done.out
    again = run("apply", program, str(stool), "--out", out, "--workers", "1")
    assert again.code == 0 and "1 skipped" in again.out
    stool.with_name("leg.xacro").write_text(LEG.replace("0.04", "0.05"))  # what is included counts, too
    assert "1 edited" in run("apply", program, str(stool), "--out", out, "--workers", "1").out
