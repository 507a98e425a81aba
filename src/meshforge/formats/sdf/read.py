"""Reading an SDF: from its files to an asset, with what its links show, other names of its collisions, the files it
refers to, and notes."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge.common import MeshForgeError, join_names, plain_path, pluralize
from meshforge.formats import base, collision_pieces, references, slots
from meshforge.formats.sdf import document, models, shapes
from meshforge.formats.sdf.frames import text_of
from meshforge.formats.sdf.mechanism import compute_masses, has_computed_mass, read_joints, read_masses
from meshforge.formats.visuals import Visual, VisualSurfaces
from meshforge.formats.xml import Element, parse_numbers
from meshforge.symbolic import Asset, Body, FileNote, Mechanism, Mentions, Rgba

_UNIT = re.compile(rb"<unit\b[^>]*?\bmeter\s*=\s*[\"']\s*([0-9.eE+-]+)\s*[\"']")
_HEAD_BYTES = 100_000  # bytes within which a file says its unit


def read_sdf(path: Path, options: base.ReadOptions) -> Asset:
    """The asset in an SDF file with all that it includes; the root frame is that of the world around the model.

    Raises AssetError naming file, line, link and element: text that is not understood, a frame, an included model or a
    collision mesh that is not there.
    """
    tree = models.read_models(plain_path(path), tuple(map(plain_path, options.package_roots)))
    uses = _mesh_uses(tree)
    collision_pieces.refuse_missing(use for use in uses if use)
    meshes = collision_pieces.CollisionMeshes(shapes.select_submesh)
    parts = [shapes.read_parts(one, use, meshes) for one, use in zip(tree.collisions, uses, strict=True)]
    authored = slots.name_elements(_by_link(tree), [len(own) for own in parts])
    mentions = [
        meshes.mention_groups(use, mentions_of_element(one.link.element, one.element), len(own))
        for one, use, own in zip(tree.collisions, uses, parts, strict=True)
    ]
    geoms = collision_pieces.geoms_of(authored, parts, mentions)
    non_convex = collision_pieces.non_convex_of(authored, parts, mentions)
    joints = read_joints(tree)
    elements = {name: one.element for one, own in zip(tree.collisions, authored, strict=True) for name in own.names}
    masses = (*read_masses(tree), *compute_masses(tree, elements, geoms, non_convex))
    files, missing = find_files(tree.sources)
    return Asset(
        path=path,
        format="sdf",
        bodies=(*joints.world, *(Body(name, link.pose) for name, link in tree.links.items())),
        geoms=geoms,
        document=_build_document(tree, authored, meshes),
        non_convex=non_convex,
        visuals=read_visuals(tree),
        files=files,
        missing=missing,
        notes=(*tree.notes, *joints.notes, *collect_notes(tree)),
        mechanism=Mechanism(tuple(joints.joints), masses),
    )


def _build_document(
    tree: models.ModelTree,
    authored: tuple[collision_pieces.CollisionElement, ...],
    meshes: collision_pieces.CollisionMeshes,
) -> document.SdfDocument:
    return document.SdfDocument(
        tuple(tree.sources),
        authored,
        tuple(document.ElementPlace(one.link.scope.source.number, one.element.start) for one in tree.collisions),
        {
            body: document.ElementPlace(link.scope.source.number, link.element.start)
            for body, link in tree.links.items()
        },
        tuple(tree.worlds),
        tuple(body for body, link in tree.links.items() if has_computed_mass(link.element)),
        meshes.digests(),
    )


def _by_link(tree: models.ModelTree) -> list[tuple[str, Element]]:
    return [(one.link.body, one.element) for one in tree.collisions]


def _mesh_uses(tree: models.ModelTree) -> list[collision_pieces.MeshUse | None]:
    """The mesh file of each collision, None where it has another geometry or none."""
    uses: list[collision_pieces.MeshUse | None] = []
    labels = slots.name_elements(_by_link(tree), [1] * len(tree.collisions))
    for one, named in zip(tree.collisions, labels, strict=True):
        kind = document.geometry_of(one.element)
        if kind is None or kind.tag != "mesh":
            uses.append(None)
            continue
        resolver = tree.sources[one.link.scope.source.number].resolver
        place = f"{one.link.scope.where}:{kind.line}"
        uses.append(
            collision_pieces.MeshUse(
                named.names[0], document.mesh_uri(kind), place, resolver, shapes.read_submesh(kind)
            )
        )
    return uses


def read_visuals(tree: models.ModelTree) -> VisualSurfaces:
    """The visuals of all links; one that is not understood is left out, it never fails."""
    return VisualSurfaces(
        tuple(
            replace(visual, rgba=_read_color(element))
            for link in tree.links.values()
            for element in link.element.each("visual")
            for visual in _read_visual(tree, link, element)
        )
    )


def _read_color(visual: Element) -> Rgba | None:
    found = parse_numbers(text_of(visual.first("material"), "diffuse"))
    if not found or len(found) not in (3, 4):
        return None
    red, green, blue, alpha = (min(1.0, max(0.0, share)) for share in [*found, 1.0][:4])
    through = parse_numbers(text_of(visual, "transparency")) or [0.0]
    return red, green, blue, alpha * (1.0 - min(1.0, max(0.0, through[0])))


def _read_visual(tree: models.ModelTree, link: models.SdfLink, element: Element) -> Iterator[Visual]:
    kind, where = document.geometry_of(element), link.scope.where
    if kind is None:
        return
    try:
        at = tree.pose_in_link(link, element)
        if kind.tag == "mesh":
            path = tree.sources[link.scope.source.number].resolver.find(document.mesh_uri(kind))
            if path is not None:
                scale = shapes.read_mesh_scale(kind, where, "visual") * collada_unit_of(path)
                yield Visual(link.body, path, at.rotation * scale, at.translation)
            return
        geometry = element.first("geometry")
        assert geometry is not None  # it holds the kind
        if (shape := shapes.read_shape(geometry, kind, at, where).shape) is not None:
            yield Visual(link.body, shape, np.eye(3), np.zeros(3))
    except MeshForgeError:
        return


def collada_unit_of(mesh: Path) -> float:
    """The metres of the unit that a mesh file is in: as a Collada file says, 1 for all others."""
    if mesh.suffix.lower() != ".dae":
        return 1.0
    try:
        with mesh.open("rb") as stream:
            found = _UNIT.search(stream.read(_HEAD_BYTES))
        unit = float(found[1]) if found else 1.0
    except (OSError, ValueError):
        return 1.0
    return unit if 0 < unit < float("inf") else 1.0


def mentions_of_element(link: Element, collision: Element) -> Mentions:
    """What is said of a `<collision>` of a link."""
    return collision_pieces.collect_mentions(_names_of(collision), map(_names_of, link.each("visual")))


def _names_of(element: Element) -> collision_pieces.ShapeNames | None:
    """The names of a collision or visual element; of a collision without its own, which its hulls have."""
    kind = document.geometry_of(element)
    if kind is None:
        return None
    reference = document.mesh_uri(kind) if kind.tag == "mesh" else ""
    sizes = tuple((child.tag, " ".join(child.text.split())) for child in kind.children)
    shape = reference or (kind.tag, sizes, " ".join(text_of(element, "pose").split()))
    material = element.first("material")
    script = material.first("script") if material else None
    name = "" if element.tag == "collision" else element.attributes.get("name", "")
    return collision_pieces.ShapeNames(shape, name, collision_pieces.stem_of(reference), text_of(script, "name"))


def collect_notes(tree: models.ModelTree) -> Iterator[str]:
    """Notes on worlds, older versions of a model, collisions without a shape, and what is decomposed when loaded."""
    path = tree.sources[0].path
    if tree.worlds:
        count = sum(scope.depth == 1 for scope in tree.scopes)
        yield FileNote(f"it is a world of {pluralize(count, 'model')}, which is only read")
    if tree.version > document.NEWEST:
        own, known = (".".join(map(str, version)) for version in (tree.version, document.NEWEST))
        yield f"SDF {own} is newer than {known}: what is new in it is not understood"
    if not document.is_main_file(path) and (newest := document.find_main_file(path.parent)) is not None:
        yield FileNote(
            f"{document.CONFIG} names {newest.name} for newer versions of Gazebo, which do not read this file"
        )
    if actors := [actor.line for actor in tree.root.each("actor")]:
        yield f"{pluralize(len(actors), 'actor')}, the first on line {actors[0]}: passed over"
    kinds = [(collision.element.line, document.geometry_of(collision.element)) for collision in tree.collisions]
    if bare := [f"line {line}" for line, kind in kinds if kind is None]:
        yield f"{pluralize(len(bare), 'collision')} without geometry ({join_names(bare, 3)}): passed over"
    cut = [k for _, k in kinds if k is not None and k.attributes.get("optimization") == "convex_decomposition"]
    if cut:
        meshes = pluralize(len(cut), "mesh", "meshes")
        yield FileNote(f"{meshes} to be decomposed by Gazebo when loaded, shown as authored")


def find_files(sources: Sequence[document.SdfSource]) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """The included and referenced files that are there, with their companions, and the references that lead nowhere."""
    files: dict[Path, None] = {}
    missing: dict[str, None] = {}
    for number, source in enumerate(sources):
        if number:
            files[source.path] = None
        if (config := source.path.parent / document.CONFIG).is_file():
            files[config] = None
        root, _ = document.parse_root(source.text.data, str(source.path))
        found, absent = references.find_all(document.references(root), source.resolver)
        files |= dict.fromkeys(found)
        missing |= dict.fromkeys(absent)
        files |= dict.fromkeys(path for _, path in document.find_scripts(source))
    return tuple(files), tuple(missing)
