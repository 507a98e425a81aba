"""A file given to MuJoCo as it is, whatever MeshForge makes of it: taken, or refused in MuJoCo's own words."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from meshforge.formats.libraries import mujoco
from meshforge.formats.mjcf.engine import collect_warnings, failure_types


@dataclass(frozen=True, slots=True)
class MujocoTrial:
    """What MuJoCo says of a file. version: of MuJoCo; refusal: its words, None where it compiles the file."""

    version: str
    refusal: str | None
    warnings: tuple[str, ...] = ()


def try_in_mujoco(path: Path) -> MujocoTrial:
    """Compile an MJCF or a URDF with MuJoCo, with all files that it names.

    Its warnings are collected, and no log is written. Raises ImportError where MuJoCo is not installed.
    """
    version, refusal = str(mujoco.__version__), None
    heard: list[str] = []
    with collect_warnings(heard):
        try:
            mujoco.MjModel.from_xml_path(str(path))
        except failure_types() as error:
            refusal = _in_one_line(str(error)) or "it does not say why"
    return MujocoTrial(version, refusal, tuple(dict.fromkeys(map(_in_one_line, heard))))


def _in_one_line(message: str) -> str:
    """The words of MuJoCo, in one line and without the `Error:` that it begins with."""
    lines = [line.strip() for line in message.replace("XML Error: ", "").splitlines() if line.strip()]
    return "; ".join(line.removeprefix("Error: ") for line in lines)
