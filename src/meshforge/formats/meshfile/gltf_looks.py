"""How the parts of a glTF mesh look: the base colour of their material, or the picture that it has for that."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any
from urllib.parse import unquote

import numpy as np

from meshforge.common import MeshForgeError, is_file
from meshforge.formats.meshfile.gltf_buffers import decode_data_uri
from meshforge.formats.meshfile.gltf_document import Json, entries, entry, extension
from meshforge.formats.meshfile.gltf_meshes import GltfMesh, GltfPrimitive
from meshforge.formats.meshfile.gltf_scene import GltfScene
from meshforge.formats.meshfile.surface import GAMMA
from meshforge.geometry import Floats
from meshforge.symbolic import Picture, Rgba, Texture

_TRANSFORM = "KHR_texture_transform"
_DAMAGE = (ValueError, LookupError, TypeError, AttributeError, OSError, MeshForgeError)


@dataclass(frozen=True, eq=False, slots=True)
class _Look:
    """rgba: of the base colour, None where a picture has it, or nothing; picture: with what of the file places it."""

    rgba: Rgba | None = None
    picture: Picture | None = None
    place: Json | None = None

    def is_same(self, other: _Look) -> bool:
        return self.rgba == other.rgba and self.picture == other.picture and self.place == other.place


def split_by_look(
    scene: GltfScene, mesh: int, whole: GltfMesh
) -> Iterator[tuple[GltfMesh, Rgba | None, Texture | None]]:
    """The triangles of a mesh, apart where its parts look different; whole: of it, wherever its vertices are.

    Raises ValueError and the like where a material is damaged; a picture that cannot be read is left out.
    """
    if not len(whole.faces):
        return
    parts = entries(entry(scene.tree, "meshes", mesh), "primitives")
    looks = [_read_look(scene, parts[patch.index].get("material")) for patch in whole.patches]
    if all(look.is_same(looks[0]) for look in looks):
        yield whole, looks[0].rgba, _read_texture(scene, parts, whole.patches, looks[0])
        return
    start = 0
    for patch, look in zip(whole.patches, looks, strict=True):
        end = start + len(patch.points)
        part = GltfMesh(whole.vertices[start:end], patch.faces, (patch,))
        yield part, look.rgba, _read_texture(scene, parts, [patch], look)
        start = end


def _read_look(scene: GltfScene, material: int | None) -> _Look:
    shading = {} if material is None else entry(scene.tree, "materials", material).get("pbrMetallicRoughness", {})
    if "baseColorTexture" in shading:
        return _Look(None, _read_picture(scene, shading["baseColorTexture"]), shading["baseColorTexture"])
    factor = shading.get("baseColorFactor")
    if factor is None or len(factor) != 4:
        return _Look()
    red, green, blue = (np.clip(np.asarray(factor[:3], dtype=np.float64), 0, 1) ** (1 / GAMMA)).tolist()
    return _Look((round(red, 4), round(green, 4), round(blue, 4), float(factor[3])))


def _read_picture(scene: GltfScene, texture: Json) -> Picture | None:
    """The picture of a texture, None where it is of another kind, or not there."""
    try:
        image = entry(scene.tree, "images", entry(scene.tree, "textures", texture["index"])["source"])
        if "bufferView" in image:
            return Picture.of(scene.buffers.view(image["bufferView"]))
        uri = image["uri"]
        if uri.startswith("data:"):
            return Picture.of(decode_data_uri(uri))
        path = scene.path.parent / unquote(uri)
        return Picture.of(path.read_bytes()) if is_file(path) else None
    except _DAMAGE:
        return None


def _read_texture(
    scene: GltfScene, parts: Sequence[Json], patches: Sequence[GltfPrimitive], look: _Look
) -> Texture | None:
    """Where the picture of a look is on some patches; None where one of them does not say it."""
    if look.picture is None or look.place is None:
        return None
    try:
        own = extension(look.place, _TRANSFORM) or {}
        name = f"TEXCOORD_{own.get('texCoord', look.place.get('texCoord', 0))}"
        found = [_read_coordinates(scene, parts[patch.index], patch, name) for patch in patches]
    except _DAMAGE:
        return None
    places = _transform(np.concatenate(found), own)
    return Texture(np.column_stack([places[:, 0], 1 - places[:, 1]]), look.picture)  # v counts downwards in glTF


def _read_coordinates(scene: GltfScene, part: Json, patch: GltfPrimitive, name: str) -> Floats:
    if patch.decoded is not None and name in patch.decoded.attributes:
        values: Any = patch.decoded.attributes[name]
    else:
        values = scene.buffers.accessor(part["attributes"][name])
    if values.shape != (len(patch.points), 2) or not np.isfinite(values).all():
        raise ValueError("texture coordinates do not fit the vertices")
    return np.asarray(values, dtype=np.float64)


def _transform(places: Floats, own: Json) -> Floats:
    """Texture coordinates (n, 2) moved, turned and scaled as an extension says."""
    angle = float(own.get("rotation", 0.0))
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    scaled = places * np.asarray(own.get("scale", (1.0, 1.0)), dtype=np.float64)
    return np.asarray(scaled @ turn.T + np.asarray(own.get("offset", (0.0, 0.0)), dtype=np.float64))
