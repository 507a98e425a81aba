"""References to geoms by name: pairs, sensors, tendons, tuples, plugins."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from meshforge.errors import AssetError
from meshforge.formats.mjcf.files.sources import Node, Tree

_PLAIN = ("geom", "geom1", "geom2")
_TYPED = (("objtype", "objname"), ("reftype", "refname"))


def mentions(tree: Tree) -> Iterator[tuple[str, Node]]:
    """The names of geoms that other elements refer to, each with such an element, in document order."""
    for node in tree.root.walk():
        said = node.attributes
        for key in _PLAIN:
            if said.get(key):
                yield said[key], node
        for kind, key in _TYPED:
            if said.get(kind) == "geom" and said.get(key):
                yield said[key], node


def refuse_mentioned(tree: Tree, removed: Collection[tuple[str, str]]) -> None:
    """Raise AssetError where something refers to a geom that is removed; its name attribute, the name of its hull."""
    hulls = dict(removed)
    for name, node in mentions(tree):
        if name in hulls:
            own = node.attributes.get("name")
            element = f"<{node.tag} name={own!r}>" if own else f"<{node.tag}>"
            raise AssetError(
                f"hull {hulls[name]!r} cannot be removed: {element} refers to its geom {name!r}",
                where=tree.where(node),
                remedy="Take this element out of the file first, or leave the hull out of the edit.",
            )
