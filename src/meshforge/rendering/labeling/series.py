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

_PREVIEW_PIXELS = 2.5  # pixels of a preview: fewer tell little

_NEAR = 0.12  # hulls this near the first, as a share of the diagonal, can share a picture from close up
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
    Raises UsageError for hulls that are not there.
    """
    names = mesh.index
    picked = names if hulls is None else hulls
    if unknown := sorted(set(picked) - set(names)):
        raise UsageError(f"there is no hull {unknown[0]!r}", remedy=suggest_name(unknown[0], names))
    numbers = picked if isinstance(picked, Mapping) else names
    wanted = {k: numbers[name] for name, k in names.items() if name in set(picked)}
    subject = LabelingSubject(mesh, wanted, up_axis(mesh, up))
    return tuple(_PictureSeries(LabelingCanvas(subject, size)).run(most)) if picked else ()


class _PictureSeries:
    """Pictures of one subject, taken one by one until every hull is numbered."""

    def __init__(self, canvas: LabelingCanvas) -> None:
        self._canvas, self._subject = canvas, canvas.subject
        width, height = canvas.drawing_size
        self._aspect = height / width
        self._least = max(2 * LEAST_PIXELS / (width * height), _PREVIEW_PIXELS / (PREVIEW_SIZE**2 * self._aspect))
        """The share of a picture from which on a hull is likely to be numbered, as far as a preview can tell."""

    def run(self, most: int) -> list[LabelingPicture]:
        """Take the most telling views of the whole, then what shows the hulls that have no number yet."""
        subject, whole, wanted = self._subject, Arrangement.in_place(self._subject), list(self._subject.wanted)
        quality = {view: self._measure(whole, view)[wanted] for view in VIEW_PREFERENCES}
        pictures = [self._canvas.draw(whole, view) for view in choose_views(quality, most)]
        done = frozenset[str]().union(*(picture.numbered for picture in pictures))
        while left := [k for k in wanted if subject.mesh.hulls[k].name not in done]:
            picture = self._draw_best(propose_arrangements(subject, left), left)
            if done.issuperset(picture.numbered):
                alone = Arrangement(subject, (left[0],), subject.points_of(left[:1]), (left[0],))
                picture = self._draw_best([(alone, 1.0)], left[:1])
                done |= {subject.mesh.hulls[left[0]].name}
            pictures.append(picture)
            done |= picture.numbered
        return pictures

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


def propose_arrangements(subject: LabelingSubject, left: Sequence[int]) -> Iterator[tuple[Arrangement, float]]:
    """Yield ways to show hulls that are left, and how much each is liked."""
    whole, (low, high) = Aabb.of_points(subject.points), (corner[list(left)] for corner in subject.mesh.corners)
    gaps = np.maximum(low - high[0], low[0] - high).max(axis=1)  # to the first hull that is left
    group = tuple(k for k, gap in zip(left, gaps, strict=True) if gap < _NEAR * whole.diagonal)
    box = Aabb.of_points(subject.points_of(group))
    room = _ROOM * box.diagonal / 2
    seen = Aabb(np.maximum(box.min - room, whole.min), np.minimum(box.max + room, whole.max))
    is_close = 0 < seen.diagonal < _CLOSE * whole.diagonal
    if is_close:
        yield Arrangement(subject, tuple(range(len(subject.render_meshes))), seen.corners, group), 1.0
        yield Arrangement(subject, group, seen.corners, group), _FEW
    if not is_close or len(group) < len(left):
        yield Arrangement(subject, tuple(left), subject.points), _FEW


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
