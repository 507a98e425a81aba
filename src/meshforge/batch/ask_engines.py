"""Engines that are installed here asked themselves: what MuJoCo, or PyBullet, says of a file, and the shapes that they
make of it, compared with the hulls that were read."""

import json
import re
import subprocess
import sys
from collections.abc import Callable, Collection, Iterable
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from types import MappingProxyType

import numpy as np

from meshforge.checks import EngineLoad
from meshforge.checks.base import Given
from meshforge.common import MeshForgeError, join_names, quote_path
from meshforge.engines import EngineShape, Finding, ShapeComparison
from meshforge.formats import ONE_FILE_A_HULL, MujocoLoad, format_for, format_of, save, try_in_mujoco, turn_upright
from meshforge.geometry import Box, Capsule, Cylinder, Pose, Shape, Sphere, rotation_of_quaternion
from meshforge.symbolic import Asset, SymbolicMesh

_OWN_FORMATS = {"mujoco": ("mjcf", "urdf"), "bullet": ("urdf", "sdf", "obj", "stl")}
"""The formats that an engine reads itself."""
_PROGRAMS = {"mujoco": "mujoco", "bullet": "pybullet"}
_BULLET_SECONDS = 60.0
_LOAD_IN_BULLET = Path(__file__).with_name("load_in_bullet.py")
_BULLET_HEAD = re.compile(r"b3(?:Warning|Error|Printf)\[[^\]]*\]:\n")


def name_of(path: Path | None) -> str:
    """Return what messages call a file, None for a mesh that no file is of."""
    return path.name if path else "this mesh"


def try_mujoco(engine: str, path: Path | None, mesh: SymbolicMesh) -> EngineLoad:
    """Return what MuJoCo says: of an MJCF or a URDF as it is, of others as `meshforge convert` writes it as MJCF."""
    form = format_of(path).name if path else ""
    own = path is not None and form in _OWN_FORMATS["mujoco"]
    try:
        found = try_in_mujoco(path) if path and own else _try_converted(mesh)
    except ImportError:
        return _describe_absence(engine, path)
    except MeshForgeError as error:
        return EngineLoad(engine, name_of(path), untried=f"it cannot be made an MJCF: {error.message}")
    remedy = ""
    if found.refusal and path and own and form != "mjcf" and _is_taken_converted(mesh):
        command = f"meshforge convert {quote_path(path)} {quote_path(path.with_suffix('.xml'))}"
        remedy = f"Fix what the message names; or give MuJoCo an MJCF, which it takes: {command}"
    given: Given = "file" if own else "conversion"
    asked = f"MuJoCo {found.version}"
    differing: tuple[Finding, ...] = ()
    if mesh.asset is not None and path is not None and not found.refusal:
        read = mesh.to_asset()
        read = read if own else turn_upright(read, format_of(path), format_for(Path("asset.xml"), ""))[0]
        differing = _compare(engine, asked, path, read, found.shapes)
    return EngineLoad(engine, name_of(path), asked, given, found.refusal, found.warnings, differing, remedy=remedy)


def _compare(
    engine: str, asked: str, path: Path | None, read: Asset, shapes: Iterable[EngineShape]
) -> tuple[Finding, ...]:
    name = quote_path(path) if path else "FILE"
    remedy = f"Write each hull by itself, as an MJCF has them: meshforge convert {name} OUT.xml"
    if read.format in ONE_FILE_A_HULL:
        remedy = f"Give each hull a file of its own: meshforge convert {name} OUT --one-file-a-hull"
    elif engine == "bullet":
        remedy = "Write each hull by itself, as a URDF has them: meshforge convert FILE OUT.urdf"
    return tuple(ShapeComparison(engine, asked, read, tuple(shapes), remedy).findings)


def _describe_absence(engine: str, path: Path | None) -> EngineLoad:
    program = _PROGRAMS[engine]
    return EngineLoad(
        engine, name_of(path), untried=f"{program} is not installed", remedy=f"Install it: pip install {program}"
    )


def _try_converted(mesh: SymbolicMesh) -> MujocoLoad:
    with TemporaryDirectory(prefix="meshforge-") as folder:
        return try_in_mujoco(save(mesh, Path(folder) / "asset.xml").path)


