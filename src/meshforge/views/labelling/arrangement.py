"""How hulls are laid out for a picture: all in place, pushed apart, or some alone among faint others."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from meshforge.geometry import Aabb, Floats, Ints
from meshforge.views.camera import Camera, View, look
from meshforge.views.labelling.sights import WORDS, Glimpse
from meshforge.views.labelling.sitter import Sitter
from meshforge.views.rough import met_roughly, met_with_steps
from meshforge.views.roundness import Skin
from meshforge.views.scene import Scene, assembled, seen_from
from meshforge.views.stage import Hits, Stage, met, upright

COARSE = 128
"""Pixels along the small pictures that tell what a sight shows."""
_MARGIN = 0.06
_FAR = 30.0  # hulls this many times the frame away from it are not drawn: rays are too short for them
_LISTED = 6  # hulls that a name lists one by one


@dataclass(frozen=True, eq=False)
class Arrangement:
    """A sitter's hulls as a picture shows them.

    solid: the hulls that are drawn in full, all others faintly; frame: the points (k, 3) [m] that the picture holds;
    push: how far hulls stand away from the middle of all, beyond where they belong, as a share of that distance;
    close: the hulls that the picture is about, where it holds only a part of the mesh.
    """

    sitter: Sitter
    solid: tuple[int, ...]
    frame: Floats
    push: float = 0.0
    close: tuple[int, ...] = ()

    @staticmethod
    def in_place(sitter: Sitter) -> Arrangement:
        """All hulls in their places."""
        return Arrangement(sitter, tuple(range(len(sitter.render_meshes))), sitter.points)

    @staticmethod
    def explode(sitter: Sitter, push: float) -> Arrangement:
        """All hulls, pushed away from the middle of all."""
        every = tuple(range(len(sitter.render_meshes)))
        moved = Arrangement(sitter, every, sitter.points, push)
        return replace(moved, frame=np.concatenate([s.vertices for s in moved.render_meshes]))

    def describe(self, view: View) -> str:
        """What a picture from there shows, in words."""
        words = WORDS[view]
        if self.push:
            return f"{words}, drawn apart"
        if len(self.solid) < len(self.sitter.render_meshes):
            return f"{_listed(self.solid)} alone, {words}" + (", close up" if self.close else "")
        return f"{words}, close up of {_listed(self.close)}" if self.close else words

    @cached_property
    def render_meshes(self) -> list[Skin]:
        """All hulls where they are drawn."""
        if not self.push:
            return self.sitter.render_meshes
        middles = self.sitter.box_centers
        moves = self.push * (middles - (middles.min(axis=0) + middles.max(axis=0)) / 2)
        return [replace(s, vertices=s.vertices + m) for s, m in zip(self.sitter.render_meshes, moves, strict=True)]

    @cached_property
    def view_frame(self) -> Stage:
        sitter = self.sitter
        return sitter.view_frame if self.frame is sitter.points else Stage(Aabb.of_points(self.frame), upright(sitter.up))

    def camera(self, view: View, size: tuple[int, int]) -> Camera:
        return look(view, self.sitter.up, size, self.view_frame.to_unit(self.frame), _MARGIN)

    def preview(self, view: View, shape: float = 1.0) -> Glimpse:
        """What a small picture, `shape` times as high as wide, shows of each hull (n,)."""
        size = COARSE, max(1, round(COARSE * shape))
        hits = met(self._preview_scene, self.camera(view, size), (slice(0, size[0]), slice(0, size[1])))
        return Glimpse.of(self.hull_pixels(hits), len(self.render_meshes))

    def cast_solid(self, camera: Camera) -> Hits:
        """What the pixels show of the hulls that are drawn in full."""
        return met(self._solid_scene, camera)

    def cast_faint(self, camera: Camera) -> Hits | None:
        """What the pixels show of the faint hulls and of what is no hull, None where there is neither."""
        scene = self._faint_scene
        return met_roughly(scene, camera) if len(scene.corners) else None

    def cast_visual(self, camera: Camera) -> tuple[Hits, Any] | None:
        """What the pixels show of the visual mesh, and where a part of it steps back behind another (h, w).

        None where there is no visual mesh, where the hulls are not in their places, and from close up where some are
        drawn alone: what is around them would hide all.
        """
        hidden = bool(self.close) and len(self.solid) < len(self.render_meshes)
        if self.push or hidden or not self.sitter.visuals[0]:
            return None
        return met_with_steps(self.sitter.visual_scene(self.view_frame), camera)

    def hull_pixels(self, hits: Hits) -> Ints:
        """The index of the hull that each pixel (h, w) shows in full, -1 for none."""
        whole = len(self.solid) == len(self.render_meshes)
        return hits.item if whole else np.append(np.array(self.solid, np.int64), -1)[hits.item]

    @cached_property
    def _solid_scene(self) -> Scene:
        return assembled([self.render_meshes[k] for k in self.solid], self.view_frame.bounds.center, self.view_frame.unit)

    @cached_property
    def _preview_scene(self) -> Scene:
        """The solid hulls for glimpses from all sides, in which it is no matter which of two in one place is seen."""
        return seen_from(self._solid_scene, None)

    @cached_property
    def _faint_scene(self) -> Scene:
        near = self.view_frame.bounds
        reach = _FAR * self.view_frame.unit
        others = sorted(set(range(len(self.render_meshes))) - set(self.solid))
        low, high = self.sitter.mesh.corners
        near_by = [k for k in others if (low[k] > near.min - reach).all() and (high[k] < near.max + reach).all()]
        skins = [self.render_meshes[k] for k in near_by] + ([] if self.push else self.sitter.opaque)
        return seen_from(assembled(skins, near.center, self.view_frame.unit), None)


def _listed(hulls: tuple[int, ...]) -> str:
    texts = [str(k) for k in hulls[:_LISTED]]
    more = f" and {len(hulls) - len(texts)} more" if len(hulls) > len(texts) else ""
    return f"{'hulls' if len(hulls) > 1 else 'hull'} {', '.join(texts)}{more}"
