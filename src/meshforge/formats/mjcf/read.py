"""Reading an MJCF: its files, unless they are fragments or too large, through MuJoCo to an asset with visuals."""

import math
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

import numpy as np

from meshforge.common import AssetError, MeshForgeError, join_names, plain_path, pluralize
from meshforge.formats.libraries import mujoco
from meshforge.formats.mesh_reader import READABLE_MESH_SUFFIXES, read_content
from meshforge.formats.mjcf import collision_only, references
from meshforge.formats.mjcf.document import MjcfDocument, MjcfNode, MjcfTree, read_tree
from meshforge.formats.mjcf.model import MjcfModel, compile_tree, read_mechanism
from meshforge.formats.visuals import Visual, VisualSurfaces
from meshforge.formats.xml import Element, XmlText, parse_xml
from meshforge.geometry import Polytope, rotation_of_quaternion
from meshforge.symbolic import Asset, Body, FileNote

_LEVELS = 3  # folders above a fragment in which a file that includes it may lie
_MOST_FILES, _MOST_BYTES = 200, 2_000_000  # looked at in each folder, and read of each file

_MOST_COPIES = 10_000  # of which MuJoCo's time is the square: about ten seconds
_MOST_PRODUCTS = {
    "hfield": (("nrow", "ncol"), 4_000_000),
    "flexcomp": (("count",), 1_000_000),
    "texture": (("width", "height"), 300_000_000),
}
"""Elements whose attributes multiply, and how much of it is taken."""
_FINEST = 1000  # parameter of a built-in mesh, of which some have the square of a parameter of vertices

_SHOWN_GROUPS = 3  # MuJoCo's viewers show the groups 0, 1 and 2


def read_mjcf(path: Path, files: Mapping[Path, bytes] | None = None) -> Asset:
    """Return the asset in an MJCF, its includes and collision meshes taken in; files: contents that count instead of
    those on disk, of the main file and of includes.

    Raises AssetError naming file and line: text that is not understood, an include or a collision mesh that is not
    there, a model whose collision geometry MuJoCo refuses too.
    """
    tree = _gather_model(path, files)
    _refuse_excess(tree)
    found, missing = references.find_files(tree)  # before MuJoCo looks for any of them
    try:
        compiled, refusal = compile_tree(tree), ""
    except AssetError as error:
        place = Path(error.where or "").name
        refusal = f"{error.problem} ({place})" if ":" in place else error.problem
        compiled = collision_only.strip_to_collision(tree, error)
    geoms, non_convex = compiled.read_pieces()
    return Asset(
        path=path,
        format="mjcf",
        bodies=tuple(map(Body, compiled.body_names, compiled.body_poses)),
        geoms=geoms,
        document=MjcfDocument(tree.sources, compiled.collision_names, refusal),
        non_convex=non_convex,
        visuals=read_visuals(compiled),
        files=found,
        missing=missing,
        needed=missing,  # MuJoCo opens no model without them
        notes=_collect_notes(compiled, refusal),
        mechanism=read_mechanism(compiled),
    )


def _collect_notes(compiled: MjcfModel, refusal: str) -> tuple[str, ...]:
    notes = [FileNote(f"{refusal}; read for its collision geometry only")] if refusal else []
    notes += [FileNote(f"MuJoCo refuses this file: {fault}") for fault in compiled.tree.faults]
    notes += [FileNote(f"MuJoCo warns: {warning}") for warning in compiled.warnings]
    if flexible := int(compiled.model.nflex):
        bodies = pluralize(flexible, "flexible body", "flexible bodies")
        notes.append(FileNote(f"{bodies}: no hulls, left as authored"))
    return tuple(notes)


def _gather_model(path: Path, files: Mapping[Path, bytes] | None = None) -> MjcfTree:
    """The tree of a file that is a model. Raises AssetError; for a fragment, one that names what to open instead."""
    try:
        tree = read_tree(path, files)
    except AssetError:  # an include of a fragment is found from the folder of the model
        if files:
            raise
        _refuse_fragment(plain_path(path), parse_xml(XmlText.of(read_content(path)).data, str(path)))
        raise
    _refuse_fragment(tree.main.path, tree.root.element)
    return tree


def _refuse_fragment(path: Path, root: Element) -> None:
    tag, where = root.tag, f"{path}:{root.line}"
    if tag.lower() == "mujoco":
        return
    homes = []
    for folder in [path.parent, *path.parent.parents[:_LEVELS]]:
        with suppress(OSError):
            homes += [near for near in sorted(folder.glob("*.xml"))[:_MOST_FILES] if _has_include_of(near, path)]
    if homes or tag == "mujocoinclude":
        remedy = f"Open the file that includes it; none was found in its folder or the {_LEVELS} above."
        if homes:
            verb = "includes" if len(homes) == 1 else "include"
            remedy = f"Open {join_names([str(home) for home in homes], 3)}, which {verb} it."
        raise AssetError(f"is a part of a model, to be included by another file: <{tag}>", where=where, remedy=remedy)
    problem = f"is no MJCF: its root element is <{tag}>, not <mujoco>"
    raise AssetError(problem, where=where, remedy="It is a URDF: name it .urdf." if tag == "robot" else None)


