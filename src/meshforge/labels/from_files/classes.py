"""The classes of other tools and datasets: their names, and what these mean in the vocabulary of a project."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from meshforge.common import AssetError, join_names, nearest_name, pluralize
from meshforge.formats import Segmentation, read_class_names, read_segmentation
from meshforge.labels.names.hull_names import NamePattern, find_pattern
from meshforge.labels.names.match import match_label
from meshforge.symbolic import Label

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
    names = (
        dict(enumerate(vocabulary if tuple(given) == (VOCABULARY,) else given))
        or found.names
        or _read_classes_beside(path)
    )
    kinds = [int(k) for k in np.unique(found.classes) if k >= 0]
    bare = [str(number) for number in kinds if not names.get(number)]
    if bare:
        problem = (
            f"class {join_names(bare)} has no name" if names else "its classes are numbers, and nothing names them"
        )
        raise AssetError(
            problem,
            where=str(path),
            remedy="Name them in order: --classes drawer,handle,leg, or --classes vocabulary where they are those of "
            f"the vocabulary; or put them beside it, a name a line, in {_class_files(path)[0].name} or classes.txt.",
        )
    return {number: names[number] for number in kinds}


def class_names_in_file(path: Path, given: Sequence[str]) -> list[str]:
    """The names of the classes in a file, in their order. Raises AssetError."""
    names = class_names_of(read_segmentation(path), path, given, ())
    return list(dict.fromkeys(names[number] for number in sorted(names)))


def _read_classes_beside(path: Path) -> dict[int, str]:
    file = next((place for place in _class_files(path) if place.is_file()), None)
    return read_class_names(file) if file else {}


def _class_files(path: Path) -> tuple[Path, Path]:
    return path.with_name(f"{path.stem.removesuffix('.points')}.classes.txt"), path.with_name("classes.txt")


@dataclass(frozen=True, slots=True)
class FileLabels:
    """labels, names: by hull, its label and what the file itself calls it; problems: a sentence on each left out."""

    labels: Mapping[str, Label] = field(default_factory=dict)
    names: Mapping[str, str] = field(default_factory=dict)
    problems: Sequence[str] = ()


def describe_unknown_class(name: str, hulls: int, vocabulary: Sequence[str]) -> str:
    """The sentence on a name that means nothing in a vocabulary."""
    like = nearest_name(name, vocabulary)
    hint = f"; did you mean {like!r}?" if like else ""
    return (
        f"{pluralize(hulls, 'hull')} left out: {name!r} is not in the vocabulary, and no pattern says what "
        f"it means{hint}"
    )
