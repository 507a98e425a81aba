"""The contact attributes of compiled geoms, under the names that MJCF has for them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import mujoco

_ATTRIBUTES = (
    *("contype", "conaffinity", "condim", "group", "priority"),
    *("friction", "margin", "gap", "solmix", "solref", "solimp", "adhesion"),
)


def contact_attributes(model: mujoco.MjModel, geom: int) -> tuple[tuple[str, str], ...]:
    """Names and values of what decides how a geom collides, defaults and classes included."""
    return tuple((name, _text(getattr(model, f"geom_{name}")[geom])) for name in _ATTRIBUTES)


def _text(value: object) -> str:
    numbers = np.atleast_1d(np.asarray(value)).tolist()
    return " ".join(str(number) if isinstance(number, int) else f"{number:g}" for number in numbers)
