"""The two containers of glTF: a text file, or a GLB of chunks, of which the first is that text."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass

MAGIC = b"glTF"
_JSON, _BIN = 0x4E4F534A, 0x004E4942
_HEADER = 12  # bytes: magic, version, length of the file


@dataclass(frozen=True, slots=True)
class Container:
    """A file taken apart: its JSON, and of a GLB all further chunks with their types, in order.

    rest: bytes that some exporters leave behind the last chunk.
    """

    text: bytes
    is_binary: bool = False
    chunks: tuple[tuple[int, bytes], ...] = ()
    rest: bytes = b""

    @staticmethod
    def of(data: bytes) -> Container:
        """The container in the bytes of a file. Raises ValueError: a GLB that is damaged, or not of version 2."""
        if data[:4] != MAGIC:
            return Container(data)
        if len(data) < _HEADER + 8:
            raise ValueError("it is cut short")
        version, length = struct.unpack_from("<II", data, 4)
        if version != 2:
            raise ValueError(f"it is a GLB of version {version}, only version 2 is read")
        if length > len(data):
            raise ValueError(f"it is cut short: {len(data):,} of {length:,} bytes are there")
        chunks, at = _chunks(data, length)
        if not chunks or chunks[0][0] != _JSON:
            raise ValueError("its first chunk is not the JSON")
        return Container(chunks[0][1], True, tuple(chunks[1:]), data[at:])

    @property
    def binary(self) -> bytes | None:
        """The chunk that holds the first buffer, None where there is none."""
        return next((content for kind, content in self.chunks if kind == _BIN), None)

    def with_text(self, text: bytes, binary: bytes | None) -> Container:
        """The same with another JSON, and another binary chunk where one is given."""
        chunks = list(self.chunks)
        if binary is not None:
            at = next((k for k, (kind, _) in enumerate(chunks) if kind == _BIN), None)
            chunks[slice(0, 0) if at is None else slice(at, at + 1)] = [(_BIN, binary)]
        return Container(text, self.is_binary, tuple(chunks), self.rest)

    def as_bytes(self) -> bytes:
        """The bytes of the file; chunks are padded to multiples of four, as the format asks for."""
        return _glb([(_JSON, self.text), *self.chunks]) + self.rest if self.is_binary else self.text


def _chunks(data: bytes, length: int) -> tuple[list[tuple[int, bytes]], int]:
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


def _glb(chunks: Sequence[tuple[int, bytes]]) -> bytes:
    body = b""
    for kind, content in chunks:
        padded = content + (b" " if kind == _JSON else b"\0") * (-len(content) % 4)
        body += struct.pack("<II", len(padded), kind) + padded
    return struct.pack("<4sII", MAGIC, 2, _HEADER + len(body)) + body
