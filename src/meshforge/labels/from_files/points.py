"""Labels out of segmented points: each hull is what most of the points are that it holds."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from meshforge.common import AssetError, join_names
from meshforge.formats import AlignMode, align_points, read_segmentation
from meshforge.geometry import Aabb, Floats, Ints, Shape
from meshforge.labels.from_files.base import FileLabels, Meaning, meaning_of, to_file_labels
from meshforge.labels.names.label_by_names import NamePattern
from meshforge.symbolic import SymbolicMesh

VOCABULARY = "vocabulary"
"""What is given in place of names of classes where they are the vocabulary, in its order."""
_UNLABELLED: Meaning = (None, 1.0)
_LEAST = 0.5  # share of points that hulls hold at least, if both are in the same frame
_COVERED = 0.005  # of the diagonal: a point on the surface of what was decomposed is held though it sticks out so far
_NEAR = 0.02  # of the diagonal: how far from a hull that holds none points may be and still say something
_SURE_OF_NEAR = 0.4
_PRIOR_WEIGHT = 2.0  # points of other classes that might have been there
_ROUNDED = 6  # digits by which planes of one flat side are told to be the same


def read_class_names(path: Path, given: Sequence[str]) -> list[str]:
    """Return the names of the classes in a file, in their order. Raises AssetError."""
    found = read_segmentation(path)
    names = _require_names(found.classes, found.class_names(given), path)
    return list(dict.fromkeys(names[number] for number in sorted(names)))


def _require_names(classes: Ints, names: Mapping[int, str], path: Path) -> dict[int, str]:
    """The names of the classes that occur, by their number. Raises AssetError where a class has none."""
    kinds = [int(k) for k in np.unique(classes) if k >= 0]
    bare = [str(number) for number in kinds if number not in names]
    if bare:
        raise AssetError(
            f"class {join_names(bare)} has no name" if names else "its classes are numbers, and nothing names them",
            where=str(path),
            remedy="Name them in order: --classes drawer,handle,leg, or --classes vocabulary where they are those of "
            "the vocabulary; or put `names` into the .npz file.",
        )
    return {number: names[number] for number in kinds}


def label_by_points(
    mesh: SymbolicMesh,
    path: Path,
    classes: Sequence[str],
    align: AlignMode,
    vocabulary: Sequence[str],
    patterns: Sequence[NamePattern],
) -> FileLabels:
    """Return what a file says of the hulls of an asset; classes: the names of classes 0, 1, ..., or `vocabulary` alone.

    Raises AssetError: it cannot be read, does not lie where the asset does, or says classes that have no names.
    """
    found = read_segmentation(path)
    given = vocabulary if tuple(classes) == (VOCABULARY,) else classes
    names = _require_names(found.classes, found.class_names(given), path)
    meanings = {number: meaning_of(name, vocabulary, patterns) for number, name in names.items()}
    firsts: dict[object, int] = {}  # the first of the classes that mean the same; those that mean nothing stay apart
    codes = {k: firsts.setdefault(of[0] if of else ("", names[k]), k) for k, of in meanings.items()}
    boxes = [Aabb.union(hull.shape.aabb for hull in mesh.hulls)] if mesh.hulls else []
    shown = [one.vertices[one.faces].reshape(-1, 3) for one in (mesh.asset.visuals if mesh.asset else ())]
    if boxes and any(map(len, shown)):  # points may be of all that the asset shows, and hulls of a part of it
        boxes += [box for box in [Aabb.of_points(np.concatenate(shown))] if box.diagonal > 0]
    up = mesh.asset.up if mesh.asset else None
    points = align_points(found.points, boxes, align, str(path), up) if boxes else found.points
    own = np.array([codes.get(k, -1) for k in found.classes.tolist()])
    votes, covered = vote_by_points([hull.shape for hull in mesh.hulls], points, own)
    if align != "off" and votes and covered < _LEAST:
        problem = f"only {covered:.0%} of its points are in hulls: it may be turned, or of another asset"
        remedy = "If it is right, and only part of the asset has hulls, say --align off."
        raise AssetError(problem, where=str(path), remedy=remedy)
    rows = {
        hull.name: (names.get(vote[0], ""), meanings.get(vote[0], _UNLABELLED), vote[1])
        for hull, vote in zip(mesh.hulls, votes, strict=True)
    }
    return to_file_labels(rows, vocabulary)


def vote_by_points(hulls: Sequence[Shape], points: Floats, classes: Ints) -> tuple[list[tuple[int, float]], float]:
    """Return the class of each hull by the points (n, 3) in it, else by those near it, which is much less sure, with
    its confidence; and the share of points that hulls hold.

    classes: (n,); -1, of points and of hulls, is none. Of classes with as many points the lowest counts.
    """
    reach = Aabb.union(hull.aabb for hull in hulls).diagonal if hulls else 0.0
    found, covered = list[tuple[int, float]](), np.zeros(len(points), dtype=bool)
    for hull in hulls:
        near = np.flatnonzero(
            ((points >= hull.aabb.min - _NEAR * reach) & (points <= hull.aabb.max + _NEAR * reach)).all(axis=1)
        )
        gaps = _distances_outside(hull, points[near])
        covered[near[gaps <= _NEAR * reach]] = True
        within = _find_majority(classes[near[gaps <= _COVERED * reach]], 1.0)
        found.append(within or _find_majority(classes[near[gaps <= _NEAR * reach]], _SURE_OF_NEAR) or (-1, 0.0))
    return found, float(covered.mean()) if len(covered) else 0.0


def _find_majority(classes: Ints, trust: float) -> tuple[int, float] | None:
    if not len(classes):
        return None
    kinds, counts = np.unique(classes, return_counts=True)
    best = int(counts.argmax())
    return int(kinds[best]), trust * float(counts[best]) / (len(classes) + _PRIOR_WEIGHT)


def _distances_outside(hull: Shape, points: Floats) -> Floats:
    """How far (n,) points (n, 3) are outside the planes of a hull [m], below zero within; at edges somewhat less."""
    corners = hull.vertices[hull.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    normals = normals[lengths > 0] / lengths[lengths > 0, None]
    gaps = np.full(len(points), -np.inf)
    for normal in normals[np.unique(normals.round(_ROUNDED), axis=0, return_index=True)[1]]:
        gaps = np.maximum(gaps, points @ normal - float(hull.support(normal) @ normal))
    return gaps
