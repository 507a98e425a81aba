"""The input files that a written SDF refers to, by where they go so that they are found from there."""

from __future__ import annotations

import posixpath
from collections.abc import Sequence
from pathlib import Path

from meshforge.errors import AssetError
from meshforge.formats.companions import companions
from meshforge.formats.sdf.files.config import CONFIG
from meshforge.formats.sdf.files.elements import references, root_of
from meshforge.formats.sdf.files.sources import Source
from meshforge.formats.sdf.reading.referred import scripts_of
from meshforge.formats.xml import Text


def copies_of(sources: Sequence[Source], texts: Sequence[bytes], name: str) -> tuple[dict[str, Path], list[str]]:
    """The files, and notes on those that stay where they are; texts: of the sources as they are written; name: of the
    main one, whose `model.config` goes along where that tells of a file of that name.

    Raises AssetError where two of them would become one.
    """
    copies: dict[str, Path] = {}
    notes = []
    for number, (source, text) in enumerate(zip(sources, texts, strict=True)):
        if source.place is None:
            notes.append(f"{source.reference!r} is an absolute reference: the file is used where it is, not copied")
            continue
        folder = posixpath.dirname(source.place)
        config = source.path.parent / CONFIG
        if config.is_file() and (number or source.path.name == name) and not folder.startswith(".."):
            _add(copies, posixpath.join(folder, CONFIG), config)
        for reference, path in _referred(source, text):
            place = source.resolver.place(reference)
            if place is None:
                notes.append(f"{reference!r} is an absolute reference: the file is used where it is, not copied")
                continue
            _add(copies, posixpath.normpath(posixpath.join(folder, place)), path)
            for key, companion in companions(path).items():
                beside = posixpath.join(folder, posixpath.dirname(place), key)
                copies.setdefault(posixpath.normpath(beside), companion)
    return copies, notes


def _referred(source: Source, text: bytes) -> list[tuple[str, Path]]:
    """What a file refers to that is there."""
    root, _ = root_of(Text.of(text).data, str(source.path))
    found = [(reference, source.resolver.find(reference)) for reference in references(root)]
    return [(reference, path) for reference, path in found if path is not None] + list(scripts_of(source))


def _add(copies: dict[str, Path], place: str, path: Path) -> None:
    if copies.setdefault(place, path) != path:
        raise AssetError(
            f"{copies[place]} and {path} would both become {place!r}",
            where=str(path),
            remedy="Rename one of them, or put both under one folder.",
        )
