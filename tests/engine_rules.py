"""What engines make of names, told anew from their sources and manuals, to judge files that are named for them.

Unreal: InterchangeMeshLODDataParser (GetCollisionMeshType) and FbxMainImport (FillCollisionModelList); Godot:
ResourceImporterScene (_teststr, _pre_fix_node); Unity: what a script finds below a node by its name.
"""

from __future__ import annotations

from collections.abc import Collection

UNREAL = ("UCX_", "UBX_", "USP_", "UCP_")
FBX = ("UCX", "UBX", "USP", "UCP", "MCDCX")
GODOT = ("noimp", "col", "convcol", "colonly", "convcolonly", "rigid", "navmesh", "vehicle", "wheel", "occ", "occonly")


def unreal_target(name: str, meshes: Collection[str]) -> str | None:
    """The mesh that a collision mesh goes to: called as what follows the prefix, else that without its last `_...`."""
    if not name.upper().startswith(UNREAL):
        return None
    by_name = {mesh.lower(): mesh for mesh in meshes}
    rest = name.partition("_")[2].lower()
    return by_name.get(rest) or by_name.get(rest.rpartition("_")[0])


def looks_like_collision_to_fbx(name: str) -> bool:
    """Whether the FBX importer, which reads OBJ, too, looks for a mesh that this one belongs to."""
    return any(word in name for word in FBX)


def godot_word(name: str) -> str | None:
    """The word by which Godot makes something else of a node."""
    text = name.rstrip("0123456789_" + "".join(map(chr, range(33)))).lower()
    found = [w for w in GODOT if f"${w}" in text or text.endswith((f"-{w}", f"_{w}"))]
    return max(found, key=len, default=None)
