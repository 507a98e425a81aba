"""Files that MuJoCo refuses, stripped to their collision geometry: what that does not need is left out of the text."""

import tomllib
from collections.abc import Mapping
from dataclasses import replace
from math import isnan
from pathlib import Path
from typing import Literal

from meshforge.common import AssetError, MissingFilesError, is_file
from meshforge.formats import mesh_reader, references
from meshforge.formats.libraries import mujoco
from meshforge.formats.mjcf import compiler
from meshforge.formats.mjcf.document import MjcfNode, MjcfTree
from meshforge.formats.mjcf.model import MjcfModel
from meshforge.formats.mjcf.references import AssetFolders

_NEEDED = tomllib.loads(Path(__file__).with_name("collision_elements.toml").read_text(encoding="utf-8"))
"""The elements that collision geometry, masses and joints need, and their attributes."""
_WHOLE = ("extension", "plugin", "instance", "config")  # of signed distance fields
_FIXED = {"pos": "0 0 0", "mass": "1", "diaginertia": "1 1 1"}
_LEAST_MASS, _LEAST_INERTIA = 1e-9, 1e-12  # [kg], [kg m^2] above what MuJoCo asks of moving bodies

_Masses = Literal["authored", "fixed", "none"]


def strip_to_collision(tree: MjcfTree, refusal: AssetError, masses: Literal["fixed", "none"] = "none") -> MjcfModel:
    """Return the model of the collision geometry of a tree that MuJoCo refuses as a whole.

    masses: what stands for authored masses that are refused: ones that no geom changes, or those of the geoms.
    Raises AssetError: a collision mesh that is not there; else `refusal`, where the collision geometry is refused too.
    """
    last, repaired = refusal, _repair_defaults(tree)
    attempts: list[tuple[bool, _Masses]] = [(False, "authored"), (True, "authored"), (True, masses)]
    for all_visuals, of_masses in attempts:

        def keep(node: MjcfNode, masses: _Masses = of_masses) -> Mapping[str, str] | None:
            if node.tag == "inertial" and masses != "authored":
                return _FIXED if masses == "fixed" else None
            if node.tag in _WHOLE or node.tag not in _NEEDED:
                return node.attributes if node.tag in _WHOLE else None
            kept = _NEEDED[node.tag].split()
            return {name: value for name, value in node.attributes.items() if name in kept}

        flat = compiler.flatten(repaired, keep)
        try:
            spec = compiler.parse_text(flat)
        except AssetError as error:
            last = error
            continue
        infos = _replace_visuals(flat, spec, all_visuals)
        try:
            made = compiler.compile_spec(flat, spec)
        except AssetError as error:
            last = error
            continue
        stand_ins = frozenset(geom.id for geom in made.geoms if geom.info in infos)
        weighing = [geom.id for geom in made.geoms if infos.get(geom.info)]
        return MjcfModel(tree, made, False, stand_ins, frozenset(made.model.geom_bodyid[weighing].tolist()))
    if last.message != refusal.message:
        remedy = f"Once that is fixed, the next problem is: {last.message}"
        refusal = AssetError(refusal.problem, where=refusal.where, remedy=remedy)
    raise refusal


def _repair_defaults(tree: MjcfTree) -> MjcfTree:
    """The tree with one top-level `<default>`, each class in it once, as older versions of MuJoCo understood others.

    What a first one with a name says counts for all; further ones are classes inside it; a class that is there twice
    is one; one without a name, which nothing can use, goes.
    """
    tops = [node for node in tree.root.children if node.tag == "default"]
    if not tops:
        return tree
    main = MjcfNode(replace(tops[0].element, attributes={}), tops[0].source)
    classes = {"main": main}
    waiting = [(node, main, True) for node in reversed(tops)]
    while waiting:
        node, holder, is_top = waiting.pop()
        name = node.attributes.get("class", "main" if is_top else "")
        if not name:
            continue
        if name not in classes:
            classes[name] = MjcfNode(node.element, node.source)
            holder.children.append(classes[name])
        target = main if node is tops[0] else classes[name]
        for child in node.children:
            if child.tag != "default":
                _add_setting(target, child)
        waiting += [(child, target, False) for child in reversed(node.children) if child.tag == "default"]
    children = [main if node is tops[0] else node for node in tree.root.children if node not in tops[1:]]
    return replace(tree, root=MjcfNode(tree.root.element, tree.root.source, children))


