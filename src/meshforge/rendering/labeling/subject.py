"""What a series of labelling pictures shows: the hulls of a mesh in their places, or some among faint others."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from meshforge.common import join_names
from meshforge.geometry import Aabb, Floats, Ints
from meshforge.rendering.annotation import count_pixels
from meshforge.rendering.camera import Camera, Up, View, aim_camera
from meshforge.rendering.colors import PALE, pick_distinct_colors, rgb
from meshforge.rendering.picture import points_to_frame
from meshforge.rendering.raycast import DrawLayer, ViewFrame, cast_rays, up_vector
from meshforge.rendering.scene import RayScene, RenderMesh, build_scene, prepare_for_rays, to_render_mesh
from meshforge.symbolic import SymbolicMesh

_BEST_KNOWN: tuple[View, ...] = (
    "front-right-above", "front-left-above", "front", "back-left-above", "back-right-above", "top", "right", "left",
    "back", "bottom", "front-left-below", "front-right-below", "back-left-below", "back-right-below",
)  # fmt: skip
VIEW_WORDS: Mapping[View, str] = {
    view: "from the {} {}, {}".format(*view.split("-")) if "-" in view else view for view in _BEST_KNOWN
}
"""What each view is called; those that people know things best by come first."""
NEUTRAL = rgb("#C9C4BB")
"""The material of hulls that are drawn plain, and of a visual mesh that has no colour."""
_LIGHTEST = 0.86  # lighter colours would be lit to plain white
_CLEAR = 0.05  # visuals this little opaque are not drawn

PREVIEW_SIZE = 128
"""Pixels along the small pictures that tell what a view shows."""
_FAINT = 0.15  # how much shows of what is drawn faintly
_FAR = 30.0  # hulls this many times the frame away from it are not drawn: rays are too short for them
_HULLS_NAMED = 6  # hulls that a name lists one by one


@dataclass(frozen=True, eq=False)
class LabelingSubject:
    """A mesh, the hulls (indices) that pictures are to show, with their numbers, and the axis that points up."""

    mesh: SymbolicMesh
    wanted: Mapping[int, int]
    up: Up

    @cached_property
    def render_meshes(self) -> list[RenderMesh]:
        """Their triangles: fewer than other pictures have, since surfaces that bend are lit by the triangle."""
        count = sum(hull.shape.is_primitive for hull in self.mesh.hulls)
        return [to_render_mesh(hull.shape, min(max(1200 // max(count, 1), 24), 64)) for hull in self.mesh.hulls]

    @cached_property
    def colors(self) -> Floats:
        """The colour (n, 3) of each hull: its own where it is wanted, pale where not."""
        colors = np.tile(rgb(PALE), (len(self.mesh.hulls), 1))
        colors[list(self.wanted)] = pick_distinct_colors(self.mesh, self.wanted)
        return colors

    @cached_property
    def visuals(self) -> tuple[list[RenderMesh], Floats]:
        """The surfaces of the asset that are to be looked at, and their colours (k, 3).

        Of an asset that shows none, the hulls and what it has besides; none where there are only hulls.
        """
        shown = self.mesh.asset.visuals if self.mesh.asset else ()
        kept = [s for s in shown if len(s.faces) and (s.rgba is None or s.rgba[3] > _CLEAR)]
        colors = [NEUTRAL if s.rgba is None else np.clip(s.rgba[:3], 0, _LIGHTEST) for s in kept]
        if not kept and self.non_convex:
            every = [*self.render_meshes, *self.non_convex]
            return every, _paint_neutral(len(every))
        return [to_render_mesh(s) for s in kept], np.array(colors).reshape(-1, 3)

    @cached_property
    def non_convex(self) -> list[RenderMesh]:
        """Collision geometry that is no hull."""
        pieces = self.mesh.asset.non_convex if self.mesh.asset else ()
        return [to_render_mesh(piece.surface) for piece in pieces if piece.surface and len(piece.surface.faces)]

    @cached_property
    def points(self) -> Floats:
        """The points (n, 3) [m] that a picture of the whole mesh holds."""
        return points_to_frame(self.render_meshes, [*self.visuals[0], *self.non_convex])

    def points_of(self, hulls: Sequence[int]) -> Floats:
        """Return the corners (n, 3) [m] of some hulls."""
        return np.concatenate([self.render_meshes[k].vertices for k in hulls])


@dataclass(frozen=True, eq=False)
class Arrangement:
    """A subject's hulls as a picture shows them.

    solid: the hulls that are drawn in full, all others faintly; frame: the points (k, 3) [m] that the picture holds;
    close: the hulls that the picture is about, where it holds only a part of the mesh.
    """

    subject: LabelingSubject
    solid: tuple[int, ...]
    frame: Floats
    close: tuple[int, ...] = ()

    @staticmethod
    def in_place(subject: LabelingSubject) -> "Arrangement":
        """Return all hulls in their places."""
        return Arrangement(subject, tuple(range(len(subject.render_meshes))), subject.points)

    def describe(self, view: View) -> str:
        """Return what a picture from there shows, in words."""
        words = VIEW_WORDS[view]
        if len(self.solid) < len(self.subject.render_meshes):
            return f"{self._list_hulls(self.solid)} alone, {words}" + (", close up" if self.close else "")
        return f"{words}, close up of {self._list_hulls(self.close)}" if self.close else words

    def _list_hulls(self, hulls: tuple[int, ...]) -> str:
        texts = [str(self.subject.wanted.get(k, k)) for k in hulls]
        return f"{'hulls' if len(hulls) > 1 else 'hull'} {join_names(texts, _HULLS_NAMED)}"

    @cached_property
    def view_frame(self) -> ViewFrame:
        return ViewFrame(Aabb.of_points(self.frame), up_vector(self.subject.up))

    def camera(self, view: View, size: tuple[int, int]) -> Camera:
        return aim_camera(view, self.subject.up, size, self.view_frame.to_unit(self.frame))

    def preview(self, view: View, shape: float = 1.0) -> Floats:
        """Return the share (n,) of a small picture, `shape` times as high as wide, that shows each hull."""
        size = PREVIEW_SIZE, max(1, round(PREVIEW_SIZE * shape))
        hits = cast_rays(self._preview_scene, self.camera(view, size), (slice(0, size[0]), slice(0, size[1])))
        items = self.find_hulls(hits.item)
        return count_pixels(items, len(self.subject.render_meshes)) / items.size

    def find_hulls(self, items: Ints) -> Ints:
        """Return the index of the hull that each pixel (h, w) shows, given its place among the solid ones."""
        return np.append(np.array(self.solid, np.int64), -1)[items]

    @cached_property
    def layers(self) -> tuple[DrawLayer, DrawLayer]:
        """The hulls that are drawn in full, and what is faint about them."""
        return self._draw_solid(self.subject.colors[list(self.solid)]), self._faint

    @cached_property
    def plain_layers(self) -> tuple[DrawLayer, ...]:
        """The visual mesh; without one, and where it would hide hulls drawn alone, the hulls in one material."""
        if len(self.solid) == len(self.subject.render_meshes) and self.subject.visuals[0]:
            return (DrawLayer(*self.subject.visuals),)
        return self._draw_solid(_paint_neutral(len(self.solid))), self._faint

    def _draw_solid(self, colors: Floats) -> DrawLayer:
        return DrawLayer([self.subject.render_meshes[k] for k in self.solid], colors)

    @cached_property
    def _preview_scene(self) -> RayScene:
        """The solid hulls for previews from all sides, in which it is no matter which of two in one place is seen."""
        solid = self.layers[0].render_meshes
        return prepare_for_rays(build_scene(solid, self.view_frame.bounds.center, self.view_frame.unit), None)

    @cached_property
    def _faint(self) -> DrawLayer:
        """The hulls that are near the picture and not solid, and what is no hull."""
        near, subject = self.view_frame.bounds, self.subject
        reach = _FAR * self.view_frame.unit
        others = sorted(set(range(len(subject.render_meshes))) - set(self.solid))
        low, high = subject.mesh.corners
        near_by = [k for k in others if (low[k] > near.min - reach).all() and (high[k] < near.max + reach).all()]
        faint = [subject.render_meshes[k] for k in near_by] + subject.non_convex
        return DrawLayer(faint, _paint_neutral(len(faint)), before=_FAINT)


def _paint_neutral(count: int) -> Floats:
    return np.tile(NEUTRAL, (count, 1))
