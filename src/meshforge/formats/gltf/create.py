"""Making a glTF file of an asset of another format: a node for each hull, below a node for each body."""

from __future__ import annotations

import copy
import json
from pathlib import PurePosixPath
from urllib.parse import quote

import numpy as np

from meshforge.asset import Asset, Geom, Opaque, Surface, What
from meshforge.errors import AssetError
from meshforge.formats.base import Output
from meshforge.formats.gltf.document import BODY, Convention, GltfDocument
from meshforge.formats.gltf.reading.colors import GAMMA
from meshforge.formats.gltf.reading.motions import motion_of
from meshforge.formats.gltf.reading.names import godot_kind, unreal_kind
from meshforge.formats.gltf.reading.physics import KHR
from meshforge.formats.gltf.writing.draft import Draft
from meshforge.formats.gltf.writing.naming import settle
from meshforge.formats.gltf.writing.physics_style import PhysicsStyle
from meshforge.formats.gltf.writing.plain_style import PlainStyle
from meshforge.formats.gltf.writing.shape_entries import place_keys
from meshforge.formats.losses import Loss
from meshforge.formats.meshfile.gltf import Container, Json, Scene
from meshforge.formats.visual_files import visuals_of
from meshforge.formats.visuals import Rgba, Visual

HOLDS = frozenset(
    {
        What.NAMES,
        What.BODIES,
        What.BOXES,
        What.SPHERES,
        What.CYLINDERS,
        What.CAPSULES,
        What.OPAQUE,
        What.PLANES,
        What.MASSES,
        What.VISUALS,
        What.COLORS,
    }
)
COULD = frozenset(
    {
        What.JOINTS,
        What.BALL_JOINTS,
        What.FIXED_JOINTS,
        What.MATERIALS,
        What.VERTEX_COLORS,
        What.TEXTURES,
        What.TEXTURE_COORDINATES,
        What.CONTACT,
        What.PAIRS,
        What.CAMERAS,
        What.LIGHTS,
        What.ANIMATIONS,
        What.SKINS,
    }
)


def create_gltf(asset: Asset, name: str) -> Output:
    """The files of an asset that came from another format.

    One body of nothing but hull meshes becomes plain nodes. Else colliders of KHR_physics_rigid_bodies hold bodies and
    native shapes; where the asset shows nothing, a mesh on each collider's node shows that.
    """
    is_binary = PurePosixPath(name).suffix.lower() == ".glb"
    return _Creator(asset, "plain" if _is_plain(asset) else "khr", is_binary).output(PurePosixPath(name).stem)


def _is_plain(asset: Asset) -> bool:
    names = [geom.name for geom in asset.geoms] + [piece.name for piece in asset.opaque]
    return (
        [body.name for body in asset.bodies] in ([BODY], [])
        and not len(asset.visuals)
        and not any(geom.shape.is_primitive for geom in asset.geoms)
        and not any(piece.plane for piece in asset.opaque)
        and not any(unreal_kind(name) or godot_kind(name) for name in names)
    )


