"""A series of pictures in which each hull of a mesh is seen and numbered at least once, from close up where needed."""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

import numpy as np

from meshforge.common import UsageError, suggest_name
from meshforge.geometry import Aabb, Floats
from meshforge.rendering.camera import Up, View
from meshforge.rendering.labeling.picture import LabelingCanvas, LabelingPicture
from meshforge.rendering.labeling.subject import PREVIEW_SIZE, VIEW_WORDS, Arrangement, LabelingSubject
from meshforge.rendering.picture import up_axis
from meshforge.rendering.placement import LEAST_PIXELS
from meshforge.symbolic import SymbolicMesh

VIEW_PREFERENCES: Mapping[View, float] = {view: 1.0 - 0.015 * k for k, view in enumerate(VIEW_WORDS)}
"""How much each view is liked: one from below must show clearly more to be preferred."""
FIRST_VIEWS: tuple[View, ...] = ("front-right-above", "front-left-above", "back-left-above", "back-right-above")
"""The views that tell best what a thing is, one of which is always drawn."""
_WELL = 1 / 250  # the share of a picture from which on a hull is seen as well as it needs to be

_AGAIN = 0.25  # what a second good view of a hull is worth
_WORTHLESS = 0.05  # a view that adds less than this a hull is not drawn

LABELING_SIZES = range(256, 4097)
_PREVIEW_PIXELS = 2.5  # pixels of a preview: fewer tell little
_POOR_PIXELS = 10 * LEAST_PIXELS  # hulls that show fewer everywhere are drawn from close up, if pictures are left

_NEAR = 0.12  # hulls this near each other, as a share of the diagonal, can share a picture from close up
_ROOM = 1.2  # how much is seen about hulls from close up, as a share of their size
_CLOSE = 0.6  # a picture is from close up if it holds at most this share of the whole
_FEW = 0.85  # what a picture of some hulls only is worth beside one of all in place


def draw_labeling_pictures(
    mesh: SymbolicMesh, *, hulls: Collection[str] | None = None, most: int = 6, size: int = 1024, up: Up | None = None
) -> tuple[LabelingPicture, ...]:
    """Draw views in which each of `hulls`, by default all, is seen and numbered: by a mapping, else by its index.

    At most `most` of them show the mesh as it is, the most telling first; further ones, hulls that these do not show,
    from close up or alone among faint others. Hulls beside `hulls` are pale, without a number. All are orthographic.

    size: pixels along each side; up: the axis that points up, by default that of the mesh. Same input, same pictures.
    Raises UsageError for hulls that are not there, and for an impossible number or size of pictures.
    """
    names = mesh.index
    picked = names if hulls is None else hulls
    _check_arguments(names, picked, most, size)
    numbers = picked if isinstance(picked, Mapping) else names
    wanted = {k: numbers[name] for name, k in names.items() if name in set(picked)}
    subject = LabelingSubject(mesh, wanted, up_axis(mesh, up))
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
        width, height = canvas.drawing_size
        self._aspect = height / width
        self._least = max(2 * LEAST_PIXELS / (width * height), _PREVIEW_PIXELS / (PREVIEW_SIZE**2 * self._aspect))
        """The share of a picture from which on a hull is likely to be numbered, as far as a preview can tell."""
        self._pictures: list[LabelingPicture] = []
        self._clear: dict[int, int] = {}
        """How many pixels show each hull that is numbered, at best."""

    def run(self, most: int) -> list[LabelingPicture]:
        """Take the most telling views of the whole, then what shows hulls that are poorly seen, as long as that helps
        and there are fewer than `most`, then what shows those that have no number yet."""
        whole, wanted = Arrangement.in_place(self._subject), list(self._subject.wanted)
        quality = {view: self._measure(whole, view)[wanted] for view in VIEW_PREFERENCES}
        for view in choose_views(quality, most):
            self._keep(self._canvas.draw(whole, view))
        while len(self._pictures) < most and (poor := [k for k in wanted if self._clear.get(k, 0) < _POOR_PIXELS]):
            picture = self._draw_best(propose_arrangements(self._subject, poor), poor)
            if not any(pixels >= _POOR_PIXELS for pixels in self._pixels_of_numbered(picture, poor)):
                break
            self._keep(picture)
        lost: set[int] = set()
        while left := [k for k in wanted if k not in self._clear and k not in lost]:
            picture = self._draw_best(propose_arrangements(self._subject, left), left)
            if not self._pixels_of_numbered(picture, left):
                picture = self._draw_best([(isolate_hull(self._subject, left[0]), 1.0)], left[:1])
                lost.add(left[0])
            self._keep(picture)
        return self._pictures

    def _measure(self, arrangement: Arrangement, view: View) -> Floats:
        """How well each hull is seen (n,), from 0 to 1, by its share of a picture; not at all below the least."""
        shares = arrangement.preview(view, self._aspect)
        return np.where(shares >= self._least, 0.2 + 0.8 * np.sqrt(np.minimum(shares / _WELL, 1)), 0.0)

    def _draw_best(self, choices: Iterable[tuple[Arrangement, float]], left: Sequence[int]) -> LabelingPicture:
        """The picture of the arrangement, and from the view, that shows hulls best that are left."""
        values: list[tuple[float, Arrangement, View]] = []
        for arrangement, liked in choices:
            for view in VIEW_PREFERENCES:
                quality = self._measure(arrangement, view)[list(left)]
                value = (quality > 0).sum() + quality.sum()  # that a hull is seen at all is half of what can be gained
                values.append((float(value) * liked * VIEW_PREFERENCES[view], arrangement, view))
        _, arrangement, view = max(values, key=lambda row: row[0])
        return self._canvas.draw(arrangement, view)

    def _pixels_of_numbered(self, picture: LabelingPicture, hulls: Iterable[int]) -> list[int]:
        names = (self._subject.mesh.hulls[k].name for k in hulls)
        return [picture.visible_pixels[name] for name in names if name in picture.numbered]

    def _keep(self, picture: LabelingPicture) -> None:
        self._pictures.append(picture)
        for name in picture.numbered:
            k = self._subject.mesh.index[name]
            self._clear[k] = max(self._clear.get(k, 0), picture.visible_pixels[name])


