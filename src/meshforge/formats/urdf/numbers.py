"""Numbers in attributes of a URDF."""

from __future__ import annotations

import numpy as np

from meshforge.errors import AssetError
from meshforge.formats.meshfile import FARTHEST
from meshforge.formats.xml import Element, numbers
from meshforge.geometry import Floats, Pose


def floats(
    element: Element, attribute: str, count: int, where: str, default: tuple[float, ...] | None = None
) -> Floats:
    """The numbers (count,) of an attribute, `default` where it is left out.

    Raises AssetError with `where:line`: the attribute is missing, of another length, or not of finite numbers.
    """
    place = f"{where}:{element.line}"
    text = element.attributes.get(attribute)
    if text is None:
        if default is None:
            raise AssetError(f"<{element.tag}> has no attribute {attribute!r}", where=place)
        return np.array(default, dtype=np.float64)
    given = f"<{element.tag} {attribute}={text!r}>"
    if "${" in text:
        raise AssetError(f"{given} is a xacro expression", where=place, remedy="Expand the file with xacro first.")
    values = numbers(text)
    if values is None or len(values) != count:
        wanted = "a finite number" if count == 1 else f"{count} finite numbers"
        raise AssetError(f"{given} does not hold {wanted}", where=place)
    if any(abs(value) > FARTHEST for value in values):
        raise AssetError(f"{given} is larger than anything", where=place)
    return np.array(values)


def origin(element: Element, where: str) -> Pose:
    """The pose of an element's first `<origin>`, identity where there is none."""
    place = element.first("origin")
    if place is None:
        return Pose.identity()
    zero = (0.0, 0.0, 0.0)
    xyz, rpy = (floats(place, attribute, 3, where, zero) for attribute in ("xyz", "rpy"))
    return Pose.from_rpy(list(xyz), list(rpy))