class _Creator:
    def __init__(self, asset: Asset, convention: Convention, is_binary: bool) -> None:
        self.asset, self.convention, self.is_binary = asset, convention, is_binary
        self.lost: list[Loss] = []
        tree = self._bodies()
        self.nodes: dict[str, int] = {node["name"]: k for k, node in enumerate(tree.get("nodes", []))}
        self.draft = Draft(Scene(copy.deepcopy(tree), None, asset.path), tree, b"" if is_binary else None)

    def output(self, stem: str) -> Output:
        shown = self._shown() if self.convention == "khr" else []
        style = PlainStyle(self.draft) if self.convention == "plain" else PhysicsStyle(self.draft, "khr", not shown)
        for geom in self.asset.geoms:
            style.make(geom, self._own(geom), self.nodes.get(geom.body), None)
        for piece in self.asset.opaque:
            self._opaque(style, piece)
        if not self.draft.expected:
            raise AssetError("there is no hull to write", where=str(self.asset.path))
        for body, surface, rgba in shown:
            self._show(body, surface, rgba)
        renamed = self._renamed()
        main, made = _packed(self.draft, stem, self.is_binary)
        return Output(main, made, names=renamed, lost=tuple(self.lost))

    def _renamed(self) -> dict[str, str]:
        """The hulls that read back under other names, with these."""
        bodies = tuple((node, body) for body, node in self.nodes.items())
        names = settle(self.draft, GltfDocument(b"", self.convention, (), bodies), renames=True)
        hulls = {geom.name for geom in self.asset.geoms}
        return {old: now for old, now in names.items() if old in hulls}

    def _bodies(self) -> Json:
        """A tree with a node for each body but the one that all formats without bodies have."""
        tree: Json = {"asset": {"version": "2.0", "generator": "MeshForge"}, "scene": 0, "scenes": [{}]}
        if self.convention == "plain":
            return tree
        tree["extensionsUsed"] = [KHR]
        moving = [body for body in self.asset.bodies if body.name != BODY]
        nodes = [
            {"name": body.name, **place_keys(body.pose), "extensions": {KHR: {"motion": motion_of(self.asset, body)}}}
            for body in moving
        ]
        if nodes:
            tree["scenes"][0]["nodes"] = list(range(len(nodes)))
            tree["nodes"] = nodes
        return tree

    def _own(self, thing: Geom | Opaque) -> str:
        return thing.name.removeprefix(f"{thing.body}/") if self.nodes else thing.name

    def _opaque(self, style: PlainStyle | PhysicsStyle, piece: Opaque) -> None:
        """A piece as its triangles, or as a plane; one that is neither is told in the report."""
        if piece.plane is not None and isinstance(style, PhysicsStyle):
            style.make_plane(piece, self._own(piece), self.nodes.get(piece.body))
        elif piece.surface is not None and len(piece.surface.faces):
            style.make_opaque(piece, piece.surface, self._own(piece), self.nodes.get(piece.body))

    def _shown(self) -> list[tuple[str, Surface, Rgba | None]]:
        """What the bodies show."""
        found: list[tuple[str, Surface, Rgba | None]] = []
        refused = []
        for body, visual in visuals_of(self.asset):
            surfaces = visual.surfaces() if isinstance(visual, Visual) else [visual]
            found += [(body, surface, visual.rgba) for surface in surfaces if len(surface.faces)]
            if not surfaces:
                refused.append(body)
        if refused:
            self.lost.append(Loss(What.VISUALS, tuple(dict.fromkeys(refused)), "their files cannot be read"))
        return found

    def _show(self, body: str, surface: Surface, rgba: Rgba | None) -> None:
        """A node that shows a surface."""
        holder, name = self.nodes.get(body), f"{body}-visual"
        points = self.draft.points_in(np.asarray(surface.vertices), holder)
        mesh, middle = self.draft.surface_mesh(points, surface.faces, name, self._material(rgba))
        self.draft.add_node({"name": name, "mesh": mesh, "translation": middle.tolist()}, holder)

    def _material(self, rgba: Rgba | None) -> int | None:
        """The number of a material of a colour."""
        if rgba is None:
            return None
        linear = [round(float(c), 6) for c in np.clip(rgba[:3], 0, 1) ** GAMMA]
        wanted: Json = {"pbrMetallicRoughness": {"baseColorFactor": [*linear, float(rgba[3])], "metallicFactor": 0.0}}
        if rgba[3] < 1:
            wanted["alphaMode"] = "BLEND"
        found: list[Json] = self.draft.tree.setdefault("materials", [])
        if wanted not in found:
            found.append(wanted)
        return found.index(wanted)


def _packed(draft: Draft, stem: str, is_binary: bool) -> tuple[bytes, dict[str, bytes]]:
    """The main file of a new scene, and the one of its buffer."""
    geometry, made = draft.geometry, dict[str, bytes]()
    geometry.finish(embed=False, uri=quote(f"{stem}.bin"))
    if is_binary:
        text = json.dumps(draft.tree, separators=(",", ":")).encode()
        return Container(text, True).with_text(text, geometry.chunk).as_bytes(), made
    made[f"{stem}.bin"] = bytes(geometry.added)
    return (json.dumps(draft.tree, indent=2) + "\n").encode(), made
