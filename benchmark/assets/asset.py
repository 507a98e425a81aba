"""An asset as its generator makes it: named watertight parts, and the sites where a task's criterion is tried."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from meshforge.geometry import Pose
from script.samples.part import Part
from script.samples.solids import Point

LEVEL: tuple[Point, Point, Point] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True, slots=True)
class Site:
    """A place on an asset, in its upright frame [m], that a criterion is tried at; what it means, the criterion says.

    axes: three unit vectors, orthogonal, right-handed; size: along them; moving: labels of what moves there.
    """

    name: str
    at: Point
    size: Point
    axes: tuple[Point, Point, Point] = LEVEL
    moving: tuple[str, ...] = ()

    def to_json(self) -> dict[str, Any]:
        return {
            "name": self.name,
            "at": [round(x, 7) for x in self.at],
            "size": [round(x, 7) for x in self.size],
            "axes": [[round(x, 12) for x in axis] for axis in self.axes],
            "moving": list(self.moving),
        }

    @staticmethod
    def of_json(data: dict[str, Any]) -> Site:
        x, y, z = map(tuple, data["axes"])
        return Site(data["name"], tuple(data["at"]), tuple(data["size"]), (x, y, z), tuple(data["moving"]))


@dataclass(frozen=True)
class Design:
    """What a category makes of one draw: z up, front to -Y, standing on z = 0 where it stands.

    kind: the variant; about: a few words on this one.
    """

    about: str
    parts: tuple[Part, ...]
    sites: tuple[Site, ...] = ()


@dataclass(frozen=True)
class Asset:
    """One member of a family.

    kind: the variant; rare: whether few are like it; pose: file_T_upright; scanned: decomposed as it lies in its
    file, as scans are, not square to its own axes; attempt: how often it was drawn again, since two of its separate
    decompositions were the same.
    """

    name: str
    category: str
    kind: str
    rare: bool
    about: str
    parts: tuple[Part, ...] = field(repr=False)
    sites: tuple[Site, ...]
    pose: Pose
    scanned: bool
    attempt: int = 0

    def site(self, name: str) -> list[Site]:
        """The sites of that name, in order."""
        return [site for site in self.sites if site.name == name]
