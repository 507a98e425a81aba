"""Binary USD layers made by hand, so that they can say what the library never writes. In versions from 0.7 on.

Source: pxr/usd/sdf/crateFile.cpp and integerCoding.cpp of github.com/PixarAnimationStudios/OpenUSD.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from random import Random

import lz4.block
import numpy as np

BODY = 88
"""Where the values begin: behind the head of the file."""
TOKENS = ("", "a", "specifier", "primChildren", "customData")
ARRAY, INLINED, PACKED, EDIT = 1 << 63, 1 << 62, 1 << 61, 1 << 60
INT, FLOAT, DICTIONARY, PATH_LIST, TOKEN_VECTOR, TIME_SAMPLES, VALUE = 3, 8, 31, 34, 41, 46, 52
_DEF = INLINED | 42 << 48
_NAMED, _DATA = 3, 4  # tokens of fields
_ROOT, _PRIM = 7, 6  # kinds of specs
_ENTRY = 28  # bytes of a dictionary with one entry


def value(kind: int, place: int, flags: int = 0) -> int:
    """What a field says of a value that lies at a place."""
    return flags | kind << 48 | place


def number(*numbers: int) -> bytes:
    return struct.pack(f"<{len(numbers)}Q", *numbers)


def packed(data: bytes) -> bytes:
    return b"\0" + bytes(lz4.block.compress(data, store_size=False))


def integers(numbers: Sequence[int]) -> bytes:
    """Coded by their differences, each of four bytes, and packed."""
    steps = np.diff(np.array([0, *numbers], np.int64)).astype("<i4")
    coded = packed(b"\0\0\0\0" + b"\xff" * ((len(steps) + 3) // 4) + steps.tobytes())
    return number(len(coded)) + coded


def crate(
    jumps: Sequence[int] = (-1, -2),
    *,
    body: bytes = b"",
    values: Mapping[int, int] | None = None,
    tokens: Sequence[str] = TOKENS,
    version: tuple[int, int, int] = (0, 8, 0),
    replaced: Mapping[str, bytes] | None = None,
) -> bytes:
    """A layer of prims called "a" in a tree, each with the same fields.

    jumps: of the paths, the root first; body: from place `BODY` on; values: by the index of the field's name in the
    tokens, also those of the layer; replaced: sections that are others than they should be.
    """
    count = len(jumps)
    children = number(1) + struct.pack("<I", 1)
    at = BODY + len(body)
    fields = {2: _DEF, **(values or {}), _NAMED: value(TOKEN_VECTOR, at)}
    sets = [*range(len(fields)), 0xFFFFFFFF, *range(len(fields) - 1), 0xFFFFFFFF]
    text = b"".join(token.encode() + b"\0" for token in tokens)
    sections = {
        "TOKENS": number(len(tokens), len(text), len(packed(text))) + packed(text),
        "STRINGS": number(2) + struct.pack("<2I", 1, 4),
        "FIELDS": number(len(fields))
        + integers(list(fields))
        + number(len(packed(number(*fields.values()))))
        + packed(number(*fields.values())),
        "FIELDSETS": number(len(sets)) + integers(np.array(sets, np.uint32).astype(np.int32).tolist()),
        "PATHS": number(count, count) + integers(range(count)) + integers([0] + [1] * (count - 1)) + integers(jumps),
        "SPECS": number(count)
        + integers(range(count))
        + integers([0] * (count - 1) + [len(fields) + 1])
        + integers([_ROOT] + [_PRIM] * (count - 1)),
        **(replaced or {}),
    }
    made = bytearray(b"PXR-USDC" + bytes([*version, *[0] * 77]) + body + children)
    table = []
    for name, content in sections.items():
        table.append(name.encode().ljust(16, b"\0") + number(len(made), len(content)))
        made += content
    made[16:24] = number(len(made))
    return bytes(made) + number(len(table)) + b"".join(table)


def nested(depth: int) -> bytes:
    """A layer of prims that lie in each other."""
    return crate([-1] * depth + [-2])


def held(kind: int, content: bytes, flags: int = 0) -> bytes:
    """A layer whose prims have custom data: a dictionary with one value, whose content lies behind it."""
    body = _entry(value(kind, BODY + _ENTRY, flags)) + content
    return crate(body=body, values={_DATA: value(DICTIONARY, BODY)})


def array(kind: int, said: int, content: bytes = bytes(64), flags: int = 0) -> bytes:
    """A layer with an array that says to have so many elements."""
    return held(kind, number(said) + content, ARRAY | flags)


def dictionaries(depth: int, *, closed: bool = False) -> bytes:
    """A layer with a dictionary of dictionaries; closed: the innermost holds the outermost."""
    inner = [_entry(value(DICTIONARY, BODY + _ENTRY * (k + 1))) for k in range(depth)]
    last = _entry(value(DICTIONARY, BODY)) if closed else number(0)
    return crate(body=b"".join(inner) + last, values={_DATA: value(DICTIONARY, BODY)})


def _entry(held: int) -> bytes:
    return number(1) + struct.pack("<I", 0) + number(8, held)


_FLAGS = (0, 0, ARRAY, INLINED, ARRAY | INLINED, PACKED | ARRAY, EDIT)
_HOLDING = (31, 32, 35, 40, 46, 52, 53, 54, 55, 59)  # kinds of values that hold others, or many
_TREES = ((-1, -2), (-1, -1, -2), (-1, 2, -2, -2), (-1, 3, -1, -2, -2))
_COUNTS = (*range(9), 16, 20, 28, 1 << 20, 1 << 31, 1 << 40, (1 << 64) - 8)
_FIELDS = (
    *("active", "apiSchemas", "customLayerData", "default", "inheritPaths", "kind", "payload", "references"),
    *("relocates", "specializes", "timeSamples", "typeName", "variantSelection", "variantSetNames"),
)


def anyhow(draw: Random) -> bytes:
    """A layer whose tree, values and tables say what they like."""
    size = draw.choice((8, 40, 120))
    body = bytearray(draw.choice((bytes(size), draw.randbytes(size))))

    def some_value() -> int:
        place = draw.choice((0, BODY, BODY + 8 * draw.randrange(size // 8 + 1), draw.randrange(600)))
        return value(draw.randrange(64), place, draw.choice(_FLAGS))

    for at in range(0, size - 7, 4):
        if draw.random() < 0.5:
            body[at : at + 8] = number(draw.choice((*_COUNTS, some_value())))
    some_jumps = -1, *(draw.randrange(-3, 9) for _ in range(draw.randrange(8))), -2
    tokens = [*TOKENS[:_DATA], draw.choice((*_FIELDS, *[TOKENS[_DATA]] * 20))]
    table = draw.choice(("TOKENS", "STRINGS", "FIELDS", "FIELDSETS", "PATHS", "SPECS"))
    wrong = number(*draw.choices(_COUNTS, k=3)) + integers([draw.randrange(-5, 9) for _ in range(draw.randrange(6))])
    return crate(
        draw.choice((*_TREES, some_jumps)),
        body=bytes(body),
        values={_DATA: draw.choice((some_value(), value(draw.choice(_HOLDING), BODY)))},
        tokens=tokens,
        version=(0, draw.choice((7, 8, 9, 11, 12, 14, 16)), 0),
        replaced={table: wrong} if draw.random() < 0.1 else None,
    )
