"""Read VRML 2.0, which CoACD and MeshLab write: a surface for each shape, its transforms applied; and its grammar."""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from meshforge.common import AssetError
from meshforge.formats.meshfile.surface import RawSurface, check_surfaces, cut_fans
from meshforge.geometry import Floats

_SOLIDS = {"Box", "Sphere", "Cylinder", "Cone", "Extrusion", "ElevationGrid"}
_PARENTS = {"Group", "Transform", "Anchor", "Collision", "Billboard", "Switch", "LOD"}
_MOST = 100_000  # nodes; USE in USE multiplies them without end
_DEPTH = 200  # nodes in nodes; beyond, a file is damaged

_TOKEN = re.compile(r'"(?:\\.|[^"\\])*"|[{}\[\]]|[^\s,{}\[\]"#]+|#[^\n\r]*')
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|0[xX][0-9a-fA-F]+")
_OTHER = "Export it as OBJ."


class _VrmlError(Exception):
    """What is wrong with a file, and the remedy or None."""


def parse_vrml(data: bytes, where: str) -> list[RawSurface]:
    """Return the surfaces of a VRML 2.0 file. Raises AssetError: not such a file, or shapes that are no face sets."""
    try:
        nodes = _parse_nodes(data.decode("utf-8-sig", "replace"))
        steps = itertools.count()
        found = [surface for node in nodes for surface in _list_surfaces(node, np.eye(4), None, steps)]
    except _VrmlError as error:
        problem, remedy = error.args
        raise AssetError(problem, where=where, remedy=remedy) from error
    return check_surfaces(found, where)


def _list_surfaces(node: VrmlNode, world: Floats, name: str | None, steps: Iterator[int]) -> Iterator[RawSurface]:
    if next(steps) > _MOST:
        raise _VrmlError(f"it has more than {_MOST:,} nodes, most by USE", _OTHER)
    name = node.name or name
    if node.type == "Shape":
        for geometry in node.nodes("geometry"):
            yield from _read_surface(geometry, world, name)
    if node.type in _PARENTS:
        world = world @ _transform_of(node) if node.type == "Transform" else world
        for key in ("children", "choice", "level"):
            for child in node.nodes(key):
                yield from _list_surfaces(child, world, name, steps)


def _read_surface(node: VrmlNode, world: Floats, name: str | None) -> Iterator[RawSurface]:
    if node.type in _SOLIDS:
        raise _VrmlError(f"shapes of kind {node.type} are not read", _OTHER)
    coordinates = node.nodes("coord")
    if node.type != "IndexedFaceSet" or not coordinates:
        return
    numbers, indices = np.array(coordinates[0].numbers("point")), np.array(node.numbers("coordIndex"))
    if len(numbers) % 3:
        raise _VrmlError("its points are not all of three numbers", None)
    if not np.isfinite(numbers).all():
        raise _VrmlError("a coordinate is not a finite number", "Fix or export it again.")
    points = numbers.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]
    if (indices != np.floor(indices)).any():
        raise _VrmlError("a face names a vertex by a number that is not whole", None)
    if ((indices < -1) | (indices >= len(points))).any():
        raise _VrmlError(f"a face names a vertex that is not there, there are {len(points)}", None)
    ends = np.concatenate([[-1], np.flatnonzero(indices == -1), [len(indices)]])
    _, faces = cut_fans(indices[indices >= 0].astype(np.int64), np.diff(ends) - 1)
    yield RawSurface(name, points, faces[:, ::-1] if node.fields.get("ccw") == ["FALSE"] else faces)


def _transform_of(node: VrmlNode) -> Floats:
    center = _move_by(node.vector("center", 3))
    turn, lean = (_turn_by(node.vector(key, 4)) for key in ("rotation", "scaleOrientation"))
    scale = np.diag([*(node.vector("scale", 3) or [1.0, 1.0, 1.0]), 1.0])
    with np.errstate(over="ignore", invalid="ignore"):  # vertices that are not finite are refused
        back = 2 * np.eye(4) - center
        return _move_by(node.vector("translation", 3)) @ center @ turn @ lean @ scale @ lean.T @ back


def _move_by(offset: list[float]) -> Floats:
    matrix = np.eye(4)
    matrix[:3, 3] = offset or 0.0
    return matrix


