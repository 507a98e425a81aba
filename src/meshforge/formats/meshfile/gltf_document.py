"""The document of a glTF file: its container, its JSON, with values of any type, and one error for all damage."""

import json
import re
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

from meshforge.common import AssetError
from meshforge.geometry import Floats

MAGIC = b"glTF"
_JSON, _BIN = 0x4E4F534A, 0x004E4942
_HEADER = 12  # bytes: magic, version, length of the file

Json = dict[str, Any]

_DAMAGE = (ValueError, LookupError, TypeError, AttributeError, RecursionError, OverflowError, MemoryError)
_SURROGATE = re.compile(r"\\u[dD][89a-fA-F]")  # an escape that is half a character, unless another one follows


@dataclass(frozen=True, slots=True)
class Container:
    """A file taken apart: its JSON, and of a GLB all further chunks with their types, in order.

    rest: bytes that some exporters leave behind the last chunk.
    """

    text: bytes
    is_binary: bool = False
    chunks: tuple[tuple[int, bytes], ...] = ()
    rest: bytes = b""

    @classmethod
    def of(cls, data: bytes) -> Self:
        """Return the container in the bytes of a file. Raises ValueError: a damaged GLB, or not of version 2."""
        if data[:4] != MAGIC:
            return cls(data)
        if len(data) < _HEADER + 8:
            raise ValueError("it is cut short")
        version, length = struct.unpack_from("<II", data, 4)
        if version != 2:
            raise ValueError(f"it is a GLB of version {version}, only version 2 is read")
        if length > len(data):
            raise ValueError(f"it is cut short: {len(data):,} of {length:,} bytes are there")
        chunks, at = _split_chunks(data, length)
        if not chunks or chunks[0][0] != _JSON:
            raise ValueError("its first chunk is not the JSON")
        return cls(chunks[0][1], True, tuple(chunks[1:]), data[at:])

    @property
    def binary(self) -> bytes | None:
        """The chunk that holds the first buffer, None where there is none."""
        return next((content for kind, content in self.chunks if kind == _BIN), None)

    def with_text(self, text: bytes, binary: bytes | None) -> Self:
        """Return the container with another JSON, and another binary chunk where one is given."""
        chunks = list(self.chunks)
        if binary is not None:
            at = next((k for k, (kind, _) in enumerate(chunks) if kind == _BIN), None)
            chunks[slice(0, 0) if at is None else slice(at, at + 1)] = [(_BIN, binary)]
        return replace(self, text=text, chunks=tuple(chunks))

    def as_bytes(self) -> bytes:
        """Return the bytes of the file; chunks are padded to multiples of four, as the format asks for."""
        if not self.is_binary:
            return self.text
        body = b""
        for kind, content in ((_JSON, self.text), *self.chunks):
            padded = content + (b" " if kind == _JSON else b"\0") * (-len(content) % 4)
            body += struct.pack("<II", len(padded), kind) + padded
        return struct.pack("<4sII", MAGIC, 2, _HEADER + len(body)) + body + self.rest


def _split_chunks(data: bytes, length: int) -> tuple[list[tuple[int, bytes]], int]:
    """The chunks within `length` bytes of a GLB, and where they end; up to three bytes behind them are padding."""
    chunks: list[tuple[int, bytes]] = []
    at = _HEADER
    while at + 8 <= length:
        size, kind = struct.unpack_from("<II", data, at)
        if at + 8 + size > len(data):
            raise ValueError("a chunk of it is cut short")
        chunks.append((kind, data[at + 8 : at + 8 + size]))
        at += 8 + size
    return chunks, at


def entries(owner: Any, key: str) -> list[Any]:
    """Return the array under a key, empty where there is none. Raises ValueError: it is something else."""
    found = owner.get(key, []) if isinstance(owner, dict) else None
    if not isinstance(found, list):
        raise ValueError(f"its {key!r} are no array")
    return found


def entry(owner: Any, key: str, index: Any) -> Json:
    """Return the object of an index in the array under a key. Raises ValueError: it is not there, or no object."""
    found = entries(owner, key)
    if not isinstance(index, int) or isinstance(index, bool) or not 0 <= index < len(found):
        raise ValueError(f"there is no {index!r} in its {key!r}")
    if not isinstance(found[index], dict):
        raise ValueError(f"{index} of its {key!r} is no object")
    return found[index]  # type: ignore[no-any-return]  # an object


def extension(owner: Any, name: str) -> Json | None:
    """Return an extension of an object, None where it has none of that name."""
    found = owner.get("extensions", {}).get(name)
    return found if isinstance(found, dict) else None


def numbers(owner: Json, key: str, count: int, default: tuple[float, ...]) -> Floats:
    """Return so many finite numbers under a key. Raises ValueError: others, or another count."""
    values = np.array(owner.get(key, default), dtype=np.float64)
    if values.shape != (count,) or not np.isfinite(values).all():
        raise ValueError(f"its {key!r} should be {count} finite numbers")
    return values


def number(owner: Json, key: str, default: float) -> float:
    """Return a finite number under a key. Raises ValueError."""
    return float(numbers({key: [owner[key]]} if key in owner else {}, key, 1, (default,))[0])


@contextmanager
def report_damage(where: str) -> Iterator[None]:
    """Make one clear AssetError of all that reading a damaged file may raise."""
    try:
        with np.errstate(over="ignore", invalid="ignore"):  # numbers beyond all bounds are found and refused
            yield
    except _DAMAGE as error:
        problem = f"{error.args[0]!r} is missing in it" if isinstance(error, KeyError) and error.args else str(error)
        if isinstance(error, UnicodeDecodeError):
            problem = f"its JSON is not UTF-8 text, from byte {error.start:,} on"
        raise AssetError(f"this glTF file is damaged: {problem}", where=where, remedy="Export it again.") from error


def parse_json(text: bytes) -> Json:
    """Return the JSON of a file, `?` for half characters in it. Raises ValueError: none, or another version."""
    plain = text.decode("utf-8-sig").rstrip("\0")
    tree = json.loads(plain, parse_constant=_refuse_constant)
    if _SURROGATE.search(plain):
        tree = json.loads(json.dumps(tree, ensure_ascii=False).encode("utf-8", "replace"))
    if not isinstance(tree, dict):
        raise ValueError("its JSON is no object")
    asset = tree.get("asset", {})
    version = asset.get("minVersion", asset.get("version", "2.0"))
    if not str(version).startswith("2."):
        raise ValueError(f"it is glTF {version}, only glTF 2 is read")
    return tree


def _refuse_constant(constant: str) -> float:
    raise ValueError(f"{constant} is no number of JSON")
