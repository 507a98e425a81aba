"""The files that an SDF and what it includes refer to."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from meshforge.formats.companions import companions
from meshforge.formats.sdf.files.config import CONFIG
from meshforge.formats.sdf.files.elements import references, root_of, script_folders
from meshforge.formats.sdf.files.sources import Source

_MOST = 1000  # files of one folder of material scripts


def files_of(sources: Sequence[Source]) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """The included and referenced files that are there, with their companions, and the references that lead nowhere."""
    files: dict[Path, None] = {}
    missing: dict[str, None] = {}
    for number, source in enumerate(sources):
        if number:
            files[source.path] = None
        if (config := source.path.parent / CONFIG).is_file():
            files[config] = None
        root, _ = root_of(source.text.data, str(source.path))
        for reference in references(root):
            path = source.resolver.find(reference)
            if path is None:
                missing[reference] = None
            else:
                files |= dict.fromkeys([path, *companions(path).values()])
        files |= dict.fromkeys(path for _, path in scripts_of(source))
    return tuple(files), tuple(missing)


def scripts_of(source: Source) -> Iterator[tuple[str, Path]]:
    """The files of material scripts: how a file refers to each, and where it is."""
    root, _ = root_of(source.text.data, str(source.path))
    for reference in script_folders(root):
        if (path := source.resolver.find(reference)) is not None:
            yield reference, path
            continue
        folder = next((path for path in source.resolver.candidates(reference) if path.is_dir()), None)
        if folder is not None:
            inside = sorted(path for path in folder.iterdir() if path.is_file())
            yield from ((f"{reference.rstrip('/')}/{path.name}", path) for path in inside[:_MOST])
