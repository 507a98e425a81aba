"""The header of a PLY file: which elements follow, how many rows of each, and of what types."""

from __future__ import annotations

import codecs
import re
from dataclasses import dataclass

from meshforge.common import AssetError

TYPES = {
    **{"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4"},
    **{"double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4"},
    **{"float32": "f4", "float64": "f8"},
}
_SHOWN = 60  # characters of a line in a message
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}


@dataclass(frozen=True, slots=True)
class PlyProperty:
    """A property of an element: its name, numpy type, and the type of its length where it is a list."""

    name: str
    type: str
    count: str | None = None


@dataclass(frozen=True, slots=True)
class PlyElement:
    """An element: its name, how many rows it has, its properties."""

    name: str
    rows: int
    properties: tuple[PlyProperty, ...]

    @property
    def has_lists(self) -> bool:
        return any(p.count for p in self.properties)


@dataclass(frozen=True, slots=True)
class PlyHeader:
    """size: bytes of the header with its last line end; order: of the bytes in numpy's letters, empty for ASCII."""

    size: int
    order: str
    elements: tuple[PlyElement, ...]


def parse_header(data: bytes, where: str) -> PlyHeader:
    """The header at the start of a PLY file. Raises AssetError with the line: this is none, or it makes no sense."""
    if data.removeprefix(codecs.BOM_UTF8)[:3] != b"ply":
        raise AssetError("this is no PLY file", where=where, remedy="Export it again.")
    end = re.search(rb"^end_header[ \t]*(\r\n|\n|\r)", data, re.M)
    if end is None and re.search(rb"\rend_header\r", data):
        raise AssetError("its lines end in CR alone", where=where, remedy="Convert its line ends, or export it again.")
    if end is None:
        raise AssetError("the file is cut short: its header does not end", where=where, remedy="Export it again.")
    order: str | None = None
    elements: list[PlyElement] = []
    for number, line in enumerate(data[: end.start()].splitlines(), start=1):
        words = line.decode("ascii", "replace").split()
        try:
            match words:
                case ["format", kind, _]:
                    order = _ORDERS[kind]
                case ["element", name, rows]:
                    elements.append(PlyElement(name, _parse_count(rows), ()))
                case ["property", *rest]:
                    last, made = elements.pop(), _parse_property(rest)
                    if any(p.name == made.name for p in last.properties):
                        raise ValueError(made.name)
                    elements.append(PlyElement(last.name, last.rows, (*last.properties, made)))
        except (KeyError, IndexError, ValueError):
            shown = " ".join(words)[:_SHOWN]
            raise AssetError(f"this line of the header makes no sense: {shown!r}", where=f"{where}:{number}") from None
    if order is None:
        raise AssetError("the header names no format", where=where)
    return PlyHeader(end.end(), order, tuple(elements))


def _parse_count(text: str) -> int:
    if not text.isdecimal():
        raise ValueError(text)
    return int(text)


def _parse_property(words: list[str]) -> PlyProperty:
    match words:
        case ["list", count, kind, name]:
            return PlyProperty(name, TYPES[kind], TYPES[count])
        case [kind, name]:
            return PlyProperty(name, TYPES[kind])
    raise ValueError(words)
