"""Where an element of an MJCF stands: its default class, what that class sets, and the frames around it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from meshforge.formats.mjcf.elements import tag
from meshforge.formats.mjcf.files.sources import Node, Tree
from meshforge.formats.mjcf.reading.engine import compiled
from meshforge.formats.mjcf.reading.kinematics import rotation_of
from meshforge.geometry import Pose

MAIN = "main"
"""The class of elements that are given none; all others inherit from it."""
_BODIES = ("body", "worldbody")


class Context:
    """The surroundings of all elements of a tree."""

    def __init__(self, tree: Tree) -> None:
        self.tree = tree
        self._parents = {id(child): node for node in tree.root.walk() for child in node.children}
        self._set: dict[tuple[str, str], dict[str, str]] = {}
        self._classes: dict[str, tuple[Node, ...]] = {MAIN: ()}
        for top in tree.root.children:
            if top.tag == "default":
                self._classes[MAIN] += (top,)
        for top in self._classes[MAIN]:
            self._add_classes(top)

    def ancestors_of(self, node: Node) -> Iterator[Node]:
        """The elements around an element, the nearest first."""
        while id(node) in self._parents:
            node = self._parents[id(node)]
            yield node

    def class_of(self, node: Node) -> str:
        """The default class of a geom: its own, or that of the children of what is around it."""
        said = [node.attributes.get("class"), *(n.attributes.get("childclass") for n in self.ancestors_of(node))]
        return next((name for name in said if name), MAIN)

    def class_inside(self, node: Node) -> str:
        """The default class of what stands in an element without a class of its own."""
        said = (n.attributes.get("childclass") for n in (node, *self.ancestors_of(node)))
        return next((name for name in said if name), MAIN)

    def defaults_of(self, name: str, kind: str = "geom") -> dict[str, str]:
        """The attributes that a default class sets for a kind of element, those it inherits included."""
        found: dict[str, str] = {}
        for default in (*self._classes[MAIN], *(self._classes.get(name, ()) if name != MAIN else ())):
            for element in default.children:
                if element.tag == kind:
                    found |= element.attributes
        return found

    def body_t_frame(self, node: Node) -> Pose:
        """The pose of the frames around a geom, one in another, in their body."""
        frames = []
        for outer in self.ancestors_of(node):
            if outer.tag in _BODIES:
                break
            frames.append(outer)
        return self._compile_frames([f for f in reversed(frames) if f.tag == "frame"])

    def _compile_frames(self, frames: list[Node]) -> Pose:
        """MuJoCo's own answer for frames in one another, from a model of nothing else."""
        said = [{k: v for k, v in f.attributes.items() if k not in ("name", "childclass")} for f in frames]
        if not any(said):
            return Pose.identity()
        units: dict[str, str] = {}
        for node in self.tree.root.children:
            if node.tag == "compiler":
                units |= {k: v for k, v in node.attributes.items() if k in ("angle", "eulerseq")}
        opened = b"".join(tag("frame", attributes, closed=False) for attributes in said)
        text = b"<mujoco>%s<worldbody>%s<geom size='1'/>%s</worldbody></mujoco>"
        model = compiled(
            Path("frames.xml"), {Path("frames.xml"): text % (tag("compiler", units), opened, b"</frame>" * len(said))}
        )
        return Pose(rotation_of(model.geom_quat[0]), model.geom_pos[0])

    def _add_classes(self, default: Node, chain: tuple[Node, ...] = ()) -> None:
        for child in default.children:
            if child.tag == "default":
                own = (*chain, child)
                self._classes.setdefault(child.attributes.get("class", ""), own)
                self._add_classes(child, own)
