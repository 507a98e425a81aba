"""A scene that is begun from nothing: its tree, materials of one colour, and the files that it becomes."""

from __future__ import annotations

import copy
import json
from pathlib import Path
from urllib.parse import quote

import numpy as np

from meshforge.formats.gltf.reading.colors import GAMMA
from meshforge.formats.gltf.writing.draft import Draft
from meshforge.formats.meshfile.gltf import Container, Json, Scene
from meshforge.formats.visuals import Rgba


def bare_tree() -> Json:
    """The tree of a scene without nodes."""
    return {"asset": {"version": "2.0", "generator": "MeshForge"}, "scene": 0, "scenes": [{}]}


def new_draft(tree: Json, path: Path, is_binary: bool) -> Draft:
    """A draft of a tree that has nodes without meshes alone; path: for messages."""
    return Draft(Scene(copy.deepcopy(tree), None, path), tree, b"" if is_binary else None)


def material(tree: Json, rgba: Rgba | None) -> int | None:
    """The number of a material of a colour, which is added where it is not there yet."""
    if rgba is None:
        return None
    linear = [round(float(c), 6) for c in np.clip(rgba[:3], 0, 1) ** GAMMA]
    wanted: Json = {"pbrMetallicRoughness": {"baseColorFactor": [*linear, float(rgba[3])], "metallicFactor": 0.0}}
    if rgba[3] < 1:
        wanted["alphaMode"] = "BLEND"
    found: list[Json] = tree.setdefault("materials", [])
    if wanted not in found:
        found.append(wanted)
    return found.index(wanted)


def packed_new(draft: Draft, stem: str, is_binary: bool) -> tuple[bytes, dict[str, bytes]]:
    """The main file of a new scene, and the one of its buffer."""
    geometry, made = draft.geometry, dict[str, bytes]()
    geometry.finish(embed=False, uri=quote(f"{stem}.bin"))
    if is_binary:
        text = json.dumps(draft.tree, separators=(",", ":")).encode()
        return Container(text, True).with_text(text, geometry.chunk).as_bytes(), made
    made[f"{stem}.bin"] = bytes(geometry.added)
    return (json.dumps(draft.tree, indent=2) + "\n").encode(), made
