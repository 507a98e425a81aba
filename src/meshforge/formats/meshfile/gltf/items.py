"""Careful access to the parsed JSON of a glTF file, where any value may be of any type."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshforge.geometry import Floats

Json = dict[str, Any]


def entries(owner: Any, key: str) -> list[Any]:
    """The array under a key, empty where there is none. Raises ValueError: it is something else."""
    found = owner.get(key, []) if isinstance(owner, dict) else None
    if not isinstance(found, list):
        raise ValueError(f"its {key!r} are no array")
    return found


def entry(owner: Any, key: str, index: Any) -> Json:
    """The object of an index in the array under a key. Raises ValueError: it is not there, or no object."""
    found = entries(owner, key)
    if not isinstance(index, int) or isinstance(index, bool) or not 0 <= index < len(found):
        raise ValueError(f"there is no {index!r} in its {key!r}")
    if not isinstance(found[index], dict):
        raise ValueError(f"{index} of its {key!r} is no object")
    return found[index]  # type: ignore[no-any-return]  # an object


def extension(owner: Any, name: str) -> Json | None:
    """An extension of an object, None where it has none of that name."""
    found = owner.get("extensions", {}).get(name)
    return found if isinstance(found, dict) else None


def numbers(owner: Json, key: str, count: int, default: tuple[float, ...]) -> Floats:
    """So many finite numbers under a key. Raises ValueError: others, or another count."""
    values = np.array(owner.get(key, default), dtype=np.float64)
    if values.shape != (count,) or not np.isfinite(values).all():
        raise ValueError(f"its {key!r} should be {count} finite numbers")
    return values


def number(owner: Json, key: str, default: float) -> float:
    """A finite number under a key. Raises ValueError."""
    return float(numbers({key: [owner[key]]} if key in owner else {}, key, 1, (default,))[0])
