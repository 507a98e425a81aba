"""A table as it is made: its parts standing on the floor, how it lies in its file, and how it is decomposed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from meshforge.geometry import Pose
from meshforge.geometry.decomposition.engines import CoacdSettings
from script.samples.part import Part


@dataclass(frozen=True)
class Table:
    """One member of the family.

    tilt: roll, pitch, yaw in the file [degrees], yaw first; coacd: settings of its parts; other: those of some
    parts, by their names or their labels.
    """

    name: str
    about: str
    parts: tuple[Part, ...]
    tilt: tuple[float, float, float]
    coacd: CoacdSettings
    other: Mapping[str, CoacdSettings] = field(default_factory=dict)

    @property
    def pose(self) -> Pose:
        """file_T_table."""
        roll, pitch, yaw = np.radians(self.tilt)
        turned = Pose.from_rpy((0, 0, 0), (0, 0, float(yaw)))
        return Pose.from_rpy((0, 0, 0), (float(roll), float(pitch), 0)) @ turned

    def settings(self, part: Part) -> CoacdSettings:
        return self.other.get(part.name, self.other.get(part.label, self.coacd))


def join_parts(*parts: Part | Iterable[Part]) -> tuple[Part, ...]:
    """Parts and lists of parts as one tuple."""
    flat: list[Part] = []
    for item in parts:
        flat.extend([item] if isinstance(item, Part) else item)
    return tuple(flat)
