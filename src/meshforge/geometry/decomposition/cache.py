"""Results of decompositions, kept on disk by content: one file each, written whole or not at all."""

from __future__ import annotations

import hashlib
import io
import json
import os
import zipfile
from collections.abc import Mapping
from importlib.metadata import version
from pathlib import Path

import numpy as np

from meshforge.common import write_atomically
from meshforge.geometry.arrays import Floats, Ints
from meshforge.geometry.decomposition.settings import DecomposeSettings
from meshforge.geometry.decomposition.triangles import TriangleMesh

EnginePiece = tuple[Floats, Ints]
"""Vertices (n, 3) and triangles (m, 3) of one piece, as the engine gave them."""

_CHECKSUM_SIZE = 16  # bytes


def cache_folder(environment: Mapping[str, str] = os.environ) -> Path:
    """Where results are usually kept: `MESHFORGE_CACHE`, else `XDG_CACHE_HOME/meshforge`, else `~/.cache/meshforge`."""
    if own := environment.get("MESHFORGE_CACHE"):
        return Path(own)
    base = environment.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path.home() / ".cache") / "meshforge"


def cache_key(mesh: TriangleMesh, settings: DecomposeSettings) -> str:
    """A digest of geometry, settings, engine and its version."""
    wheel = version(settings.package)
    told = json.dumps([settings.engine, wheel, settings.as_dict(), mesh.vertices.shape], sort_keys=True)
    content = told.encode() + mesh.vertices.tobytes() + mesh.faces.tobytes()
    return hashlib.blake2b(content, digest_size=20).hexdigest()


def read_entry(folder: Path, key: str) -> list[EnginePiece] | None:
    """The pieces kept under a key; None where there is no entry, or one that is damaged."""
    try:
        content = (folder / "decompositions" / f"{key}.npz").read_bytes()
        return (
            unpack_pieces(content[:-_CHECKSUM_SIZE])
            if content[-_CHECKSUM_SIZE:] == _checksum(content[:-_CHECKSUM_SIZE])
            else None
        )
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None


def write_entry(folder: Path, key: str, pieces: list[EnginePiece]) -> None:
    """Keep pieces under a key. Raises OSError where the folder cannot be written."""
    content = pack_pieces(pieces)
    write_atomically(folder / "decompositions" / f"{key}.npz", content + _checksum(content))


def _checksum(content: bytes) -> bytes:
    """What an entry ends with, so that any damage to it is noticed."""
    return hashlib.blake2b(content, digest_size=_CHECKSUM_SIZE).digest()


def pack_pieces(pieces: list[EnginePiece]) -> bytes:
    """The pieces as the content of an `.npz`."""
    buffer = io.BytesIO()
    np.savez_compressed(
        buffer,
        vertices=np.concatenate([v for v, _ in pieces] or [np.zeros((0, 3))]),
        faces=np.concatenate([f for _, f in pieces] or [np.zeros((0, 3), np.int64)]),
        counts=np.array([[len(v), len(f)] for v, f in pieces], dtype=np.int64).reshape(-1, 2),
    )
    return buffer.getvalue()


def unpack_pieces(content: bytes) -> list[EnginePiece]:
    """The pieces of `pack_pieces`. Raises ValueError, KeyError, EOFError or BadZipFile for anything else."""
    with np.load(io.BytesIO(content), allow_pickle=False) as arrays:
        vertices, faces, counts = (arrays[name] for name in ("vertices", "faces", "counts"))
    ends = np.cumsum(counts.reshape(-1, 2), axis=0)
    if (len(vertices), len(faces)) != tuple(ends[-1] if len(ends) else (0, 0)):
        raise ValueError("counts do not add up")
    starts = ends - counts
    return [
        (vertices[v0:v1].astype(np.float64), faces[f0:f1].astype(np.int64))
        for (v0, f0), (v1, f1) in zip(starts, ends, strict=True)
    ]