def _is_taken_converted(mesh: SymbolicMesh) -> bool:
    try:
        return _try_converted(mesh).refusal is None
    except MeshForgeError:
        return False


def try_bullet(engine: str, path: Path | None, mesh: SymbolicMesh) -> EngineLoad:
    """Return what PyBullet says of a URDF, SDF, OBJ or STL, in its own process, as it may crash; nothing of others."""
    if path is None or format_of(path).name not in _OWN_FORMATS["bullet"]:
        return EngineLoad(engine, name_of(path))
    if find_spec("pybullet") is None:
        return _describe_absence(engine, path)
    with TemporaryDirectory(prefix="meshforge-") as folder:
        out = Path(folder) / "shapes.json"
        command = [sys.executable, "-P", str(_LOAD_IN_BULLET), str(path.absolute()), str(out)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=_BULLET_SECONDS)
        except subprocess.TimeoutExpired:
            return EngineLoad(engine, path.name, untried=f"it took longer than {_BULLET_SECONDS:g} s")
        refusal = (_read_bullet_words(done.stdout) or "it crashed") if done.returncode else None
        if refusal and path.suffix == ".sdf":  # whose parser there takes little of SDF
            return EngineLoad(engine, path.name, untried=f"PyBullet's reader of SDF does not take it: {refusal}")
        rows = [] if refusal else json.loads(out.read_text("utf-8"))
    asked = f"PyBullet {version('pybullet')}"
    differing: tuple[Finding, ...] = ()
    if links := {row[1] for row in rows if row[0] == "unknown"}:
        differing = (_describe_collada(asked, path, mesh, links),)
    elif mesh.asset is not None and not refusal:
        shapes = [_read_bullet_shape(*row) for row in rows]
        differing = _compare(engine, asked, path, mesh.to_asset(), shapes)
    return EngineLoad(engine, path.name, asked, "file", refusal, (), differing)


def _describe_collada(asked: str, path: Path, mesh: SymbolicMesh, links: Collection[str]) -> Finding:
    """What is said of Collada files in links, by rule: Bullet's importer (BulletUrdfImporter.cpp) puts all vertices of
    such a file into one hull."""
    names = [hull.name for hull in mesh.hulls if hull.body in links and "#" in hull.name]
    if len(names) > len({name.rpartition("#")[0] for name in names}):
        message = f"{asked} makes one hull of a Collada file, which closes what is between: {join_names(names, 5)}"
        remedy = f"Give each hull a file of its own: meshforge convert {quote_path(path)} OUT --one-file-a-hull"
        return Finding("bullet-joins", "error", tuple(names), message, remedy)
    message = f"{asked} does not say what it makes of Collada files: the shapes are not compared"
    return Finding("bullet-unread", "warning", (), message, "Write the collision meshes as OBJ or STL.")


def _read_bullet_shape(
    kind: str,
    size: list[float],
    position: list[float],
    quaternion: list[float],
    points: list[list[float]],
    margin: float,
) -> EngineShape:
    """A row of `load_in_bullet`; its quaternions have the real part last."""
    pose = Pose(rotation_of_quaternion(np.roll(quaternion, 1)), position)
    if kind == "mesh":
        return EngineShape.of(pose.apply(np.array(points).reshape(-1, 3)), margin)
    shape: Shape
    match kind:
        case "box":
            shape = Box(pose, np.array(size) / 2)
        case "sphere":
            shape = Sphere(pose, size[0])
        case "capsule":
            shape = Capsule(pose, size[1], size[0] / 2)
        case _:
            shape = Cylinder(pose, size[1], size[0] / 2)
    return EngineShape.of(shape)


def _read_bullet_words(printed: str) -> str:
    """What Bullet printed, without where in its code; it prints a name as a message of its own."""
    words = iter(" ".join(word.split()) for word in _BULLET_HEAD.split(printed))
    line = ""
    for word in words:
        if word.startswith("No inertial data for link"):
            next(words, None)
        elif word:
            line += f" {word}" if line.endswith(":") else f"; {word}" if line else word
    return line


ENGINES_TO_ASK: MappingProxyType[str, Callable[[str, Path | None, SymbolicMesh], EngineLoad]] = MappingProxyType(
    {"mujoco": try_mujoco, "bullet": try_bullet}
)
"""How an engine itself is asked, by its name; of the others only the tables of limits are known."""
