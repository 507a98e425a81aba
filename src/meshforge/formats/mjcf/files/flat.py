"""One text of all files of an MJCF, as MuJoCo gets it: an element a line, so that a line number tells the element."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from meshforge.formats.mjcf.files.assets import Folders
from meshforge.formats.mjcf.files.sources import Node, Tree
from meshforge.formats.xml import escaped

Keep = Callable[[Node], Mapping[str, str] | None]
"""Which attributes of an element go into the text; None leaves the element out, with all below it."""

_FUSING = {"compiler": ("fusestatic", "discardvisual"), "body": ("fuse",)}


@dataclass(frozen=True, eq=False, slots=True)
class Flat:
    """The text, and its elements in order: that of line k is `nodes[k - 1]`."""

    text: bytes
    nodes: tuple[Node, ...]

    def node_at(self, info: str) -> Node | None:
        """The element that MuJoCo means by `line 7`; None where that is a line of another file."""
        line = int(info.removeprefix("line ")) if info.startswith("line ") and info[5:].isdigit() else 0
        return self.nodes[line - 1] if 0 < line <= len(self.nodes) else None


def flatten(tree: Tree, keep: Keep | None = None) -> Flat:
    """The text of a tree; keep: for a part of it.

    References of included files are made absolute where MuJoCo would find them beside the included file. Static
    bodies are not fused and visual geoms not discarded, whatever the compiler settings say.
    """
    folders = Folders.of(tree)
    nodes: list[Node] = []
    parts: list[bytes] = []
    closing: list[tuple[Node, int]] = []
    for node, depth, attributes in _kept(tree.root, keep or _all):
        while closing and closing[-1][1] >= depth:
            parts.append(b"</%s>" % closing.pop()[0].tag.encode())
        nodes.append(node)
        closing.append((node, depth))
        parts.append(_start_tag(tree, folders, node, attributes, first=not depth))
    parts += [b"</%s>" % node.tag.encode() for node, _ in reversed(closing)]
    return Flat(b"".join(parts), tuple(nodes))


def _kept(root: Node, keep: Keep) -> Iterator[tuple[Node, int, Mapping[str, str]]]:
    waiting = [(root, 0)]
    while waiting:
        node, depth = waiting.pop()
        attributes = keep(node)
        if attributes is not None:
            yield node, depth, attributes
            waiting.extend((child, depth + 1) for child in reversed(node.children))


def _all(node: Node) -> Mapping[str, str]:
    return node.attributes


def _start_tag(tree: Tree, folders: Folders, node: Node, attributes: Mapping[str, str], first: bool) -> bytes:
    parts = [b"<" if first else b"\n<", node.tag.encode()]
    for name, value in attributes.items():
        if name in _FUSING.get(node.tag, ()):
            continue
        if node.source and name.startswith("file") and (path := folders.path_beside_include(tree, node, name)):
            value = os.fspath(path)
        parts.append(b' %s="%s"' % (name.encode(), escaped(value)))
    return b"".join([*parts, b">"])
