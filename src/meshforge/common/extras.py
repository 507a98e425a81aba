"""Libraries that may be absent: those of an extra, and MuJoCo where it has no wheel."""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import Any

from meshforge.common.messages import MeshForgeError


def import_extra(library: str, extra: str, purpose: str) -> Any:
    """Return an optional library. Raises MeshForgeError that names the extra to install; purpose: what needs it, a
    subject."""
    try:
        return import_module(library)
    except ImportError as error:
        problem = f"{purpose} needs the package {library}, which cannot be imported ({error})"
        raise MeshForgeError(problem, remedy=f"Install it: pip install 'meshforge[{extra}]'.") from error


def require_mujoco(what: str, where: str | None = None) -> None:
    """Raise MeshForgeError where MuJoCo, which `what` needs, is not installed; it is not loaded for that."""
    if find_spec("mujoco") is None:
        remedy = "Install it: pip install 'mujoco>=4.0'. It has no wheel for macOS on Intel: work on another machine."
        raise MeshForgeError(f"{what} needs MuJoCo, which is not installed", where=where, remedy=remedy)
