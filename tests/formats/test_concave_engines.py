"""Concave collision meshes after a conversion: MuJoCo and PyBullet collide with as many shapes as before."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
import pytest

from meshforge.formats import convert, read, save
from tests.loop.command import Done
from tests.unit.cli.in_process import Run
from tests.urdf_engines import bullet
from tests.urdf_sample import corner_obj

MASS = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
MESH = '<geometry><mesh filename="corner.obj"/></geometry>'
TURN = '<origin xyz="0 1 0" rpy="0.3 0 1"/>'


def write_arm(folder: Path, *, shown: bool = True) -> Path:
    """Two moving links with one concave collision mesh each, 5/7 full, the second turned."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "corner.obj").write_text(corner_obj())
    seen = f"<visual>{MESH}</visual>" if shown else ""
    links = "".join(
        f'<link name="{name}">{MASS}{seen}<collision>{where}{MESH}</collision></link>'
        for name, where in (("base", ""), ("tip", TURN))
    )
    joint = '<joint name="j" type="revolute"><parent link="base"/><child link="tip"/><origin xyz="5 0 0"/>'
    end = '<axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
    path = folder / "arm.urdf"
    path.write_text(f'<robot name="arm">{links}{joint}{end}</robot>')
    return path


def colliding(path: Path) -> list[tuple[str, list[float], list[float]]]:
    """Body and bounds in the world of each geom that collides, as MuJoCo compiles a file, in order."""
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    found = []
    for k in np.flatnonzero((model.geom_contype != 0) | (model.geom_conaffinity != 0)).tolist():
        mesh = int(model.geom_dataid[k])
        start = model.mesh_vertadr[mesh]
        points = model.mesh_vert[start : start + model.mesh_vertnum[mesh]].astype(float)
        world = points @ data.geom_xmat[k].reshape(3, 3).T + data.geom_xpos[k]
        low, high = np.round(world.min(axis=0), 4).tolist(), np.round(world.max(axis=0), 4).tolist()
        found.append((model.body(int(model.geom_bodyid[k])).name, low, high))
    return found


def bounds(path: Path) -> list[tuple[list[float], list[float]]]:
    return [(low, high) for _, low, high in colliding(path)]


@pytest.mark.parametrize("shown", [True, False])
def test_mujoco_collides_with_the_same_geoms_before_and_after(tmp_path: Path, shown: bool) -> None:
    urdf = write_arm(tmp_path, shown=shown)
    saved = convert(urdf, tmp_path / "out" / "arm.xml")
    assert len(colliding(urdf)) == 2 and bounds(saved.path) == bounds(urdf)
    assert [body for body, _, _ in colliding(saved.path)] == ["base", "tip"]
    (said,) = (note for note in saved.notes if "MuJoCo will collide" in note)
    assert said.endswith("MuJoCo will collide with its hull (71% full)")


@pytest.mark.parametrize("between", [".sdf", ".usda", ".glb"])
def test_what_goes_through_another_format_collides_in_mujoco_all_the_same(tmp_path: Path, between: str) -> None:
    urdf = write_arm(tmp_path)
    there = convert(urdf, tmp_path / "a" / f"arm{between}").path
    back = convert(there, tmp_path / "b" / "arm.xml").path
    after = bounds(back)
    assert len(after) == 2
    np.testing.assert_allclose(np.sort(after, axis=0), np.sort(bounds(urdf), axis=0), atol=2e-4)


@pytest.mark.parametrize("between", [".sdf", ".xml", ".usda"])
def test_pybullet_has_as_many_shapes_before_and_after(tmp_path: Path, between: str) -> None:
    urdf = write_arm(tmp_path)
    asset = read(convert(urdf, tmp_path / "a" / f"arm{between}").path)
    back = save(asset, tmp_path / "b" / "arm.urdf").path
    before, after = bullet(urdf), bullet(back)
    count = [len(shapes) for shapes in before["shapes"] if shapes]
    assert count == [1, 1] and [len(shapes) for shapes in after["shapes"] if shapes] == count


@pytest.fixture
def run(run: Run, tmp_path: Path) -> Run:
    write_arm(tmp_path)
    return run


