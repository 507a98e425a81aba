"""Labels out of segmented points and meshes: what the classes of other tools and datasets mean in the vocabulary of a
project, and each hull as what most of the points are that it holds."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from meshforge.common import AssetError, GeometryError, join_names, pluralize, suggest_aside
from meshforge.formats import (
    PointAlignment,
    PointSamples,
    Segmentation,
    align_points,
    attach_own_mesh,
    class_files,
    find_class_names,
    read_segmentation,
    samples_of_faces,
    samples_of_points,
)
from meshforge.geometry import Aabb, Floats
from meshforge.labels.from_files import segments
from meshforge.labels.names.label_by_names import NamePattern, find_pattern
from meshforge.labels.names.words import match_label
from meshforge.symbolic import Label, SymbolicMesh

VOCABULARY = "vocabulary"
"""What is given in place of names of classes where they are the vocabulary, in its order."""


@dataclass(frozen=True, slots=True)
class ClassMeaning:
    """label: the label that a class means, None for one that is to be left out; sure: how surely it means that."""

    label: str | None
    sure: float = 1.0


def meaning_of(name: str, vocabulary: Sequence[str], patterns: Sequence[NamePattern] = ()) -> ClassMeaning | None:
    """What a class means: by a pattern, else the label of its name, else the one whose words are in it; None: nothing.

    `rotation_door` means `door`; words that are only nearly those of a label do not count.
    """
    if pattern := find_pattern(name, patterns):
        return ClassMeaning(pattern.label or None)
    if name in vocabulary:
        return ClassMeaning(name)
    one = match_label(name, vocabulary)
    return ClassMeaning(one.label, one.confidence) if one and one.exact else None


def class_names_of(
    found: Segmentation, path: Path, given: Sequence[str], vocabulary: Sequence[str]
) -> Mapping[int, str]:
    """The names of the classes that occur, by their number; given: those of 0, 1, ..., or `vocabulary` alone.

    Raises AssetError where a class has none.
    """
    names = find_class_names(found, path, vocabulary if tuple(given) == (VOCABULARY,) else given)
    kinds = [int(k) for k in np.unique(found.classes) if k >= 0]
    bare = [str(number) for number in kinds if not names.get(number)]
    if bare:
        raise AssetError(
            f"class {join_names(bare)} has no name" if names else "its classes are numbers, and nothing names them",
            where=str(path),
            remedy="Name them in order: --classes drawer,handle,leg, or --classes vocabulary where they are those of "
            f"the vocabulary; or put them beside it, a name a line, in {class_files(path)[0].name} or classes.txt.",
        )
    return {number: names[number] for number in kinds}


def class_names_in_file(path: Path, given: Sequence[str]) -> list[str]:
    """The names of the classes in a file, in their order. Raises AssetError."""
    names = class_names_of(read_segmentation(path), path, given, ())
    return list(dict.fromkeys(names[number] for number in sorted(names)))


@dataclass(frozen=True, slots=True)
class FileLabels:
    """labels, names: by hull, its label and what the file itself calls it; problems: a sentence on each left out."""

    labels: Mapping[str, Label] = field(default_factory=dict)
    names: Mapping[str, str] = field(default_factory=dict)
    problems: Sequence[str] = ()


def describe_unknown_class(name: str, hulls: int, vocabulary: Sequence[str]) -> str:
    """The sentence on a name that means nothing in a vocabulary."""
    return (
        f"{pluralize(hulls, 'hull')} left out: {name!r} is not in the vocabulary, and no pattern says what "
        f"it means{suggest_aside(name, vocabulary)}"
    )


_HELD = 0.5  # share of points that hulls hold at least, if both are in the same frame
_DIGITS = 3


@dataclass(frozen=True, slots=True)
class PointsOptions:
    """How segmented points are read. classes: the names of classes 0, 1, ..., or `vocabulary` alone where they are
    those of the vocabulary; none where files say them. placing: how points come into the frame of an asset."""

    classes: tuple[str, ...] = ()
    placing: PointAlignment = field(default_factory=PointAlignment)


def label_by_points(
    mesh: SymbolicMesh, path: Path, how: PointsOptions, vocabulary: Sequence[str], patterns: Sequence[NamePattern]
) -> FileLabels:
    """What a file says of the hulls of an asset.

    Raises AssetError: it cannot be read, does not lie where the asset does, or says classes that have no names.
    """
    found, asset = read_segmentation(path), mesh.asset
    if found.vertices is None:
        found = attach_own_mesh(found, asset.path if asset else path, str(path))
    names = class_names_of(found, path, how.classes, vocabulary)
    meanings = {number: meaning_of(name, vocabulary, patterns) for number, name in names.items()}
    codes = _merge_codes(names, meanings)
    kinds, places = np.unique(found.classes, return_inverse=True)
    own = np.array([codes.get(int(k), -1) for k in kinds])[places.reshape(-1)]
    samples = _sample(replace(found, classes=own), mesh, path, how.placing)
    said = segments.vote_by_points([hull.shape for hull in mesh.hulls], samples)
    _refuse_points_outside(said, path, how.placing)
    return _to_file_labels(
        mesh, said, {code: (names[k], meanings[k]) for k, code in reversed(codes.items())}, vocabulary
    )


def _merge_codes(names: Mapping[int, str], meanings: Mapping[int, ClassMeaning | None]) -> dict[int, int]:
    """The first class that means the same as each class; classes that mean nothing stay apart by their names."""
    firsts: dict[object, int] = {}
    key = {k: meaning.label if meaning else ("", names[k]) for k, meaning in meanings.items()}
    return {k: firsts.setdefault(key[k], k) for k in names}


def _sample(found: Segmentation, mesh: SymbolicMesh, path: Path, placing: PointAlignment) -> PointSamples:
    """Points with classes in the frame of the asset."""
    assert found.vertices is not None  # those of the asset's own mesh were found
    try:
        vertices = _align(found.vertices, mesh, placing)
    except GeometryError as error:
        raise AssetError(error.problem, where=str(path), remedy=error.remedy) from error
    if len(found.faces):
        return samples_of_faces(vertices, found.faces, found.classes, each=found.of_faces)
    return samples_of_points(vertices, found.classes)


def _align(points: Floats, mesh: SymbolicMesh, placing: PointAlignment) -> Floats:
    """The points where the hulls are, or else where is what the asset shows, of which hulls may be only a part."""
    box, up = mesh.aabb, mesh.asset.up if mesh.asset else None
    if box is None:
        return points
    try:
        return align_points(points, [box], placing, up)
    except GeometryError:
        shown = _visual_box(mesh)
        if shown is None:
            raise
        return align_points(points, [box, shown], placing, up)


def _visual_box(mesh: SymbolicMesh) -> Aabb | None:
    """The box around all that an asset shows, None where that is nothing."""
    surfaces = mesh.asset.visuals if mesh.asset else ()
    corners = [surface.vertices[surface.faces].reshape(-1, 3) for surface in surfaces if len(surface.faces)]
    box = Aabb.of_points(np.concatenate(corners)) if corners else None
    return box if box and box.diagonal > 0 else None


def _refuse_points_outside(said: segments.HullVotes, path: Path, placing: PointAlignment) -> None:
    """Raise AssetError where most points are in no hull, unless they are to be taken as they are."""
    if placing.align != "off" and said.of_hulls and said.held < _HELD:
        problem = f"only {said.held:.0%} of its points are in hulls: it may be turned, or of another asset"
        remedy = "If it is right, and only part of the asset has hulls, say --align off."
        raise AssetError(problem, where=str(path), remedy=remedy)


def _to_file_labels(
    mesh: SymbolicMesh,
    said: segments.HullVotes,
    known: Mapping[int, tuple[str, ClassMeaning | None]],
    vocabulary: Sequence[str],
) -> FileLabels:
    labels, names, odd = dict[str, Label](), dict[str, str](), Counter[str]()
    for hull, vote in zip(mesh.hulls, said.of_hulls, strict=True):
        name, meaning = known.get(vote.kind, ("", ClassMeaning(None))) if vote else ("", ClassMeaning(None))
        names[hull.name] = name
        if meaning is None:
            odd[name] += 1
        elif meaning.label and vote:
            labels[hull.name] = Label(meaning.label, round(vote.confidence * meaning.sure, _DIGITS), "file")
    return FileLabels(labels, names, [describe_unknown_class(name, count, vocabulary) for name, count in odd.items()])
