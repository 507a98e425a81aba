"""The names of the classes in a file of segmented points: as somebody gives them, in the file, or in one beside it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from meshforge.errors import AssetError
from meshforge.formats.segmented import Segmented, read_classes, read_segmented
from meshforge.words import listed

VOCABULARY = "vocabulary"
"""What is given in place of names of classes where they are the vocabulary, in its order."""


def names_of_classes(
    found: Segmented, path: Path, given: Sequence[str], vocabulary: Sequence[str]
) -> Mapping[int, str]:
    """The names of the classes that occur, by their number; given: those of 0, 1, ..., or `vocabulary` alone.

    Raises AssetError where a class has none.
    """
    names = dict(enumerate(vocabulary if tuple(given) == (VOCABULARY,) else given)) or found.names or _beside(path)
    kinds = [int(k) for k in np.unique(found.classes) if k >= 0]
    bare = [str(number) for number in kinds if not names.get(number)]
    if bare:
        problem = f"class {listed(bare)} has no name" if names else "its classes are numbers, and nothing names them"
        raise AssetError(
            problem,
            where=str(path),
            remedy="Name them in order: --classes drawer,handle,leg, or --classes vocabulary where they are those of "
            f"the vocabulary; or put them beside it, a name a line, in {_places(path)[0].name} or classes.txt.",
        )
    return {number: names[number] for number in kinds}


def classes_said(path: Path, given: Sequence[str]) -> list[str]:
    """The names of the classes in a file, in their order. Raises AssetError."""
    names = names_of_classes(read_segmented(path), path, given, ())
    return list(dict.fromkeys(names[number] for number in sorted(names)))


def _beside(path: Path) -> dict[int, str]:
    file = next((place for place in _places(path) if place.is_file()), None)
    return read_classes(file) if file else {}


def _places(path: Path) -> tuple[Path, Path]:
    return path.with_name(f"{path.stem.removesuffix('.points')}.classes.txt"), path.with_name("classes.txt")