def hulls_of(run: Run, path: str) -> list[str]:
    return [hull["name"] for hull in run("info", path, "--json").json["hulls"]]


@pytest.mark.parametrize("many", [False, True])
def test_as_a_hull_it_can_be_selected_and_mujoco_has_the_same(run: Run, many: bool) -> None:
    words = ("arm.urdf", "out", "--to", "xml") if many else ("arm.urdf", "out/arm.xml")
    assert run("convert", *words, "--concave", "hull").code == 0
    assert hulls_of(run, "out/arm.xml") == ["base/geom0#0", "tip/geom0#0"]
    assert bounds(Path("out/arm.xml")) == bounds(Path("arm.urdf"))
    if many:  # another answer makes the output anew
        assert run("convert", *words).code == 0
        assert hulls_of(run, "out/arm.xml") == ["base/geom0", "tip/geom0"]
        assert "skipped" in run("convert", *words).out


@pytest.mark.slow
def test_decomposed_it_is_several_hulls(run: Run) -> None:
    assert run("convert", "arm.urdf", "out/arm.xml", "--concave", "decompose").code == 0
    assert len(colliding(Path("out/arm.xml"))) == len(hulls_of(run, "out/arm.xml")) >= 4
    assert run("convert", "arm.urdf", "back/arm.urdf", "--concave", "hull").code == 0
    assert hulls_of(run, "back/arm.urdf") == ["base/geom0#0", "tip/geom0"]  # geom0#0 is taken in the file


def test_labels_of_other_hulls_stay_where_a_mesh_becomes_a_hull(run: Run) -> None:
    text = Path("arm.urdf").read_text()
    box = '<collision name="b"><geometry><box size="1 1 1"/></geometry></collision></link>'
    Path("arm.urdf").write_text(text.replace("</link>", box, 1))
    Path("l.json").write_text('{"hulls": {"base/b": "foot"}}')
    assert run("convert", "arm.urdf", "out/arm.xml", "--concave", "hull", "--labels", "l.json").code == 0
    labels = {hull["name"]: hull["label"] for hull in run("info", "out/arm.xml", "--json").json["hulls"]}
    assert labels == {"base/b": "foot", "base/geom0#0": None, "tip/geom0#0": None}


def flat_sheet() -> str:
    """An OBJ of a flat sheet with a dent, which is no hull."""
    return "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.2 0\nf 1 2 4\nf 2 3 4\n"


def lost(told: Done) -> bool:
    return "would collide no more: MuJoCo refuses a mesh that is flat" in told.err + told.out


def test_where_a_format_cannot_hold_it_the_exit_code_is_one_and_a_hull_is_the_remedy(run: Run) -> None:
    Path("corner.obj").write_text(flat_sheet())
    told = run("convert", "arm.urdf", "out/arm.xml")
    assert told.code == 1 and lost(told) and "--concave hull" in told.err
    told = run("convert", "arm.urdf", "many", "--to", "xml")
    assert told.code == 1 and lost(told) and "--concave hull" in told.out and not Path("many/arm.xml").exists()
    assert run("convert", "arm.urdf", "out/hull.xml", "--concave", "hull").code == 0
    assert len(colliding(Path("out/hull.xml"))) == 2


def test_where_nothing_at_all_would_collide_the_exit_code_is_one_too(run: Run) -> None:
    told = run("convert", "arm.urdf", "out/arm.glb", "--names", "unreal")
    assert told.code == 1 and "there is no hull to write: base/geom0, tip/geom0 cannot collide" in told.err
    assert "--concave decompose, or hull" in told.err and not Path("out/arm.glb").exists()
    many = run("convert", "arm.urdf", "many", "--to", "glb", "--names", "unreal")
    assert many.code == 1 and "cannot collide there" in many.out


def test_where_nothing_is_there_to_collide_the_input_is_what_is_wrong(run: Run) -> None:
    Path("arm.urdf").write_text('<robot name="arm"><link name="base"/></robot>')
    told = run("convert", "arm.urdf", "out/arm.obj")
    assert told.code == 2 and told.err.endswith("there is no hull to write\n")
