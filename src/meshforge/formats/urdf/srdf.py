"""SRDF: what MoveIt keeps beside a URDF of the same stem, of which the pairs of links are taken that never collide."""

from collections.abc import Sequence
from pathlib import Path

from meshforge.common import is_file
from meshforge.formats import element_edits, mesh_reader, xml

SUFFIX = ".srdf"
_PAIR = "disable_collisions"
_REASON = "User"
"""MoveIt's word for a pair that a person chose, and that is neither adjacent nor found by sampling."""


def srdf_beside(path: Path) -> Path | None:
    """Return the SRDF of a URDF, None where there is none."""
    beside = path.with_suffix(SUFFIX)
    return beside if path.suffix.lower() == ".urdf" and is_file(beside) else None


def read_pairs(path: Path) -> tuple[tuple[str, str], ...]:
    """Return the pairs of links that an SRDF keeps from colliding. Raises AssetError: it is not well formed."""
    root = xml.parse_xml(xml.XmlText.of(mesh_reader.read_content(path)).data, str(path))
    rows = (element.attributes for element in root.each(_PAIR))
    return tuple((row["link1"], row["link2"]) for row in rows if row.keys() >= {"link1", "link2"})


def write_pairs(pairs: Sequence[tuple[str, str]], robot: str, before: Path | None = None) -> bytes:
    """Return an SRDF in which pairs of links are kept from colliding; before: one that they are added to.

    Raises AssetError as `read_pairs`.
    """
    texts = [xml.tag(_PAIR, {"link1": one, "link2": other, "reason": _REASON}) for one, other in pairs]
    if before is None:
        return b"\n".join([b'<?xml version="1.0"?>', *xml.nest("robot", *texts, name=robot), b""])
    text = xml.XmlText.of(mesh_reader.read_content(before))
    outputs = [element_edits.OutputElement("", (), text=one) for one in texts]
    root = xml.parse_xml(text.data, str(before))
    return text.encode(xml.apply_splices(text.data, [element_edits.append_elements(text.data, root, outputs)]))
