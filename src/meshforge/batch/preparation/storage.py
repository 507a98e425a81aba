"""The folder of a preparation: what was done as JSON, and the hulls it made as an OBJ that every viewer opens."""

import codecs
import json
import os
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from errno import EISDIR
from pathlib import Path
from typing import Any

import numpy as np

from meshforge import formats, geometry, symbolic
from meshforge.batch.preparation.record import Preparation, PreparationStep, apply_preparation, hull_digest
from meshforge.batch.provenance import content_digest
from meshforge.common import AssetError, first_validation_error, write_atomically

RECORD_FILE = "preparation.json"
"""The file in a preparation's folder that says what was done."""
_HULLS = "hulls.obj"
_FORMER = "selections.json"  # what versions before wrote beside them


@dataclass(frozen=True, slots=True)
class _Record:
    """The contents of that file."""

    steps: tuple[PreparationStep, ...]


def read_prepared(path: Path, folder: Path | None) -> symbolic.Asset:
    """Return the asset in a file, after the preparation in a folder where there is one.

    Raises AssetError: the asset cannot be read, or its preparation is damaged or out of date.
    """
    asset = formats.read(path)
    return prepare_from_folder(asset, folder) if folder else asset


def prepare_from_folder(asset: symbolic.Asset, folder: Path) -> symbolic.Asset:
    """Return an asset as it was read, after the preparation in a folder. Raises AssetError: damaged or outdated."""
    preparation = read_preparation(folder)
    return apply_preparation(asset, preparation) if preparation else asset


def read_preparation(folder: Path) -> Preparation | None:
    """Return the preparation in a folder, None where there is none. Raises AssetError where it is damaged."""
    steps = read_steps(folder)
    if steps is None:
        return None
    hulls = _read_hulls(folder / _HULLS) if steps else {}
    found = Preparation(steps, hulls)
    for name, known in found.hull_digests.items():
        if known not in hulls:
            raise _damage_error(folder / _HULLS, f"the hull {name} is not in it as it was made")
    return found.with_only(steps)


def read_steps(folder: Path) -> tuple[PreparationStep, ...] | None:
    """Return what was done, without the hulls, None where nothing was. Raises AssetError where that is damaged."""
    path = folder / RECORD_FILE
    try:
        return _read_record(path)
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError as error:
        raise _file_error(path, error) from error


def record_digest(folder: Path) -> str | None:
    """Return the digest of what was done, hulls included, None where nothing was; empty where it cannot be read."""
    try:
        return content_digest(folder / RECORD_FILE)
    except (FileNotFoundError, NotADirectoryError):
        return None
    except OSError:
        return ""


def write_preparation(folder: Path, preparation: Preparation) -> None:
    """Write a preparation, without any step remove it; killed meanwhile, the one before or this one is there.

    Raises AssetError where something else stands in the place of its files.
    """
    for path, content in list_preparation_writes(folder, preparation):
        if content is None:
            path.unlink(missing_ok=True)
        else:
            write_atomically(path, content)
    if folder.is_dir() and not any(folder.iterdir()):
        folder.rmdir()


def list_preparation_writes(folder: Path, preparation: Preparation) -> list[tuple[Path, bytes | None]]:
    """Return the contents to write to files, in this order, so that a preparation takes the place of the one in a
    folder; None removes a file. Raises AssetError as `write_preparation` does.

    The hulls of both are in the file while what was done is exchanged, so that hulls are never missed.
    """
    path, hulls = folder / RECORD_FILE, folder / _HULLS
    for file in (path, hulls):
        if file.is_dir():
            raise _file_error(file, IsADirectoryError(EISDIR, os.strerror(EISDIR)))
    if not preparation.steps:
        return [(file, None) for file in (path, hulls, folder / _FORMER) if file.exists()]
    try:
        before = read_preparation(folder) or Preparation()
    except AssetError:
        before = Preparation()
    own = [(name, preparation.hulls[known]) for name, known in preparation.hull_digests.items()]
    old = [(f"{n}@before", before.hulls[k]) for n, k in before.hull_digests.items() if k not in preparation.hulls]
    record = json.dumps(asdict(_Record(preparation.steps)), ensure_ascii=False, indent=2) + "\n"
    writes: list[tuple[Path, bytes | None]] = [(hulls, _format_hulls([*own, *old])), (path, record.encode())]
    return [*writes, (hulls, _format_hulls(own))] if old else writes


def _read_record(path: Path) -> tuple[PreparationStep, ...]:
    """The steps in a record. Raises OSError, and AssetError where it is damaged."""
    content = path.read_bytes().removeprefix(codecs.BOM_UTF8)
    content = content.replace(b'"told": ', b'"remark": ')  # as earlier versions called it
    from pydantic import TypeAdapter, ValidationError  # lazy: 0.1 s, only preparations need it

    try:
        return TypeAdapter(_Record).validate_json(content).steps
    except ValidationError as error:
        raise _damage_error(path, first_validation_error(error)) from error


def _read_hulls(path: Path) -> dict[str, geometry.Polytope]:
    try:
        surfaces = formats.read_triangles(path)
    except AssetError as error:
        raise _damage_error(path, error.problem) from error
    found = {}
    for surface in surfaces:
        used, local = np.unique(surface.faces, return_inverse=True)
        hull = geometry.Polytope(surface.vertices[used], local.reshape(-1, 3))
        found[hull_digest(hull)] = hull
    return found


def _format_hulls(hulls: Iterable[tuple[str, geometry.Polytope]]) -> bytes:
    return formats.format_obj(
        [formats.MeshPart(name, symbolic.Surface(hull.vertices, hull.faces)) for name, hull in hulls]
    )


def _damage_error(path: Path, problem: Any) -> AssetError:
    remedy = "Bring the file back as it was, or take the preparation away: meshforge prepare --remove"
    return AssetError(f"this preparation is damaged: {problem}", where=str(path), remedy=remedy)


def _file_error(path: Path, error: OSError) -> AssetError:
    problem = f"this is no file of a preparation that can be read or replaced: {error.strerror}"
    return AssetError(problem, where=str(path), remedy="Take away by hand what stands there.")
