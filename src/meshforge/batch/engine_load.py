"""Engines that are installed here are asked themselves: what MuJoCo, or PyBullet, says of a file."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from types import MappingProxyType

from meshforge.checks import CheckOptions, EngineLoad, Examination, examine_mesh
from meshforge.checks.engine_load import Given
from meshforge.common import MeshForgeError, quote_path
from meshforge.formats import MujocoLoad, format_of, save, try_in_mujoco
from meshforge.symbolic import SymbolicMesh

_OWN_FORMATS = {"mujoco": ("mjcf", "urdf"), "bullet": ("urdf",)}
"""The formats that an engine reads itself."""
_PROGRAMS = {"mujoco": "mujoco", "bullet": "pybullet"}
_BULLET_SECONDS = 60.0
_LOAD_IN_BULLET = """
import sys, pybullet
pybullet.connect(pybullet.DIRECT)
sys.exit(0 if pybullet.loadURDF(sys.argv[1]) >= 0 else 3)
"""
_BULLET_HEAD = re.compile(r"b3(?:Warning|Error|Printf)\[[^\]]*\]:\n")


def examine_file(
    path: Path | None, mesh: SymbolicMesh, wanted: CheckOptions, before: SymbolicMesh | None
) -> Examination:
    """Return the examination of a mesh, and what the engine whose limits are asked for says of its file.

    path: of the file as it is now, None for a mesh that no file is of; before: the mesh that it was edited from.
    Raises UsageError for an unknown engine.
    """
    found = examine_mesh(mesh, wanted, before)
    if (engine := wanted.engine) is None:
        return found
    ask = ENGINES_TO_ASK.get(engine)
    return found.add_engine_load(ask(engine, path, mesh) if ask else EngineLoad(engine, _name_of(path)))


def _name_of(path: Path | None) -> str:
    return path.name if path else "this mesh"


def try_mujoco(engine: str, path: Path | None, mesh: SymbolicMesh) -> EngineLoad:
    """Return what MuJoCo says: of an MJCF or a URDF as it is, of any other file as `meshforge convert` writes it as
    MJCF."""
    form = format_of(path).name if path else ""
    own = path is not None and form in _OWN_FORMATS["mujoco"]
    try:
        found = try_in_mujoco(path) if path and own else _try_converted(mesh)
    except ImportError:
        return _describe_absence(engine, path)
    except MeshForgeError as error:
        return EngineLoad(engine, _name_of(path), untried=f"it cannot be made an MJCF: {error.message}")
    remedy = ""
    if found.refusal and path and own and form != "mjcf" and _is_taken_converted(mesh):
        command = f"meshforge convert {quote_path(path)} {quote_path(path.with_suffix('.xml'))}"
        remedy = f"Fix what the message names; or give MuJoCo an MJCF, which it takes: {command}"
    given: Given = "file" if own else "conversion"
    asked = f"MuJoCo {found.version}"
    joined = tuple(_find_joined(mesh).items()) if form == "urdf" and not found.refusal else ()
    return EngineLoad(engine, _name_of(path), asked, given, found.refusal, found.warnings, joined, remedy=remedy)


def _find_joined(mesh: SymbolicMesh) -> dict[str, tuple[str, ...]]:
    """The hulls of each collision mesh that has several: of a URDF's, MuJoCo makes one."""
    joined = dict[str, tuple[str, ...]]()
    for geom in mesh.asset.geoms if mesh.asset else ():
        if geom.element:
            joined[geom.element] = (*joined.get(geom.element, ()), geom.name)
    return joined


def _describe_absence(engine: str, path: Path | None) -> EngineLoad:
    program = _PROGRAMS[engine]
    return EngineLoad(
        engine, _name_of(path), untried=f"{program} is not installed", remedy=f"Install it: pip install {program}"
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
    """Return what PyBullet says of a URDF, in a process of its own, since it may crash; of other files nothing."""
    if path is None or format_of(path).name not in _OWN_FORMATS["bullet"]:
        return EngineLoad(engine, _name_of(path))
    if find_spec("pybullet") is None:
        return _describe_absence(engine, path)
    command = [sys.executable, "-P", "-c", _LOAD_IN_BULLET, str(path.absolute())]
    try:
        done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=_BULLET_SECONDS)
    except subprocess.TimeoutExpired:
        return EngineLoad(engine, path.name, untried=f"it took longer than {_BULLET_SECONDS:g} s")
    refusal = (_read_bullet_words(done.stdout) or "it crashed") if done.returncode else None
    return EngineLoad(engine, path.name, f"PyBullet {version('pybullet')}", "file", refusal)


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
