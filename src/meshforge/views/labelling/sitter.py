"""The mesh that sits for a series of pictures: its hulls, their colours and numbers, and what else there is of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from meshforge.geometry import Aabb, Floats
from meshforge.symbolic import SymbolicMesh
from meshforge.views.camera import Up
from meshforge.views.coloring import colors_apart
from meshforge.views.labelling.sights import outermost
from meshforge.views.palette import PALE, rgb
from meshforge.views.roundness import Skin, skin
from meshforge.views.scene import Scene, assembled, seen_from
from meshforge.views.stage import Stage, upright
from meshforge.views.subject import framed

NEUTRAL = rgb("#C9C4BB")
"""The material of hulls that are drawn plain, and of a visual mesh that has no colour."""
_LIGHTEST = 0.86  # lighter colours would be lit to plain white
_MANY = 1500  # triangles
_CLEAR = 0.05  # visuals this little opaque are not drawn


@dataclass(frozen=True, eq=False)
class Sitter:
    """A mesh, the hulls (indices) that pictures are to show and number, and the axis that points up."""

    mesh: SymbolicMesh
    wanted: tuple[int, ...]
    up: Up

    @cached_property
    def render_meshes(self) -> list[Skin]:
        """Their triangles: fewer than other pictures have, since surfaces that bend are lit by the triangle."""
        count = sum(hull.shape.is_primitive for hull in self.mesh.hulls)
        return [skin(hull.shape, min(max(1200 // max(count, 1), 24), 64)) for hull in self.mesh.hulls]

    @cached_property
    def box_centers(self) -> Floats:
        """The middle (n, 3) [m] of each hull's box."""
        low, high = self.mesh.corners
        return (low + high) / 2

    @cached_property
    def colors(self) -> Floats:
        """The colour (n, 3) of each hull: its own where it is wanted, pale where not."""
        colors = np.tile(rgb(PALE), (len(self.mesh.hulls), 1))
        colors[list(self.wanted)] = colors_apart(self.mesh, self.wanted)
        return colors

    @cached_property
    def number_texts(self) -> dict[int, str]:
        """What is written on each wanted hull."""
        return {k: str(k) for k in self.wanted}

    @cached_property
    def visuals(self) -> tuple[list[Skin], Floats]:
        """The surfaces of the asset that are to be looked at, and their colours (k, 3).

        Of an asset that shows none, the hulls and what it has besides; none where there are only hulls.
        """
        shown = self.mesh.asset.visuals if self.mesh.asset else ()
        kept = [s for s in shown if len(s.faces) and (s.rgba is None or s.rgba[3] > _CLEAR)]
        colors = [NEUTRAL if s.rgba is None else np.clip(s.rgba[:3], 0, _LIGHTEST) for s in kept]
        if not kept and self.opaque:
            every = [*self.render_meshes, *self.opaque]
            return every, np.tile(NEUTRAL, (len(every), 1))
        return [skin(s) for s in kept], np.array(colors).reshape(-1, 3)

    @cached_property
    def opaque(self) -> list[Skin]:
        """Collision geometry that is no hull."""
        pieces = self.mesh.asset.opaque if self.mesh.asset else ()
        return [skin(piece.surface) for piece in pieces if piece.surface and len(piece.surface.faces)]

    @cached_property
    def smooth(self) -> Any:
        """Which of these surfaces (k,) have so many triangles that their edges tell nothing."""
        return np.array([len(s.faces) > _MANY for s in self.visuals[0]], bool)

    @cached_property
    def points(self) -> Floats:
        """The outermost points (n, 3) [m] that a picture of the whole mesh holds, from any sight."""
        return outermost(framed(self.render_meshes, [*self.visuals[0], *self.opaque]), self.up)

    @cached_property
    def view_frame(self) -> Stage:
        """The frame that the whole mesh is drawn in."""
        return Stage(Aabb.of_points(self.points), upright(self.up))

    def visual_scene(self, stage: Stage) -> Scene:
        """The visual mesh, ready to be drawn in a frame."""
        return self._whole_visual_scene if stage is self.view_frame else self._build_visual_scene(stage)

    @cached_property
    def _whole_visual_scene(self) -> Scene:
        return self._build_visual_scene(self.view_frame)

    def _build_visual_scene(self, stage: Stage) -> Scene:
        return seen_from(assembled(self.visuals[0], stage.bounds.center, stage.unit), None)

    def points_of(self, hulls: Sequence[int]) -> Floats:
        """The corners (n, 3) [m] of some hulls."""
        return np.concatenate([self.render_meshes[k].vertices for k in hulls])

    @cached_property
    def diagonal(self) -> float:
        return Aabb.of_points(self.points).diagonal
