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

_TOKEN = re.compile(r'"(?:\\.|[^"\\])*"|[{}\[\]]|[^\s,{}\[\]"#]+|#[^\n\r]*')
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|0[xX][0-9a-fA-F]+")
_OTHER = "Export it as OBJ."
_DEPTH = 200  # nodes in nodes; beyond, a file is damaged


def parse_vrml(data: bytes, where: str) -> list[RawSurface]:
    """The surfaces of a VRML 2.0 file. Raises AssetError: not such a file, or shapes that are no face sets."""
    found: list[RawSurface] = []
    steps = itertools.count()
    try:
        for node in parse_nodes(data.decode("utf-8-sig", "replace"), where):
            _walk(node, np.eye(4), None, found, steps, where)
    except ValueError as error:
        raise AssetError(str(error), where=where, remedy=_OTHER) from error
    return check_surfaces(found, where)


def _walk(
    node: VrmlNode, world: Floats, name: str | None, found: list[RawSurface], steps: Iterator[int], where: str
) -> None:
    if next(steps) > _MOST:
        raise AssetError(f"it has more than {_MOST:,} nodes, most by USE", where=where, remedy=_OTHER)
    name = node.name or name
    if node.type == "Shape":
        for geometry in node.nodes("geometry"):
            found += _read_surface(geometry, world, node.name or name, where)
    if node.type in _PARENTS:
        world = world @ _transform_of(node) if node.type == "Transform" else world
        for key in ("children", "choice", "level"):
            for child in node.nodes(key):
                _walk(child, world, name, found, steps, where)


def _read_surface(node: VrmlNode, world: Floats, name: str | None, where: str) -> list[RawSurface]:
    if node.type in _SOLIDS:
        raise AssetError(f"shapes of kind {node.type} are not read", where=where, remedy=_OTHER)
    coordinates = node.nodes("coord")
    if node.type != "IndexedFaceSet" or not coordinates:
        return []
    numbers = coordinates[0].numbers("point")
    if len(numbers) % 3:
        raise AssetError("its points are not all of three numbers", where=where)
    if not np.isfinite(numbers).all():
        raise AssetError("a coordinate is not a finite number", where=where, remedy="Fix or export it again.")
    points = np.array(numbers, dtype=np.float64).reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]
    indices = node.numbers("coordIndex")
    if not all(x.is_integer() for x in indices):
        raise AssetError("a face names a vertex by a number that is not whole", where=where)
    if not all(-1 <= x < len(points) for x in indices):
        raise AssetError(f"a face names a vertex that is not there, there are {len(points)}", where=where)
    _, faces = cut_fans(_split_polygons([int(x) for x in indices]))
    return [RawSurface(name, points, faces[:, ::-1] if node.word("ccw") == "FALSE" else faces)]


def _split_polygons(indices: list[int]) -> list[list[int]]:
    polygons: list[list[int]] = [[]]
    for index in indices:
        if index == -1:
            polygons.append([])
        else:
            polygons[-1].append(index)
    return polygons


def _transform_of(node: VrmlNode) -> Floats:
    move = _translation_by(node.vector("translation", 3))
    center = node.vector("center", 3)
    turn = _rotation_by(node.vector("rotation", 4))
    lean = _rotation_by(node.vector("scaleOrientation", 4))
    scale = np.diag([*(node.vector("scale", 3) or [1.0, 1.0, 1.0]), 1.0])
    back = _translation_by([-x for x in center])
    with np.errstate(over="ignore", invalid="ignore"):  # vertices that are not finite are refused
        return move @ _translation_by(center) @ turn @ lean @ scale @ lean.T @ back


def _translation_by(offset: list[float]) -> Floats:
    matrix = np.eye(4)
    matrix[:3, 3] = offset or 0.0
    return matrix


def _rotation_by(rotation: list[float]) -> Floats:
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
        """The numbers of a field, none where it is not there."""
        return [x for x in self.fields.get(key, []) if isinstance(x, float)]

    def nodes(self, key: str) -> list[VrmlNode]:
        return [x for x in self.fields.get(key, []) if isinstance(x, VrmlNode)]

    def vector(self, key: str, size: int) -> list[float]:
        """The numbers of a field that has so many, none where it is not there. Raises ValueError: it has others."""
        found = self.numbers(key)
        if key in self.fields and len(found) != size:
            raise ValueError(f"the field {key} of a {self.type} needs {size} numbers")
        return found

    def word(self, key: str) -> str | None:
        return next((x for x in self.fields.get(key, []) if isinstance(x, str)), None)


def parse_nodes(text: str, where: str) -> list[VrmlNode]:
    """The nodes of a VRML 2.0 file. Raises AssetError: not such a file, cut short, or beyond what is read."""
    if not text.startswith("#VRML V2.0"):
        raise AssetError("this is no VRML 2.0 file", where=where, remedy=_OTHER)
    parser = _Parser([t for t in _TOKEN.findall(text) if t[0] != "#"], where)
    return list(parser.parse_all())


class _Parser:
    def __init__(self, tokens: list[str], where: str) -> None:
        self.tokens = tokens
        self.where = where
        self.at = 0
        self.depth = 0
        self.known: dict[str, VrmlNode] = {}

    def parse_all(self) -> Iterator[VrmlNode]:
        while self.at < len(self.tokens):
            if self.peek() == "ROUTE":
                self.at += 4
            else:
                yield self.parse_node()

    def peek(self) -> str:
        if self.at >= len(self.tokens):
            raise AssetError("the file is cut short", where=self.where, remedy="Export it again.")
        return self.tokens[self.at]

    def take(self) -> str:
        token = self.peek()
        self.at += 1
        return token

    def parse_node(self) -> VrmlNode:
        word, name = self.take(), None
        if word in ("PROTO", "EXTERNPROTO"):
            raise AssetError("prototypes are not read", where=self.where, remedy=_OTHER)
        if word == "USE":
            name = self.take()
            if name not in self.known:
                raise AssetError(f"USE {name}: no node of this name comes ahead of it", where=self.where, remedy=_OTHER)
            return self.known[name]
        if word == "DEF":
            name, word = self.take(), self.take()
        if self.depth > _DEPTH:
            raise AssetError(f"its nodes are nested more than {_DEPTH} deep", where=self.where)
        if word == "Inline":
            raise AssetError("it includes other files (Inline), which are not read", where=self.where, remedy=_OTHER)
        if self.take() != "{":
            raise AssetError(f"a node was expected where {word!r} stands", where=self.where, remedy=_OTHER)
        made = VrmlNode(word, name)
        self.depth += 1
        while self.peek() != "}":
            key = self.take()
            made.fields[key] = self.parse_value()
        self.at += 1
        self.depth -= 1
        if name:
            self.known[name] = made
        return made

    def parse_value(self) -> list[Any]:
        if self.peek() == "[":
            self.at += 1
            out = []
            while self.peek() != "]":
                out.append(self.parse_item())
            self.at += 1
            return out
        out = [self.parse_item()]
        while isinstance(out[-1], float) and _NUMBER.fullmatch(self.peek()):
            out.append(self.parse_item())
        return out

    def parse_item(self) -> Any:
        token = self.peek()
        if _NUMBER.fullmatch(token):
            self.at += 1
            return float(int(token, 16)) if token[:2] in ("0x", "0X") else float(token)
        if token in ("TRUE", "FALSE", "NULL", "IS") or token[0] == '"':
            return self.take()
        return self.parse_node()
