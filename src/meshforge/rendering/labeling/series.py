"""A series of pictures in which each hull of a mesh is seen and numbered at least once, from close up where needed."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

import numpy as np

from meshforge.common import UsageError, suggest_name
from meshforge.geometry import Aabb, Floats
from meshforge.rendering.camera import Up, View
from meshforge.rendering.labeling.picture import LabelingCanvas, LabelingPicture
from meshforge.rendering.labeling.subject import PREVIEW_SIZE, Arrangement, LabelingSubject
from meshforge.rendering.labeling.viewpoints import VIEW_PREFERENCES, choose_views
from meshforge.rendering.picture import up_axis
from meshforge.rendering.placement import LEAST_PIXELS
from meshforge.symbolic import SymbolicMesh

LABELING_SIZES = range(256, 4097)
_PREVIEW_PIXELS = 2.5  # pixels of a preview: fewer tell little
_POOR_PIXELS = 10 * LEAST_PIXELS  # hulls that show fewer everywhere are drawn from close up, if pictures are left

_PUSH = 1.2  # how far hulls are drawn apart
_NEAR = 0.12  # hulls this near each other, as a share of the diagonal, can share a picture from close up
_ROOM = 1.2  # how much is seen about hulls from close up, as a share of their size
_CLOSE = 0.6  # a picture is from close up if it holds at most this share of the whole
_FEW, _EXPLODED = 0.85, 0.81  # what a picture of some hulls only, or of moved ones, is worth beside one of all in place


def draw_labeling_pictures(
    mesh: SymbolicMesh, *, hulls: Collection[str] | None = None, most: int = 6, size: int = 1024, up: Up | None = None
) -> tuple[LabelingPicture, ...]:
    """Draw views chosen so that each of `hulls`, by default all, is seen and numbered in at least one, by its index.

    At most `most` of them show the mesh as it is, the most telling first. Hulls that none of these shows are shown
    from close up, alone among faint others, or with all hulls drawn apart, in further ones. Hulls beside `hulls` are
    pale and have no number. All are orthographic.

    size: pixels along each side; up: the axis that points up, by default that of the mesh. Same input, same pictures.
    Raises UsageError for hulls that are not there, and for an impossible number or size of pictures.
    """
    names = mesh.index
    picked = set(names if hulls is None else hulls)
    _check_arguments(names, picked, most, size)
    subject = LabelingSubject(mesh, tuple(k for name, k in names.items() if name in picked), up_axis(mesh, up))
    return tuple(_PictureSeries(LabelingCanvas(subject, size)).run(most)) if picked else ()


def _check_arguments(names: Mapping[str, int], picked: Collection[str], most: int, size: int) -> None:
    unknown = sorted(set(picked) - set(names))
    if unknown:
        raise UsageError(f"there is no hull {unknown[0]!r}", remedy=suggest_name(unknown[0], names))
    if most < 1:
        raise UsageError(f"{most} pictures show nothing", remedy="Ask for one at least.")
    if size not in LABELING_SIZES:
        remedy = f"Sides go from {LABELING_SIZES.start} to {LABELING_SIZES.stop - 1}."
        raise UsageError(f"pictures for labelling cannot be {size} pixels wide", remedy=remedy)


class _PictureSeries:
    """Pictures of one subject, taken one by one until every hull is numbered."""

    def __init__(self, canvas: LabelingCanvas) -> None:
        self._canvas, self._subject = canvas, canvas.subject
        self._pictures: list[LabelingPicture] = []
        self._clear: dict[int, int] = {}
        """How many pixels show each hull that is numbered, at best."""

    def run(self, most: int) -> list[LabelingPicture]:
        whole = Arrangement.in_place(self._subject)
        wanted = list(self._subject.wanted)
        quality = {
            view: whole.preview(view, self._aspect).quality(self._least_share)[wanted] for view in VIEW_PREFERENCES
        }
        for view in choose_views(quality, most):
            self._keep(self._canvas.draw(whole, view))
        self._show_poor(most)
        self._show_left()
        return self._pictures

    def _show_poor(self, most: int) -> None:
        """Takes pictures, `most` in all, that show hulls well of which little is seen so far, while that helps."""
        while len(self._pictures) < most and (poor := self._below(_POOR_PIXELS)):
            picture = self._draw_close_up(poor)
            if not any(pixels >= _POOR_PIXELS for pixels in self._pixels_of_numbered(picture, poor)):
                break
            self._keep(picture)

    def _show_left(self) -> None:
        lost: set[int] = set()
        while left := [k for k in self._subject.wanted if k not in self._clear and k not in lost]:
            picture = self._draw_close_up(left)
            if not self._pixels_of_numbered(picture, left):
                choice = [(isolate_hull(self._subject, left[0]), 1.0)]
                picture = self._canvas.draw(*choose_best(choice, left[:1], self._least_share, self._aspect))
                lost.add(left[0])
            self._keep(picture)

    def _draw_close_up(self, left: list[int]) -> LabelingPicture:
        return self._canvas.draw(
            *choose_best(list(propose_arrangements(self._subject, left)), left, self._least_share, self._aspect)
        )

    def _below(self, enough: int) -> list[int]:
        return [k for k in self._subject.wanted if self._clear.get(k, 0) < enough]

    def _pixels_of_numbered(self, picture: LabelingPicture, hulls: Iterable[int]) -> list[int]:
        names = (self._subject.mesh.hulls[k].name for k in hulls)
        return [picture.visible_pixels[name] for name in names if name in picture.numbered]

    def _keep(self, picture: LabelingPicture) -> None:
        self._pictures.append(picture)
        for name in picture.numbered:
            k = self._subject.mesh.index[name]
            self._clear[k] = max(self._clear.get(k, 0), picture.visible_pixels[name])

    @property
    def _aspect(self) -> float:
        width, height = self._canvas.drawing_size
        return height / width

    @property
    def _least_share(self) -> float:
        """The share of a picture from which on a hull is likely to be numbered, as far as a preview can tell."""
        width, height = self._canvas.drawing_size
        return max(2 * LEAST_PIXELS / (width * height), _PREVIEW_PIXELS / (PREVIEW_SIZE**2 * self._aspect))


def propose_arrangements(subject: LabelingSubject, left: Sequence[int]) -> Iterator[tuple[Arrangement, float]]:
    """Yield ways to show hulls that are left, and how much each is liked."""
    group = tuple(_group_near(subject, left))
    near = _close_up_frame(subject, group)
    every = tuple(range(len(subject.render_meshes)))
    if near is not None:
        yield Arrangement(subject, every, near, close=group), 1.0
        yield Arrangement(subject, group, near, close=group), _FEW
    if near is None or len(group) < len(left):
        yield Arrangement(subject, tuple(left), subject.points), _FEW
    if len(every) > 1:
        yield Arrangement.explode(subject, _PUSH), _EXPLODED


def isolate_hull(subject: LabelingSubject, hull: int) -> Arrangement:
    """Return one hull, as large as a picture can hold it."""
    frame = subject.points_of([hull])
    small = Aabb.of_points(frame).diagonal < _CLOSE * subject.diagonal
    return Arrangement(subject, (hull,), frame, close=(hull,) if small else ())


def choose_best(
    choices: Sequence[tuple[Arrangement, float]], left: Sequence[int], least: float, shape: float
) -> tuple[Arrangement, View]:
    """Return the arrangement, and the view of it, that shows hulls best that are left."""
    values: list[tuple[float, int, View]] = []
    for k, (arrangement, liked) in enumerate(choices):
        for view in VIEW_PREFERENCES:
            quality = arrangement.preview(view, shape).quality(least)[list(left)]
            value = (quality > 0).sum() + quality.sum()  # that a hull is seen at all is half of what there is to gain
            values.append((float(value) * liked * VIEW_PREFERENCES[view], k, view))
    _, k, view = max(values, key=lambda row: row[0])
    return choices[k][0], view


def _group_near(subject: LabelingSubject, left: Sequence[int]) -> list[int]:
    low, high = (corner[list(left)] for corner in subject.mesh.corners)
    found = np.zeros(len(left), bool)
    fresh = found.copy()
    fresh[0] = True
    while fresh.any():
        found |= fresh
        gaps = np.maximum(low[:, None] - high[None, found], low[None, found] - high[:, None]).max(axis=2)
        fresh = ~found & (gaps.min(axis=1) < _NEAR * subject.diagonal)
    return [k for k, one in zip(left, found, strict=True) if one]


def _close_up_frame(subject: LabelingSubject, hulls: Sequence[int]) -> Floats | None:
    """The corners (8, 3) of what is seen of hulls and about them from close up; None if that is nearly all."""
    box = Aabb.of_points(subject.points_of(hulls))
    room = _ROOM * box.diagonal / 2
    whole = Aabb.of_points(subject.points)
    seen = Aabb(np.maximum(box.min - room, whole.min), np.minimum(box.max + room, whole.max))
    return seen.corners if 0 < seen.diagonal < _CLOSE * whole.diagonal else None
