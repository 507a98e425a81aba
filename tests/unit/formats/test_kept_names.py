"""A geom that one hull alone takes the place of keeps its name in the file, in every format that has names."""

from pathlib import Path

import mujoco
import pytest

from meshforge.formats import load, save
from meshforge.language import Program
from tests.unit.batch.families import obj

RULE = Program.parse("labels handle\n\nIs(handle) => Each(Replace(sphere))")
URDF = """<robot name="r"><link name="door">
  <collision name="door_handle"><geometry><box size="0.1 0.1 0.1"/></geometry></collision>
  <collision name="board"><origin xyz="1 0 0"/><geometry><box size="0.2 0.3 0.4"/></geometry></collision>
</link></robot>
"""
SDF = """<sdf version="1.9"><model name="m"><link name="door">
  <collision name="door_handle"><geometry><box><size>0.1 0.1 0.1</size></box></geometry></collision>
  <collision name="board"><pose>1 0 0 0 0 0</pose><geometry><box><size>0.2 0.3 0.4</size></box></geometry></collision>
</link></model></sdf>
"""
MJCF = """<mujoco><worldbody><body name="door">
  <geom name="door_handle" type="box" size="0.05 0.05 0.05" mass="1"/>
  <geom name="board" type="box" size="0.1 0.15 0.2" pos="1 0 0" mass="1"/>
</body><geom name="floor" type="box" size="1 1 1" pos="0 0 -3"/></worldbody>
<contact><pair geom1="door_handle" geom2="floor"/></contact>
<sensor><distance geom1="floor" geom2="door_handle" cutoff="9"/></sensor></mujoco>
"""
OBJ = obj({"door_handle": ((0, 0, 0), (1, 1, 1)), "board": ((5, 0, 0), (6, 1, 1))})
TEXTS = {"door.urdf": URDF, "door.sdf": SDF, "door.xml": MJCF, "door.obj": OBJ}


def edit(folder: Path, name: str, handles: tuple[str, ...], program: Program = RULE) -> tuple[Path, list[str]]:
    """The edited file, and the names of its hulls; handles: the names of the hulls that are labelled so."""
    path = folder / name
    path.write_text(TEXTS[name])
    mesh = load(path)
    labelled = mesh.with_labels({hull.name: "handle" for hull in mesh.hulls if hull.name.split("/")[-1] in handles})
    out = folder / "out" / name
    save(program.run(labelled).mesh, out)
    return out, [hull.name for hull in load(out).hulls]


@pytest.mark.parametrize("name", TEXTS)
def test_what_replaces_one_geom_alone_has_its_name(tmp_path: Path, name: str) -> None:
    before = [hull.name for hull in load(_write(tmp_path, name)).hulls]
    out, after = edit(tmp_path, name, ("door_handle",))
    assert sorted(after) == sorted(before)
    assert "door_handle" in out.read_text() and "~1" not in out.read_text()


def _write(folder: Path, name: str) -> Path:
    path = folder / name
    path.write_text(TEXTS[name])
    return path


def test_what_refers_to_a_geom_that_keeps_its_name_refers_to_the_new_one(tmp_path: Path) -> None:
    out, _ = edit(tmp_path, "door.xml", ("door_handle",))
    model = mujoco.MjModel.from_xml_path(str(out))
    handle = model.geom("door_handle").id
    assert model.geom_type[handle] == mujoco.mjtGeom.mjGEOM_SPHERE
    assert handle in (model.pair_geom1[0], model.pair_geom2[0]) and handle in (
        model.sensor_objid[0],
        model.sensor_refid[0],
    )


@pytest.mark.parametrize("name", TEXTS)
def test_what_replaces_two_has_the_name_of_the_larger_with_a_number(tmp_path: Path, name: str) -> None:
    merge = Program.parse("labels handle\n\nIs(handle) => Replace(box)")
    if name == "door.xml":
        without = MJCF.split("<contact>")[0] + "</mujoco>"
        (tmp_path / "alone").mkdir()
        path = tmp_path / "alone" / name
        path.write_text(without)
        mesh = load(path)
    else:
        mesh = load(_write(tmp_path, name))
    inside = [hull.name for hull in mesh.hulls if hull.name.split("/")[-1] in ("door_handle", "board")]
    after = merge.run(mesh.with_labels(dict.fromkeys(inside, "handle"))).mesh
    save(after, tmp_path / "out" / name)
    names = {hull.name for hull in load(tmp_path / "out" / name).hulls}
    larger = next(hull.name for hull in sorted(mesh.hulls, key=lambda h: -h.volume) if hull.name in inside)
    assert f"{larger}~1" in names and not set(inside) & names
