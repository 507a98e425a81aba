"""Models that a few numbers blow up beyond what MuJoCo can make in reasonable time or memory."""

from __future__ import annotations

import math

from meshforge.errors import AssetError
from meshforge.formats.mjcf.files.sources import Node, Tree

_MOST_COPIES = 10_000  # of which MuJoCo's time is the square: about ten seconds
_MOST = {
    "hfield": (("nrow", "ncol"), 4_000_000),
    "flexcomp": (("count",), 1_000_000),
    "texture": (("width", "height"), 300_000_000),
}
"""Elements whose attributes multiply, and how much of it is taken."""
_FINEST = 1000  # parameter of a built-in mesh, of which some have the square of a parameter of vertices


def refuse_excess(tree: Tree) -> None:
    """Raise AssetError with `file:line` for replicated elements, grids, textures or meshes without measure."""
    waiting: list[tuple[Node, float]] = [(tree.root, 1.0)]
    copies = 0.0
    while waiting:
        node, times = waiting.pop()
        if node.tag == "replicate":
            times *= max(_product(node, ("count",)), 1.0)
        elif times > 1:
            copies += times
        if copies > _MOST_COPIES:
            raise AssetError(f"<replicate> makes more than {_MOST_COPIES:,} elements", where=tree.where(node))
        if told := _too_large(node):
            raise AssetError(f"this <{node.tag}> is too large to be made: {told}", where=tree.where(node))
        waiting.extend((child, times) for child in node.children)


def _too_large(node: Node) -> str:
    """The attributes that make an element too large, empty where none do."""
    if node.tag == "mesh" and "builtin" in node.attributes:
        names: tuple[str, ...] = ("params",)
        too_large = max(_numbers(node, names), default=0.0) > _FINEST
    else:
        names, most = _MOST.get(node.tag, ((), 0))
        too_large = _product(node, names) > most
    return " ".join(f'{name}="{node.attributes[name]}"' for name in names if too_large and name in node.attributes)


def _product(node: Node, names: tuple[str, ...]) -> float:
    return math.prod(max(number, 1.0) for number in _numbers(node, names))


def _numbers(node: Node, names: tuple[str, ...]) -> list[float]:
    """The numbers in some attributes; what cannot be read is left to MuJoCo to refuse."""
    found = []
    for word in (word for name in names for word in node.attributes.get(name, "").split()):
        try:
            found.append(float(word))
        except ValueError:
            continue
    return found
