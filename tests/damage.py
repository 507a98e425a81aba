"""Damage to files, as copies, exporters and hands do it: bytes, lines and numbers changed, left out, or doubled."""

from __future__ import annotations

import random
import re

_NUMBER = re.compile(rb"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
_VALUES = (
    *(b"0", b"-1", b"1", b"2", b"7", b"8", b"9", b"255", b"65536", b"2147483647", b"2147483648", b"4294967295"),
    *(b"1e5", b"1e15", b"1e30", b"1e308", b"1e999", b"-1e-320", b"nan", b"inf", b"-inf", b"0.0", b"1.5", b"", b"x"),
)
_BYTES = (0, 1, 9, 10, 13, 32, 34, 35, 45, 47, 60, 62, 92, 127, 128, 255)


def damaged(data: bytes, rng: random.Random) -> bytes:
    """A file with one to four things changed in it."""
    for _ in range(rng.choice((1, 1, 1, 2, 2, 4))):
        data = rng.choice(_KINDS)(data, rng)
    return data


def _byte(data: bytes, rng: random.Random) -> bytes:
    """One byte is another."""
    if not data:
        return data
    at = rng.randrange(len(data))
    new = rng.choice((rng.randrange(256), rng.choice(_BYTES), data[at] ^ (1 << rng.randrange(8))))
    return data[:at] + bytes([new]) + data[at + 1 :]


def _word(data: bytes, rng: random.Random) -> bytes:
    """Four bytes are a number at a limit."""
    if len(data) < 4:
        return data
    at = rng.randrange(len(data) - 3)
    limits = (0, 1, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0x7F800000, 0x7FC00000, 0x01000000)
    return data[:at] + rng.choice(limits).to_bytes(4, rng.choice(("little", "big"))) + data[at + 4 :]


def _cut(data: bytes, rng: random.Random) -> bytes:
    """The end is missing."""
    return data[: rng.randrange(len(data) + 1)]


def _hole(data: bytes, rng: random.Random) -> bytes:
    """Some bytes are missing."""
    at = rng.randrange(len(data) + 1)
    return data[:at] + data[at + rng.choice((1, 2, 3, 12, 50)) :]


def _twice(data: bytes, rng: random.Random) -> bytes:
    """Some bytes are there twice."""
    at = rng.randrange(len(data) + 1)
    some = data[at : at + rng.choice((1, 4, 12, 50))]
    return data[:at] + some + data[at:]


def _lines(data: bytes, rng: random.Random) -> bytes:
    """Two lines have changed places, or one is missing, or there twice."""
    lines = data.splitlines(keepends=True)
    if len(lines) < 2:
        return data
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    match rng.randrange(3):
        case 0:
            lines[i], lines[j] = lines[j], lines[i]
        case 1:
            del lines[i]
        case _:
            lines.insert(j, lines[i])
    return b"".join(lines)


def _number(data: bytes, rng: random.Random) -> bytes:
    """A number in a text is another."""
    found = list(_NUMBER.finditer(data))
    if not found:
        return data
    at = rng.choice(found)
    return data[: at.start()] + rng.choice(_VALUES) + data[at.end() :]


def _swapped(data: bytes, rng: random.Random) -> bytes:
    """A word stands where another of the file stood."""
    words = list(re.finditer(rb"[A-Za-z_]{2,}", data))
    if len(words) < 2:
        return data
    at, other = rng.choice(words), rng.choice(words)
    return data[: at.start()] + other[0] + data[at.end() :]


_KINDS = (_byte, _word, _cut, _hole, _twice, _lines, _number, _number, _swapped)
