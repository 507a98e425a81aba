"""Masses that an edit must not change: bodies whose geoms change say what they weighed before."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from meshforge.errors import AssetError
from meshforge.formats.mjcf.elements import inertial_attributes, tag
from meshforge.formats.mjcf.files.sources import Node, Tree
from meshforge.formats.mjcf.reading.model import Reading
from meshforge.formats.xml import Splice, attribute, indent, newline, removed

MASSES = ("body_mass", "body_inertia", "body_ipos", "body_iquat")
FROM_GEOMS = "inertiafromgeom"


def changed(before: Reading, after: Reading) -> list[int]:
    """The bodies of another mass, centre or inertia, by number."""
    differ = np.zeros(before.model.nbody, dtype=bool)
    for field in MASSES:
        one, other = (getattr(r.model, field).reshape(len(differ), -1) for r in (before, after))
        differ |= (one != other).any(axis=1)
    return [int(k) for k in np.flatnonzero(differ)]


def always_from_geoms(tree: Tree) -> bool:
    """Whether the compiler settings say that every `<inertial>` is ignored."""
    said = [n.attributes[FROM_GEOMS] for n in tree.root.children if n.tag == "compiler" and FROM_GEOMS in n.attributes]
    return said[-1:] == ["true"]


def no_longer_always(tree: Tree) -> list[tuple[int, Splice]]:
    """The edits, with their files, by which an `<inertial>` counts where there is one."""
    return [
        (node.source, attribute(tree.sources[node.source].text.data, node.element, FROM_GEOMS, "auto"))
        for node in tree.root.children
        if node.tag == "compiler" and node.attributes.get(FROM_GEOMS) == "true"
    ]


def inertial(reading: Reading, body: int) -> bytes:
    """The `<inertial>` of a body as MuJoCo compiled it; reading: of the unedited document, masses not scaled."""
    model = reading.model
    mass, quaternion = float(model.body_mass[body]), model.body_iquat[body]
    said = inertial_attributes(mass, model.body_ipos[body], quaternion, model.body_inertia[body])
    return tag("inertial", said)


def weighed(tree: Tree, node: Node, text: bytes) -> list[tuple[int, Splice]]:
    """The edits, with their files, that put an `<inertial>` before the children of a body's element.

    One that was ignored so far gives way.
    """
    data = tree.sources[node.source].text.data
    gone = [(old.source, removed(tree.sources[old.source].text.data, old.element)) for old in _inertials(node)]
    at = node.element.inside
    lead = indent(data, node.element.children[0].start)
    return [*gone, (node.source, Splice(at, at, (b"" if lead is None else newline(data) + lead) + text))]


def says_mass(node: Node | None, tree: Tree) -> bool:
    """Whether a body's element has an `<inertial>` that counts."""
    return node is not None and any(True for _ in _inertials(node)) and not always_from_geoms(tree)


def refuse_weighing(body: str, why: str, tree: Tree) -> AssetError:
    """The error about a body that cannot say its mass."""
    return AssetError(
        f"the mass of body {body!r} cannot be kept: {why}",
        where=str(tree.main.path),
        remedy="Let MuJoCo take it from the edited hulls (--mass recompute).",
    )


def _inertials(node: Node) -> Iterable[Node]:
    """The `<inertial>` of a body, which may stand in a frame."""
    for child in node.children:
        if child.tag == "inertial":
            yield child
        elif child.tag == "frame":
            yield from _inertials(child)
