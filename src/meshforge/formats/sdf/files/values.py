"""Values in the elements of an SDF: numbers, poses, names and switches."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshforge.errors import AssetError
from meshforge.formats.meshfile import FARTHEST
from meshforge.formats.xml import Element, numbers
from meshforge.geometry import Floats, Pose

_LONG = 80  # characters of a value in a message


def text_of(parent: Element | None, tag: str, default: str = "") -> str:
    """The text of an element's first child of a tag."""
    child = parent.first(tag) if parent else None
    return child.text if child else default


def is_true(text: str) -> bool:
    """Whether a switch is on, as libsdformat reads it."""
    return text.strip().lower() in ("true", "1")


def floats(parent: Element, tag: str, where: str, default: tuple[float, ...]) -> Floats:
    """The numbers of a child element, `default` where it is left out, as long as that.

    Raises AssetError with `where:line`: of another length, or not of finite numbers.
    """
    child = parent.first(tag)
    return np.array(default) if child is None else values(child, len(default), where)


def values(element: Element, count: int, where: str) -> Floats:
    """The numbers (count,) that an element holds. Raises AssetError with `where:line`."""
    found = numbers(element.text)
    shown = element.text if len(element.text) <= _LONG else f"{element.text[:_LONG]}..."
    given, place = f"<{element.tag}>{shown}</{element.tag}>", f"{where}:{element.line}"
    if found is None or len(found) != count:
        wanted = "a finite number" if count == 1 else f"{count} finite numbers"
        raise AssetError(f"{given} does not hold {wanted}", where=place)
    if any(abs(value) > FARTHEST for value in found):
        raise AssetError(f"{given} is larger than anything", where=place)
    return np.array(found)


@dataclass(frozen=True, eq=False, slots=True)
class Placed:
    """A pose as it is authored; base: the name of the frame it counts from, empty for the usual one."""

    pose: Pose
    base: str
    line: int


def pose_of(owner: Element | None, where: str) -> Placed:
    """The pose of an element's first `<pose>`, identity where there is none. Raises AssetError with `where:line`."""
    element = owner.first("pose") if owner else None
    if element is None:
        return Placed(Pose.identity(), "", owner.line if owner else 0)
    base = element.attributes.get("relative_to", element.attributes.get("frame", "")).strip()
    if element.attributes.get("rotation_format") == "quat_xyzw":
        return Placed(_of_quaternion(element, where), base, element.line)
    found = values(element, 6, where) if element.text else np.zeros(6)
    turn = np.radians(found[3:]) if is_true(element.attributes.get("degrees", "")) else found[3:]
    return Placed(Pose.from_rpy(list(found[:3]), list(turn)), base, element.line)


def _of_quaternion(element: Element, where: str) -> Pose:
    """A pose of x y z and a quaternion x y z w, which need not be of unit length."""
    if not element.text:
        return Pose.identity()
    found = values(element, 7, where)
    length = float(np.linalg.norm(found[3:]))
    if length == 0:
        raise AssetError("the quaternion of this <pose> is zero", where=f"{where}:{element.line}")
    x, y, z, w = found[3:] / length
    rotation = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return Pose(rotation, found[:3])
