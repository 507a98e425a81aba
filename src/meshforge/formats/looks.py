"""Mesh files of visuals with what they look like: an OBJ with its material libraries, Collada, and glTF."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import unquote

import numpy as np

from meshforge.common import is_file
from meshforge.formats import mesh_reader
from meshforge.formats.meshfile import obj
from meshforge.formats.meshfile.dae import parse_dae_looks
from meshforge.formats.meshfile.gltf_document import report_damage
from meshforge.formats.meshfile.gltf_looks import split_by_look
from meshforge.formats.meshfile.gltf_scene import GltfScene
from meshforge.formats.references import Resolver, find_companions
from meshforge.geometry import Floats, Ints
from meshforge.symbolic import Picture, Rgba, Surface, Texture

LOOK_SUFFIXES = (".obj", ".dae", ".glb", ".gltf")
"""The mesh files whose base colours and pictures `read_looks` reads."""

_OPTIONS = re.compile(r"(?:-\w+(?:\s+[-+.\d]\S*|\s+(?:on|off))*\s+)*")
_CORNER = re.compile(rb"(-?\d+)(?:/(-?\d+)?)?")


def read_looks(path: Path) -> list[Surface]:
    """The surfaces of a mesh file, apart where they look different, with their base colours or pictures.

    Raises AssetError: it cannot be read.
    """
    if path.suffix.lower() == ".obj":
        return _read_obj(path)
    if path.suffix.lower() == ".dae":
        return _read_dae(path)
    if path.suffix.lower() in LOOK_SUFFIXES:
        return _read_gltf(path)
    return [Surface(surface.vertices, surface.faces) for surface in mesh_reader.read_triangles(path)]


def _read_gltf(path: Path) -> list[Surface]:
    found: list[Surface] = []
    with report_damage(str(path)):
        scene = GltfScene.of(mesh_reader.read_content(path), path)
        for placement in scene.placements.values():
            if "mesh" not in placement.node:
                continue
            mesh, linear, offset = scene.place_mesh(placement)
            turned = np.linalg.det(linear) < 0
            for part, rgba, texture in split_by_look(scene, placement.node["mesh"], mesh):
                faces = part.faces[:, ::-1] if turned else part.faces
                found.append(Surface(part.vertices @ linear.T + offset, faces, None, rgba, texture))
    return found


@dataclass(frozen=True, slots=True)
class _Material:
    """A material of a library: its colour, and the picture that has it instead."""

    rgba: Rgba | None = None
    picture: Picture | None = None


def _read_obj(path: Path) -> list[Surface]:
    data = mesh_reader.read_content(path)
    plain = [Surface(surface.vertices, surface.faces) for surface in mesh_reader.parse_surfaces(data, path)]
    materials = _read_materials(path)
    if not materials:
        return plain
    parsed = obj.parse_obj(data, str(path))
    of_face, names = parsed.materials()
    try:
        corners, places = _read_corners(parsed)
    except ValueError:  # a coordinate is no number
        corners, places = None, np.zeros((0, 2))
    found: list[Surface] = []
    for k in np.unique(of_face):
        material, own = materials.get(names[k], _Material()), of_face == k
        of_own = None if corners is None else corners[own]
        found.append(_build_surface(parsed.vertices, parsed.faces[own], material, of_own, places))
    return found


def _build_surface(vertices: Floats, faces: Ints, material: _Material, corners: Ints | None, places: Floats) -> Surface:
    """Triangles of one material, with the vertices that they use; a picture only where every corner has its place."""
    if material.picture is None or corners is None or not ((corners >= 0) & (corners < len(places))).all():
        used, numbers = np.unique(faces, return_inverse=True)
        return Surface(vertices[used], numbers.reshape(-1, 3), None, material.rgba)
    pairs, numbers = np.unique(np.column_stack([faces.ravel(), corners.ravel()]), axis=0, return_inverse=True)
    texture = Texture(places[pairs[:, 1]], material.picture)
    return Surface(vertices[pairs[:, 0]], numbers.reshape(-1, 3), None, None, texture)


def _read_dae(path: Path) -> list[Surface]:
    resolver, pictures = Resolver(path.parent), dict[str, Picture | None]()
    found = list[Surface]()
    for part in parse_dae_looks(mesh_reader.read_content(path), str(path)):
        if part.image and part.image not in pictures:
            file = resolver.find(part.image) or resolver.find(unquote(part.image))
            pictures[part.image] = Picture.of(_read_or_empty(file)) if file else None
        material = _Material(part.rgba, pictures.get(part.image))
        found.append(_build_surface(part.vertices, part.faces, material, part.corners, part.places))
    return found


def _read_corners(parsed: obj.ObjText) -> tuple[Ints | None, Floats]:
    """The number of the texture coordinate (m, 3) of each corner of the triangles, and all coordinates (n, 2).

    None where the text does not say them as the triangles need it.
    """
    places: list[list[float]] = []
    found: dict[int, list[int]] = {}
    wanted = set(parsed.face_at.tolist())
    for k, statement in enumerate(parsed.statements):
        if k in wanted:
            found[k] = [_number_of(word, len(places)) for word in obj.arguments(statement)]
        elif statement.lstrip()[:3] in (b"vt ", b"vt\t"):
            places.append([float(word) for word in (*obj.arguments(statement), b"0")[:2]])
    corners: list[list[int]] = []
    at, step = -1, 0
    for k in parsed.face_at.tolist():
        at, step = (k, step + 1) if k == at else (k, 0)
        own = found[k]
        if step + 2 >= len(own):
            return None, np.zeros((0, 2))
        corners.append([own[0], own[step + 1], own[step + 2]])
    numbers, all_places = np.array(corners, dtype=np.int64), np.array(places, dtype=np.float64).reshape(-1, 2)
    fits = (numbers < len(all_places)).all() and np.isfinite(all_places).all()
    return (numbers if fits else None), all_places


def _number_of(corner: bytes, count: int) -> int:
    """The texture coordinate of a corner, from 0, of so many that there are by then; -1 for none."""
    match = _CORNER.match(corner)
    if match is None or match[2] is None:
        return -1
    number = int(match[2])
    return number - 1 if number > 0 else count + number


def _read_materials(path: Path) -> dict[str, _Material]:
    """The materials of the libraries of an OBJ that are there, by name."""
    found: dict[str, _Material] = {}
    companions = find_companions(path)
    for key, library in companions.items():
        if library.suffix.lower() == ".mtl":
            for name, lines in _split_library(_read_or_empty(library).decode("utf-8", "replace")):
                found.setdefault(name, _parse_material(lines, path.parent / Path(key).parent))
    return found


def _read_or_empty(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError:
        return b""


def _split_library(text: str) -> Iterator[tuple[str, list[tuple[str, str]]]]:
    """The materials of a library: each with the words of its lines, lower case, and what follows them."""
    name, lines = "", list[tuple[str, str]]()
    for line in text.splitlines():
        word, _, rest = line.strip().partition(" ") if " " in line.strip() else line.strip().partition("\t")
        if word == "newmtl":
            if name:
                yield name, lines
            name, lines = rest.strip(), []
        elif word and not word.startswith("#"):
            lines.append((word.lower(), rest.strip()))
    if name:
        yield name, lines


def _parse_material(lines: list[tuple[str, str]], folder: Path) -> _Material:
    said = dict(lines)
    picture = None
    if reference := said.get("map_kd"):
        path = folder / _OPTIONS.sub("", reference, count=1).replace("\\", "/")
        picture = Picture.of(_read_or_empty(path)) if is_file(path) else None
    try:
        red, green, blue = (float(word) for word in said["kd"].split()[:3])
        alpha = float(said["d"].split()[-1]) if "d" in said else 1 - float(said.get("tr", "0").split()[-1])
    except (KeyError, ValueError, IndexError):
        return _Material(None, picture)
    rgba = tuple(float(np.clip(share, 0, 1)) for share in (red, green, blue, alpha))
    return _Material((rgba[0], rgba[1], rgba[2], rgba[3]) if np.isfinite(rgba).all() else None, picture)
