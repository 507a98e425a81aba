"""Libraries that are optional: each comes with an extra of the package."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from meshforge.common.messages import MeshForgeError


def import_extra(library: str, extra: str, purpose: str) -> Any:
    """An optional library. Raises MeshForgeError that names the extra to install; purpose: what needs it, a subject."""
    try:
        return import_module(library)
    except ImportError as error:
        problem = f"{purpose} needs the package {library}, which cannot be imported ({error})"
        raise MeshForgeError(problem, remedy=f"Install it: pip install 'meshforge[{extra}]'.") from error
