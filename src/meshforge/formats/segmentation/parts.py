"""The parts of a surface by segmented points or faces: the class of each triangle, as islands that are parts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from meshforge.common import AssetError, GeometryError
from meshforge.formats.segmentation.alignment import PointAlignment, Up, align_points
from meshforge.formats.segmentation.base import Segmentation, find_class_names
from meshforge.formats.segmentation.reader import attach_own_mesh, read_segmentation
from meshforge.formats.segmentation.samples import PointSamples, samples_of_faces, samples_of_points
from meshforge.geometry import Aabb, Floats, Ints, SurfaceParts, separate_parts

REST = "rest"
"""The name of the part of all that has no class."""
_VOTES = 5  # points, the nearest, that say what a place on the surface is: a tenth of them may be wrong
_NEAR = 0.02, 0.1  # of the diagonal: what is farther from all points has no class; the second where these are few
_SPACES = 3.0  # mean distances of points that count as near
_LEAST = 0.5  # of a surface that is near points, and of points that are near the surface
_SAME = 1e-5  # of the diagonal: faces whose middles are no farther apart are the same
_APART = "It may be turned, or of another asset. If it is right, say --align off."
_TOLD = 0.02  # of the surface: what is as good as told to be of another part, or of none


@dataclass(frozen=True, slots=True)
class SegmentationFile:
    """A file of segmented points or faces. classes: the names of classes 0, 1, ..., none where files say them."""

    path: Path
    classes: tuple[str, ...] = ()
    placing: PointAlignment = field(default_factory=PointAlignment)


def read_parts(
    surfaces: Sequence[tuple[Floats, Ints]],
    file: SegmentationFile,
    asset: Path,
    up: Up | None = None,
    note: Callable[[str], None] = lambda _: None,
    beside: Sequence[Aabb] = (),
) -> list[SurfaceParts]:
    """The parts of surfaces, vertices (n, 3) [m] and faces (m, 3) each, by a file about all of them together.

    Each connected patch of a class is a part; what has no class, or is far from all points, is `rest`. asset: the file
    of the surfaces, whose own faces the classes may be of; up: the axis that its format says points up; note: called
    with what a user should know; beside: boxes of more that the points may be of, besides the surfaces, none where they
    are of these alone.
    Raises AssetError: the file cannot be read, or does not lie where the surfaces do.
    """
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in surfaces)])
    vertices = np.concatenate([vertices for vertices, _ in surfaces])
    faces = np.concatenate([own + start for (_, own), start in zip(surfaces, starts, strict=False)])
    own = Aabb.of_points(vertices[faces].reshape(-1, 3))
    found = _align(read_segmentation(file.path), [own, *beside], file, asset, up)
    try:
        kinds, told = _find_kinds(found, vertices, faces, is_checked=file.placing.align != "off", is_part=bool(beside))
    except GeometryError as error:
        raise AssetError(error.problem, where=str(file.path), remedy=error.remedy) from error
    for text in told:
        note(text)
    names = find_class_names(found, file.path, file.classes)
    known, of_face = np.unique(kinds, return_inverse=True)
    called = [REST if k < 0 else names.get(k) or f"part_{k}" for k in known.tolist()]
    parts = separate_parts(vertices, faces, SurfaceParts(of_face.reshape(-1), tuple(called)))
    ends = np.cumsum([len(own) for _, own in surfaces])
    return [parts.select(np.arange(end - len(own), end)) for (_, own), end in zip(surfaces, ends, strict=True)]


def _align(
    found: Segmentation, boxes: Sequence[Aabb], file: SegmentationFile, asset: Path, up: Up | None
) -> Segmentation:
    """The segmentation in the frame of what is in one of some boxes."""
    where = str(file.path)
    if found.vertices is None:
        found = attach_own_mesh(found, asset, where)
    assert found.vertices is not None
    try:
        return replace(found, vertices=align_points(found.vertices, boxes, file.placing, up))
    except GeometryError as error:
        raise AssetError(error.problem, where=where, remedy=error.remedy) from error


def _find_kinds(
    found: Segmentation, vertices: Floats, faces: Ints, *, is_checked: bool, is_part: bool
) -> tuple[Ints, list[str]]:
    """The class of each of faces (m, 3), -1 for none, and sentences on what is not as clear as it could be.

    is_part: the points may be of more than these. Raises GeometryError where they are checked, and points and surface
    lie mostly apart.
    """
    own = samples_of_faces(vertices, faces, np.arange(len(faces)), each=True)
    diagonal = float(np.linalg.norm(np.ptp(own.points, axis=0)))
    said = _to_samples(found)
    total = max(float(own.weights.sum()), np.finfo(float).tiny)
    near = float(np.clip(_SPACES * np.sqrt(total / len(said.points)), *np.multiply(_NEAR, diagonal)))
    kinds, gaps = _vote(own.points, said, 1 if len(found.faces) else _VOTES)
    if is_checked:
        _refuse_bare(own, gaps, near)
        if not is_part:
            _refuse_away(own, said, _NEAR[0] * diagonal)
    kinds[gaps > near] = -1
    of_face, purity = _find_majority(own, kinds, len(faces))
    if found.of_faces:
        same = _match_faces(found, vertices, faces, _SAME * diagonal)
        of_face = np.where(same >= 0, found.classes[same], of_face)
        purity[same >= 0] = 1.0
    told = []
    other = float(((1.0 - purity) * np.bincount(own.classes, own.weights, len(faces))).sum()) / total
    if other >= _TOLD:
        told.append(f"{other:.0%} of the surface is in triangles that are mostly of another part, and goes with it")
    bare = float(own.weights[gaps > near].sum()) / total
    if bare >= _TOLD:
        told.append(f"{bare:.0%} of the surface is far from all labelled points, so it is a part by itself, {REST}")
    return np.maximum(of_face, -1), told


def _to_samples(found: Segmentation) -> PointSamples:
    """Points with classes, in an order that does not depend on that of the file."""
    assert found.vertices is not None
    if len(found.faces):
        return samples_of_faces(found.vertices, found.faces, found.classes, each=found.of_faces)
    order = np.lexsort((found.classes, *found.vertices.T))
    return samples_of_points(found.vertices[order], found.classes[order])


def _vote(places: Floats, said: PointSamples, votes: int) -> tuple[Ints, Floats]:
    """What most of the points nearest to each of some places (n, 3) are, the nearest of classes with as many, and how
    far (n,) the nearest point is [m]."""
    from scipy.spatial import cKDTree  # lazy: slow to import, only segmentations need it

    count = min(votes, len(said.points))
    found, nearest = cKDTree(said.points).query(places, k=np.arange(1, count + 1))
    gaps, kinds = np.asarray(found), said.classes[nearest]
    support = (kinds[:, :, None] == kinds[:, None, :]).sum(axis=2)
    return kinds[np.arange(len(kinds)), support.argmax(axis=1)], gaps[:, 0]


def _refuse_bare(own: PointSamples, gaps: Floats, near: float) -> None:
    """Raise GeometryError where most of the surface is far from all points."""
    covered = float(own.weights[gaps <= near].sum()) / max(float(own.weights.sum()), np.finfo(float).tiny)
    if covered < _LEAST:
        raise GeometryError(f"only {covered:.0%} of the surface has labelled points near it", remedy=_APART)


def _refuse_away(own: PointSamples, said: PointSamples, near: float) -> None:
    """Raise GeometryError where most points are far from the surface."""
    from scipy.spatial import cKDTree  # lazy: as above

    away, _ = cKDTree(own.points).query(said.points)
    on = float(said.weights[away <= near].sum()) / max(float(said.weights.sum()), np.finfo(float).tiny)
    if on < _LEAST:
        raise GeometryError(f"only {on:.0%} of its points are near the surface", remedy=_APART)


def _find_majority(own: PointSamples, kinds: Ints, count: int) -> tuple[Ints, Floats]:
    """The class (count,) of each face that has most of it, the lowest of equal ones, and its share (count,).

    own: places on the surface, whose classes are faces; kinds: the class of each.
    """
    pairs, place = np.unique(np.column_stack([own.classes, kinds]), axis=0, return_inverse=True)
    sizes = np.bincount(place.reshape(-1), own.weights)
    order = np.lexsort((pairs[:, 1], -sizes, pairs[:, 0]))
    firsts = order[np.unique(pairs[order, 0], return_index=True)[1]]
    total = np.bincount(own.classes, own.weights, count)
    share = sizes[firsts] / np.where(total > 0, total, np.inf)
    return pairs[firsts, 1], np.where(total > 0, share, 1.0)


def _match_faces(found: Segmentation, vertices: Floats, faces: Ints, reach: float) -> Ints:
    """The segmented face (m,) that each of faces (m, 3) is, -1 for none."""
    from scipy.spatial import cKDTree  # lazy: as above

    assert found.vertices is not None
    middles = found.vertices[found.faces].mean(axis=1)
    gaps, place = cKDTree(middles).query(vertices[faces].mean(axis=1))
    return np.where(gaps <= reach, place, -1)