def _has_include_of(path: Path, fragment: Path) -> bool:
    try:
        if path == fragment or not path.is_file() or path.stat().st_size > _MOST_BYTES:
            return False
        if b"<include" not in path.read_bytes():
            return False
        tree = read_tree(path)
    except (MeshForgeError, OSError):
        return False
    return tree.root.tag.lower() == "mujoco" and any(source.path == fragment for source in tree.sources)


def _refuse_excess(tree: MjcfTree) -> None:
    """Raise AssetError with `file:line` for replicated elements, grids, textures or meshes without measure."""
    waiting: list[tuple[MjcfNode, float]] = [(tree.root, 1.0)]
    copies = 0.0
    while waiting:
        node, times = waiting.pop()
        if node.tag == "replicate":
            times *= max(_product(node, ("count",)), 1.0)
        elif times > 1:
            copies += times
        if copies > _MOST_COPIES:
            raise AssetError(f"<replicate> makes more than {_MOST_COPIES:,} elements", where=tree.where(node))
        if excess := _describe_excess(node):
            raise AssetError(f"this <{node.tag}> is too large to be made: {excess}", where=tree.where(node))
        waiting.extend((child, times) for child in node.children)


def _describe_excess(node: MjcfNode) -> str:
    if node.tag == "mesh" and "builtin" in node.attributes:
        names: tuple[str, ...] = ("params",)
        too_large = max(_read_numbers(node, names), default=0.0) > _FINEST
    else:
        names, most = _MOST_PRODUCTS.get(node.tag, ((), 0))
        too_large = _product(node, names) > most
    return " ".join(f'{name}="{node.attributes[name]}"' for name in names if too_large and name in node.attributes)


def _product(node: MjcfNode, names: tuple[str, ...]) -> float:
    return math.prod(max(number, 1.0) for number in _read_numbers(node, names))


def _read_numbers(node: MjcfNode, names: tuple[str, ...]) -> list[float]:
    """The numbers in some attributes; what cannot be read is left to MuJoCo to refuse."""
    found = []
    for word in (word for name in names for word in node.attributes.get(name, "").split()):
        try:
            found.append(float(word))
        except ValueError:
            continue
    return found


def read_visuals(compiled: MjcfModel) -> VisualSurfaces:
    """Return the visuals of all bodies."""
    meshes = {mesh.id: mesh for mesh in compiled.spec.meshes}
    folders = references.AssetFolders(compiled.tree)
    shown = (k for k in range(compiled.model.ngeom) if k not in compiled.stand_ins)
    found = (_read_visual(compiled, k, meshes, folders) for k in shown)
    return VisualSurfaces(tuple(visual for visual in found if visual))


def _read_visual(
    compiled: MjcfModel, k: int, meshes: Mapping[int, mujoco.MjsMesh], folders: references.AssetFolders
) -> Visual | None:
    """What a geom shows, None where it is hidden; height fields and planes are non-convex pieces already."""
    model, body, pose = compiled.model, compiled.body_of[k], compiled.geom_poses[k]
    material, mesh = int(model.geom_matid[k]), int(model.geom_dataid[k])
    red, green, blue, alpha = map(float, model.mat_rgba[material] if material >= 0 else model.geom_rgba[k])
    rgba = red, green, blue, alpha
    is_mesh = mesh >= 0 and model.geom_type[k] != mujoco.mjtGeom.mjGEOM_HFIELD
    if alpha <= 0 or (compiled.collides[k] and not (is_mesh and model.geom_group[k] < _SHOWN_GROUPS)):
        return None
    if (shape := compiled.primitive_of(k)) is not None:
        return Visual(body, shape, np.eye(3), np.zeros(3), rgba)
    if not is_mesh:
        return None
    first = meshes.get(mesh)
    node = compiled.flat.node_at(first.info) if first else None
    path = folders.find(node) if node and node.attributes.get("file") else None
    if first and path and path.suffix.lower() in READABLE_MESH_SUFFIXES:
        placed = pose @ compiled.mesh_frame(mesh).inverse()  # the reference pose moves vertices first of all
        linear = placed.rotation * model.mesh_scale[mesh] @ rotation_of_quaternion(first.refquat).T
        return Visual(body, path, linear, placed.translation - linear @ np.asarray(first.refpos), rgba)
    surface = compiled.mesh_surface(mesh, pose)  # of the model itself, or of a kind of file that only MuJoCo reads
    return Visual(body, Polytope(surface.vertices, surface.faces), np.eye(3), np.zeros(3), rgba)