def propose_arrangements(subject: LabelingSubject, left: Sequence[int]) -> Iterator[tuple[Arrangement, float]]:
    """Yield ways to show hulls that are left, and how much each is liked."""
    group = _group_near(subject, left)
    box, whole = Aabb.of_points(subject.points_of(group)), Aabb.of_points(subject.points)
    room = _ROOM * box.diagonal / 2
    seen = Aabb(np.maximum(box.min - room, whole.min), np.minimum(box.max + room, whole.max))
    is_close = 0 < seen.diagonal < _CLOSE * whole.diagonal
    if is_close:
        yield Arrangement(subject, tuple(range(len(subject.render_meshes))), seen.corners, group), 1.0
        yield Arrangement(subject, group, seen.corners, group), _FEW
    if not is_close or len(group) < len(left):
        yield Arrangement(subject, tuple(left), subject.points), _FEW


def isolate_hull(subject: LabelingSubject, hull: int) -> Arrangement:
    """Return one hull, as large as a picture can hold it."""
    frame = subject.points_of([hull])
    small = Aabb.of_points(frame).diagonal < _CLOSE * subject.diagonal
    return Arrangement(subject, (hull,), frame, close=(hull,) if small else ())


def _group_near(subject: LabelingSubject, left: Sequence[int]) -> tuple[int, ...]:
    """The first hull that is left, and those that are near it, from one to the next."""
    low, high = (corner[list(left)] for corner in subject.mesh.corners)
    found = np.zeros(len(left), bool)
    fresh = found.copy()
    fresh[0] = True
    while fresh.any():
        found |= fresh
        gaps = np.maximum(low[:, None] - high[None, found], low[None, found] - high[:, None]).max(axis=2)
        fresh = ~found & (gaps.min(axis=1) < _NEAR * subject.diagonal)
    return tuple(k for k, one in zip(left, found, strict=True) if one)


def choose_views(quality: Mapping[View, Floats], most: int) -> list[View]:
    """Return so many views at most, the most telling first; quality: how well each shows each hull (n,), 0 to 1."""
    taken: list[View] = []
    while len(taken) < min(most, len(quality)):
        before = _value_of(taken, quality)
        gains = {view: _value_of([*taken, view], quality) - before for view in quality if view not in taken}
        best = max(gains if taken else FIRST_VIEWS, key=lambda view: gains[view] * VIEW_PREFERENCES[view])
        if taken and gains[best] <= _WORTHLESS * len(quality[best]):
            break
        taken.append(best)
    return taken


def _value_of(views: Sequence[View], quality: Mapping[View, Floats]) -> float:
    if not views:
        return 0.0
    ranked = np.sort([quality[view] for view in views], axis=0)[::-1]
    return float(ranked[0].sum() + _AGAIN * ranked[1:2].sum())