def _add_setting(target: MjcfNode, child: MjcfNode) -> None:
    """Add what a class says of one kind of element; a second time, it adds to what was said before."""
    for k, known in enumerate(target.children):
        if known.tag == child.tag:
            element = replace(known.element, attributes={**known.attributes, **child.attributes})
            target.children[k] = MjcfNode(element, known.source, known.children)
            return
    target.children.append(child)


def _replace_visuals(flat: compiler.FlatText, spec: mujoco.MjSpec, all_visuals: bool) -> dict[str, bool]:
    """Put massless spheres in the place of visual mesh geoms, so that the other geoms of a body keep their numbers.

    all_visuals: not only of those whose meshes are missing. Returns the lines of these geoms, and whether they had a
    mass. Meshes that no geom is left to use go, and pairs of geoms that are not there. Raises AssetError where the mesh
    of a geom that collides is not there, or plainly is a file of another kind, such as a pointer.
    """
    tree, geoms = flat.tree, compiler.geoms_of(spec.bodies)
    folders = AssetFolders(tree)
    nodes = {mesh.name: flat.node_at(mesh.info) for mesh in spec.meshes}
    files = {name: folders.find(node) for name, node in nodes.items() if node and node.attributes.get("file")}
    paired = {name for pair in spec.pairs for name in (pair.geomname1, pair.geomname2)}
    collides = {id(geom): bool(geom.contype or geom.conaffinity or geom.name in paired - {""}) for geom in geoms}
    colliding = [geom for geom in geoms if collides[id(geom)]]
    missing = {name for name, path in files.items() if not tree.has(path)}
    if lost := [geom for geom in colliding if geom.meshname in missing and flat.node_at(geom.info)]:
        first, count = lost[0], len({geom.meshname for geom in lost})
        node = nodes[first.meshname]
        assert node is not None  # it names the file
        called = f"collision geom {first.name!r}" if first.name else "a collision geom"
        others = f" (and {count - 1} more like it)" if count > 1 else ""
        problem = f"the mesh {node.attributes['file']!r} of {called} of body {first.parent.name!r} is not there{others}"
        where, remedy = tree.where(node), references.Resolver(tree.main.path.parent).advice(str(files[first.meshname]))
        gone = (node.attributes["file"] for name, node in nodes.items() if node and name in missing)
        raise MissingFilesError(problem, missing=dict.fromkeys(gone), where=where, remedy=remedy)
    for name in dict.fromkeys(geom.meshname for geom in colliding):
        if name in files and is_file(files[name]):
            mesh_reader.read_content(files[name])
    names = {geom.name for geom in geoms}
    for pair in [pair for pair in spec.pairs if not names >= {pair.geomname1, pair.geomname2}]:
        spec.delete(pair)
    infos: dict[str, bool] = {}
    first_group, last_group = spec.compiler.inertiagrouprange
    for geom in geoms:
        if geom.meshname and not collides[id(geom)] and (all_visuals or geom.meshname in missing):
            weighs = geom.density > 0 if isnan(geom.mass) else geom.mass > 0
            infos[geom.info] = bool(first_group <= geom.group <= last_group and weighs)
            geom.type, geom.meshname, geom.size, geom.mass = mujoco.mjtGeom.mjGEOM_SPHERE, "", [1, 0, 0], 0
    used = {geom.meshname for geom in geoms}
    for mesh in [mesh for mesh in spec.meshes if mesh.name not in used]:
        spec.delete(mesh)
    spec.compiler.boundmass = max(spec.compiler.boundmass, _LEAST_MASS)
    spec.compiler.boundinertia = max(spec.compiler.boundinertia, _LEAST_INERTIA)
    spec.compiler.balanceinertia = True
    return infos
