"""What of a glTF file is referred to from elsewhere in it, so that an edit leaves it where it is."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from typing import Any

from meshforge.formats.meshfile.gltf import Json
from meshforge.formats.meshfile.gltf.items import entries, extension

_POINTER = re.compile(r"/nodes/(\d+)(/.*)?")


class Referred:
    """References to the nodes and meshes of a tree.

    animated, morphed: nodes that animations move, or morph; nodes: all that are referred to other than as children;
    users: how many nodes show each mesh, and how many colliders name it.
    """

    def __init__(self, tree: Json) -> None:
        targets = list(_targets(tree))
        self.morphed = {node for node, what in targets if what == "weights"}
        self.animated = {node for node, what in targets if what != "weights"}
        self.nodes = {node for node, _ in targets} | set(_joints(tree)) | set(_named(tree, ("node", "connectedNode")))
        self.users: Counter[int] = Counter(_named(tree, ("mesh",)))


def _targets(tree: Json) -> Iterator[tuple[int, str]]:
    """The nodes that animations change, with what of them."""
    for animation in entries(tree, "animations"):
        for channel in entries(animation, "channels"):
            target = channel.get("target", {})
            if isinstance(target.get("node"), int):
                yield target["node"], str(target.get("path"))
            pointer = (extension(target, "KHR_animation_pointer") or {}).get("pointer", "")
            if found := _POINTER.fullmatch(str(pointer)):
                yield int(found[1]), (found[2] or "/").split("/")[1]


def _joints(tree: Json) -> Iterator[int]:
    for skin in entries(tree, "skins"):
        yield from entries(skin, "joints")
        if isinstance(skin.get("skeleton"), int):
            yield skin["skeleton"]


def _named(tree: Json, keys: tuple[str, ...]) -> Iterator[int]:
    """The numbers under some keys, anywhere in extensions and nodes; a node's own number in itself is none."""
    waiting: list[tuple[Any, int | None]] = [(tree.get("extensions"), None)]
    waiting += [(node, k if "node" in keys else None) for k, node in enumerate(entries(tree, "nodes"))]
    while waiting:
        value, itself = waiting.pop()
        if isinstance(value, dict):
            yield from (v for k, v in value.items() if k in keys and isinstance(v, int) and v != itself)
            waiting += [(inner, itself) for inner in value.values()]
        elif isinstance(value, list):
            waiting += [(inner, itself) for inner in value]