def _turn_by(rotation: list[float]) -> Floats:
    """The turn (4, 4) by an angle [rad] about an axis, which come as four numbers; none where there are none."""
    matrix = np.eye(4)
    if rotation:
        x, y, z = np.array(rotation[:3]) / max(float(np.linalg.norm(rotation[:3])), 1e-300)
        cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        matrix[:3, :3] += np.sin(rotation[3]) * cross + (1 - np.cos(rotation[3])) * cross @ cross
    return matrix


@dataclass(slots=True)
class VrmlNode:
    """A node: its type, its DEF name, and what its fields hold (numbers, words, nodes; lists stay lists)."""

    type: str
    name: str | None = None
    fields: dict[str, list[Any]] = field(default_factory=dict)

    def numbers(self, key: str) -> list[float]:
        """Return the numbers of a field, none where it is not there."""
        return [x for x in self.fields.get(key, []) if isinstance(x, float)]

    def nodes(self, key: str) -> list[VrmlNode]:
        return [x for x in self.fields.get(key, []) if isinstance(x, VrmlNode)]

    def vector(self, key: str, size: int) -> list[float]:
        """Return the numbers of a field that has so many, none where it is not there. Raises _VrmlError: others."""
        found = self.numbers(key)
        if key in self.fields and len(found) != size:
            raise _VrmlError(f"the field {key} of a {self.type} needs {size} numbers", _OTHER)
        return found


def _parse_nodes(text: str) -> Iterator[VrmlNode]:
    """The nodes of a VRML 2.0 file. Raises _VrmlError: not such a file, cut short, or beyond what is read."""
    if not text.startswith("#VRML V2.0"):
        raise _VrmlError("this is no VRML 2.0 file", _OTHER)
    parser = _Parser([token for token in _TOKEN.findall(text) if token[0] != "#"])
    while parser.tokens:
        if parser.peek() == "ROUTE":
            del parser.tokens[-4:]
        else:
            yield parser.parse_node()


class _Parser:
    """Takes tokens off the end of a list, where the next one stands."""

    def __init__(self, tokens: list[str]) -> None:
        self.tokens = tokens[::-1]
        self.depth = 0
        self.known: dict[str, VrmlNode] = {}

    def peek(self) -> str:
        if not self.tokens:
            raise _VrmlError("the file is cut short", "Export it again.")
        return self.tokens[-1]

    def take(self) -> str:
        token = self.peek()
        self.tokens.pop()
        return token

    def parse_node(self) -> VrmlNode:
        word, name = self.take(), None
        if word in ("PROTO", "EXTERNPROTO"):
            raise _VrmlError("prototypes are not read", _OTHER)
        if word == "USE":
            name = self.take()
            if name not in self.known:
                raise _VrmlError(f"USE {name}: no node of this name comes ahead of it", _OTHER)
            return self.known[name]
        if word == "DEF":
            name, word = self.take(), self.take()
        if self.depth > _DEPTH:
            raise _VrmlError(f"its nodes are nested more than {_DEPTH} deep", None)
        if word == "Inline":
            raise _VrmlError("it includes other files (Inline), which are not read", _OTHER)
        if self.take() != "{":
            raise _VrmlError(f"a node was expected where {word!r} stands", _OTHER)
        made = VrmlNode(word, name)
        self.depth += 1
        while (key := self.take()) != "}":
            made.fields[key] = self.parse_value()
        self.depth -= 1
        if name:
            self.known[name] = made
        return made

    def parse_value(self) -> list[Any]:
        out = []
        if self.peek() == "[":
            self.take()
            while self.peek() != "]":
                out.append(self.parse_item())
            self.take()
            return out
        out.append(self.parse_item())
        while isinstance(out[-1], float) and _NUMBER.fullmatch(self.peek()):
            out.append(self.parse_item())
        return out

    def parse_item(self) -> Any:
        token = self.peek()
        if _NUMBER.fullmatch(token):
            self.take()
            return float(int(token, 16)) if token[:2] in ("0x", "0X") else float(token)
        if token in ("TRUE", "FALSE", "NULL", "IS") or token[0] == '"':
            return self.take()
        return self.parse_node()
