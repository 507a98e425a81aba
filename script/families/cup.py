"""A cup as numbers: a wall of tiles on a cut-up base, handles as bent bars, a lid; written as a URDF with meshes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from meshforge.formats import MeshPart, format_obj
from meshforge.geometry import Floats, Polytope, Pose, inertia
from meshforge.samples.families import Files
from script.families.parts import SampleHull, format_hulls, format_labels, join_surfaces, name_hulls
from script.families.pieces import Cut, Profile, bend, hull_of, slice_all, stack, superellipse, wall

_ROUND = superellipse(2.0, 2.0, 2.0, 14)
SQUARE = superellipse(2.0, 2.0, 7.0, 16)
OCTAGON = superellipse(2.0, 2.0, 2.0, 8)
_COLLISION = """\
    <collision{name}>
      <geometry><mesh filename="{mesh}"/></geometry>
    </collision>
"""
_SUNK = 0.0015  # how deep a handle is in its wall [m]


@dataclass(frozen=True, slots=True)
class Ear:
    """A handle.

    turn: where it stands about the cup [degrees]; high, low: where it leaves the wall and comes back to it [m], low
    None for one that stands out straight and does not come back; reach: how far it stands out [m]; width, thickness:
    of the bar [m]; pieces: into how many it is cut; power: of its arc, see `superellipse`; sides: of the bar.
    """

    turn: float
    high: float
    low: float | None
    reach: float
    width: float
    thickness: float
    pieces: int
    power: float = 2.0
    sides: int = 6

    def build(self, profile: Profile) -> list[Polytope]:
        """Its pieces on a wall."""
        turn = Pose.from_rpy((0, 0, 0), (0, 0, float(np.radians(self.turn))))
        pieces = bend(self._path(profile), self.width, self.thickness, self.sides)
        return [hull_of(piece.vertices, turn) for piece in pieces]

    def _path(self, profile: Profile) -> Floats:
        if self.low is None:
            start = _half_at(profile, self.high) - _SUNK
            x = np.linspace(start, start + self.reach, self.pieces + 1)
            return np.column_stack([x, np.full_like(x, self.high)])
        turn = np.linspace(np.pi / 2, -np.pi / 2, self.pieces + 1)
        c, s = np.cos(turn).clip(0), np.sin(turn)
        middle, half = (self.high + self.low) / 2, (self.high - self.low) / 2
        z = middle + half * np.sign(s) * abs(s) ** (2 / self.power)
        x = np.array([_half_at(profile, height) for height in z.tolist()]) - _SUNK + self.reach * c ** (2 / self.power)
        return np.column_stack([x, z])


def _half_at(profile: Profile, height: float) -> float:
    """Half the width of a wall at a height [m]."""
    return float(np.interp(height, [z for _, z in profile], [half for half, _ in profile]))


@dataclass(frozen=True, eq=False)
class Cup:
    """One cup.

    outline: of all but its handles; base, wall, lid: as stacks of rings, see `stack`; columns: tiles of a row of the
    wall; cuts: of the base and of the lid; order: of the parts in the file; link: the URDF's; names: of its collision
    elements, see `name_hulls`, empty for one mesh file of all pieces.
    """

    name: str
    about: str
    base: Profile
    wall: Profile
    thickness: float
    columns: int
    ears: tuple[Ear, ...] = ()
    cuts: tuple[Cut, ...] = ()
    lid: Profile = ()
    lid_cuts: tuple[Cut, ...] = ()
    outline: Floats = field(default_factory=lambda: _ROUND)
    order: str = "base wall handle lid"
    link: str = "base_link"
    names: str = ""
    color: str = "0.85 0.85 0.8 1"
    mass: float = 0.3

    def write(self) -> Files:
        """Its URDF with meshes and labels, below a folder of its own."""
        parts = {
            "base": slice_all(stack(self.outline, self.base), self.cuts),
            "wall": wall(self.outline, self.wall, self.thickness, self.columns),
            "handle": [hull for ear in self.ears for hull in ear.build(self.wall)],
            "lid": slice_all(stack(self.outline, self.lid), self.lid_cuts),
        }
        hulls = name_hulls([(label, parts[label]) for label in self.order.split()], self.names or "piece_{}")
        meshes = {f"meshes/{hull.name}.obj": format_hulls([hull], self.about) for hull in hulls}
        if not self.names:
            meshes = {"meshes/collision.obj": format_hulls(hulls, self.about)}
        known = [hull.name if self.names else f"geom0#{k}" for k, hull in enumerate(hulls)]
        labels = format_labels((f"{self.link}/{name}" for name in known), (hull.label for hull in hulls))
        visual = format_obj([MeshPart(self.name, join_surfaces(hull.shape for hull in hulls))])
        urdf = self._format_urdf(hulls, list(meshes))
        files = {"model.urdf": urdf, "model.labels.json": labels, "meshes/visual.obj": visual, **meshes}
        return {f"{self.name}/{path}": content for path, content in files.items()}

    def _format_urdf(self, hulls: Sequence[SampleHull], meshes: Sequence[str]) -> bytes:
        centre, moments = inertia([hull.shape for hull in hulls], self.mass)
        x, y, z = (f"{value:.5f}" for value in centre)
        rows = [f'i{"xyz"[i]}{"xyz"[j]}="{round(moments[i, j], 9) + 0:.9f}"' for i in range(3) for j in range(i, 3)]
        names = [f' name="{hull.name}"' for hull in hulls] if self.names else [""]
        collisions = [_COLLISION.format(name=name, mesh=mesh) for name, mesh in zip(names, meshes, strict=True)]
        return f"""\
<?xml version="1.0"?>
<!-- {self.about} -->
<robot name="{self.name}">
  <material name="glaze"><color rgba="{self.color}"/></material>
  <link name="{self.link}">
    <inertial>
      <origin xyz="{x} {y} {z}"/>
      <mass value="{self.mass}"/>
      <inertia {" ".join(rows)}/>
    </inertial>
    <visual>
      <geometry><mesh filename="meshes/visual.obj"/></geometry>
      <material name="glaze"/>
    </visual>
{"".join(collisions)}  </link>
</robot>
""".encode()
