"""Binary layers: their table of contents, the tree of their paths, and what their fields point to.

Source: pxr/usd/sdf/crateFile.cpp and integerCoding.cpp of github.com/PixarAnimationStudios/OpenUSD.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from meshforge.common import AssetError
from meshforge.formats.usd.crate_values import (
    DEEPEST,
    NEEDLESS,
    PATH_EXPRESSION,
    REMEDY,
    Allowance,
    ContradictionError,
    CrateBytes,
    ExcessError,
    bracket_depth,
    refuse_harmful_values,
)

CRATE_MARK = b"PXR-USDC"
_OLDEST = (0, 4, 0)  # that the library still reads
_CONTENTS, _NAME, _MOST_SECTIONS = 16, 16, 64
_LEAF, _CHILD, _SIBLING = -2, -1, 0  # what comes after a path: nothing, its child, the next beside it; else both


def refuse_harmful_crate(data: bytes, where: str) -> None:
    """Raise AssetError where a binary layer contradicts itself, is nested too deep, or unpacks to far too much."""
    allowance = Allowance(len(data))
    try:
        version = _read_version(data, allowance, where)
        sections = _read_sections(data, allowance)
        names = _read_tokens(sections[b"TOKENS"]) if b"TOKENS" in sections else b""
        if b"PATHS" in sections:
            _check_paths(sections[b"PATHS"])
        for name in (b"FIELDSETS", b"SPECS"):
            if name in sections:
                count = sections[name].read_number()
                for _ in range(3 if name == b"SPECS" else 1):
                    sections[name].skip_integers(count)
        if b"STRINGS" in sections:
            sections[b"STRINGS"].skip(sections[b"STRINGS"].read_number(), 4)
        if b"FIELDS" in sections:
            refuse_harmful_values(CrateBytes(data, 0, allowance), _read_fields(sections[b"FIELDS"], names), version)
    except ContradictionError as contradiction:
        raise AssetError(f"it is damaged or cut off: {contradiction}", where=where, remedy=REMEDY) from contradiction
    except ExcessError as excess:
        raise AssetError(str(excess), where=where, remedy=NEEDLESS) from excess


def _read_version(data: bytes, allowance: Allowance, where: str) -> tuple[int, ...]:
    head = CrateBytes(data, len(CRATE_MARK), allowance)
    version = head.read_number(1), head.read_number(1), head.read_number(1)
    if version < _OLDEST:
        problem = f"it is of version {'.'.join(map(str, version))} of the binary format, which is not read any more"
        raise AssetError(problem, where=where, remedy="Write it anew with an older release of USD.")
    return version


def _read_sections(data: bytes, allowance: Allowance) -> dict[bytes, CrateBytes]:
    """The first of each name."""
    contents = CrateBytes(data, _CONTENTS, allowance)
    contents.at = contents.read_number()
    count = contents.read_number()
    if count > _MOST_SECTIONS:
        raise ContradictionError("its table of contents does not fit it")
    found: dict[bytes, CrateBytes] = {}
    for _ in range(count):
        name = data[contents.skip(_NAME) : contents.at].split(b"\0", 1)[0]
        start, size = contents.read_number(), contents.read_number()
        if start + size > len(data):
            raise ContradictionError("its table of contents does not fit it")
        found.setdefault(name, CrateBytes(data, start, allowance, start + size))
    return found


def _read_tokens(section: CrateBytes) -> bytes:
    """The names of everything, each with a zero byte behind it."""
    count, size = section.read_number(), section.read_number()
    section.allowance.take(count)
    text = section.unpack(section.read_number(), size)
    if len(text) < size or text.count(b"\0") < count:
        raise ContradictionError("its names are fewer than it says")
    deep = text.count(b"/") > DEEPEST or text.count(b"(") > DEEPEST
    if deep and any(
        bracket_depth(name) > DEEPEST or (name.startswith(b"[") and name.count(b"/") > DEEPEST)
        for name in text.split(b"\0")
    ):
        raise ExcessError(f"names in it are nested more than {DEEPEST} deep")
    return text


def _check_paths(section: CrateBytes) -> None:
    section.allowance.take(section.read_number())
    count = section.read_number()
    for _ in ("places", "names"):
        section.skip_integers(count)
    if _measure_depth(section.read_integers(count)) > DEEPEST:
        raise ExcessError(f"it is nested more than {DEEPEST} deep")


def _measure_depth(jumps: NDArray[np.int32]) -> int:
    """How deep the tree of the paths goes.

    Raises ContradictionError where it is none: where branches meet, or lead out of it.
    """
    count = len(jumps)
    depths = [-1] * (count + 1)
    depths[0] = 0

    def place(at: int, deep: int) -> None:
        if at >= count or depths[at] >= 0:
            raise ContradictionError("its paths are no tree")
        depths[at] = deep

    for at, jump in enumerate(jumps.tolist()):
        deep = depths[at]
        if deep < 0 or jump < _LEAF:
            raise ContradictionError("its paths are no tree")
        if jump != _LEAF:
            place(at + 1, deep if jump == _SIBLING else deep + 1)
        if jump > 0:
            place(at + jump, deep)
    return max(depths)


def _read_fields(section: CrateBytes, names: bytes) -> NDArray[np.uint64]:
    """(count,) what each field says its value is; names: of tokens, each with a zero byte behind it.

    A path expression as metadata of a prim, such as `kind`, ends the library's process when it makes a stage.
    """
    count = section.read_number()
    named = section.read_integers(count)
    values = section.unpack(section.read_number(), 8 * count)
    if len(values) < 8 * count:
        raise ContradictionError("its fields are fewer than it says")
    found = np.frombuffer(values, np.uint64)
    expressions = np.unique(named[(found >> np.uint64(48)) & np.uint64(0xFF) == PATH_EXPRESSION]).tolist()
    known = names.split(b"\0") if expressions else []
    if any(not 0 <= k < len(known) or known[k] != b"default" for k in expressions):
        raise ContradictionError("a path expression stands where none can be")
    return found
