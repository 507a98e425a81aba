"""What PartNet-Mobility says of the links of an asset: `semantics.txt` beside its `mobility.urdf`."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from meshforge.errors import AssetError

SEMANTICS = "semantics.txt"
"""The name of such a file."""
_REMEDY = "Each line has a link, the kind of its joint and what it is: link_0 hinge rotation_door."


@dataclass(frozen=True, slots=True)
class Semantic:
    """What a link is; joint: the kind of the joint that carries it, as the file says it (`hinge`, `slider`, ...)."""

    link: str
    joint: str
    name: str


def read_semantics(path: Path) -> tuple[Semantic, ...]:
    """The links that a file tells of, in its order.

    Raises AssetError with the line: it cannot be read, a line of other than three words, a link told twice.
    """
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except OSError as error:
        raise AssetError(f"the semantics cannot be read ({error.strerror})", where=str(path)) from error
    except UnicodeDecodeError as error:
        raise AssetError("the semantics are not UTF-8 text", where=str(path)) from error
    found: dict[str, Semantic] = {}
    for number, line in enumerate(lines, start=1):
        words = line.split()
        if not words:
            continue
        if len(words) != 3:
            problem = f"this line has {len(words)} words, not three: {line.strip()[:60]!r}"
            raise AssetError(problem, where=f"{path}:{number}", remedy=_REMEDY)
        if words[0] in found:
            raise AssetError(f"the link {words[0]!r} is told twice", where=f"{path}:{number}", remedy="Keep one line.")
        found[words[0]] = Semantic(*words)
    if not found:
        raise AssetError("it tells of no link", where=str(path), remedy=_REMEDY)
    return tuple(found.values())
