"""Reading an SDF: from its files to an asset, with what its links show, other names of its collisions, the files it
refers to, and notes."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from meshforge.common import MeshForgeError, join_names, plain_path, pluralize
from meshforge.formats.base import ReadOptions
from meshforge.formats.collision_pieces import (
    CollisionElement,
    CollisionMeshes,
    CollisionPiece,
    MeshUse,
    ShapeNames,
    collect_mentions,
    geoms_of,
    opaque_of,
    refuse_missing,
    stem_of,
)
from meshforge.formats.references import find_companions
from meshforge.formats.sdf.document import (
    CONFIG,
    NEWEST,
    ElementPlace,
    SdfDocument,
    SdfSource,
    find_main_file,
    find_scripts,
    geometry_of,
    is_main_file,
    mesh_uri,
    parse_root,
    references,
)
from meshforge.formats.sdf.frames import text_of
from meshforge.formats.sdf.mechanism import compute_masses, has_computed_mass, read_joints, read_masses
from meshforge.formats.sdf.models import (
    ModelTree,
    SdfCollision,
    SdfLink,
    SdfLinks,
    compose_models,
    place_links,
    pose_in_link,
)
from meshforge.formats.sdf.shapes import (
    read_mesh_scale,
    read_parts,
    read_polylines,
    read_primitive,
    read_submesh,
    select_submesh,
)
from meshforge.formats.slots import name_elements
from meshforge.formats.visuals import Rgba, Visual, VisualSurfaces
from meshforge.formats.xml import Element, parse_numbers
from meshforge.symbolic import Asset, Body, Mechanism, Mentions

_UNIT = re.compile(rb"<unit\b[^>]*?\bmeter\s*=\s*[\"']\s*([0-9.eE+-]+)\s*[\"']")
_HEAD_BYTES = 100_000  # bytes within which a file says its unit


def read_sdf(path: Path, options: ReadOptions) -> Asset:
    """The asset in an SDF file with all that it includes; the root frame is that of the world around the model.

    Raises AssetError naming file, line, link and element: text that is not understood, a frame, an included model or a
    collision mesh that is not there.
    """
    composed = compose_models(plain_path(path), tuple(map(plain_path, options.package_roots)))
    links = place_links(composed)
    uses = _mesh_uses(links, composed)
    refuse_missing(use for use in uses if use)
    meshes = CollisionMeshes(select_submesh)
    parts = [read_parts(one, use, meshes) for one, use in zip(links.collisions, uses, strict=True)]
    authored = name_elements(_by_link(links), [len(own) for own in parts])
    mentions = [
        _collect_mentions(one, meshes.groups(use), own)
        for one, use, own in zip(links.collisions, uses, parts, strict=True)
    ]
    geoms = geoms_of(authored, parts, mentions)
    opaque = opaque_of(authored, parts, mentions)
    joints = read_joints(composed, links)
    elements = {name: one.element for one, own in zip(links.collisions, authored, strict=True) for name in own.names}
    masses = (*read_masses(links), *compute_masses(links, elements, geoms, opaque))
    files, missing = find_files(composed.sources)
    return Asset(
        path=path,
        format="sdf",
        bodies=(*joints.world, *(Body(name, link.pose) for name, link in links.by_body.items())),
        geoms=geoms,
        document=_build_document(composed, links, authored, meshes),
        opaque=opaque,
        visuals=read_visuals(links, composed),
        files=files,
        missing=missing,
        notes=(*composed.notes, *joints.notes, *collect_notes(composed, links)),
        mechanism=Mechanism(tuple(joints.joints), masses),
    )


def _build_document(
    composed: ModelTree, links: SdfLinks, authored: tuple[CollisionElement, ...], meshes: CollisionMeshes
) -> SdfDocument:
    return SdfDocument(
        tuple(composed.sources),
        authored,
        tuple(ElementPlace(one.link.scope.source, one.element.start) for one in links.collisions),
        {body: ElementPlace(link.scope.source, link.element.start) for body, link in links.by_body.items()},
        tuple(composed.worlds),
        tuple(body for body, link in links.by_body.items() if has_computed_mass(link.element)),
        meshes.digests(),
    )


def _by_link(links: SdfLinks) -> list[tuple[str, Element]]:
    """The collisions with the names of their links."""
    return [(one.link.body, one.element) for one in links.collisions]


def _mesh_uses(links: SdfLinks, composed: ModelTree) -> list[MeshUse | None]:
    """The mesh file of each collision, None where it has another geometry or none."""
    uses: list[MeshUse | None] = []
    labels = name_elements(_by_link(links), [1] * len(links.collisions))
    for one, named in zip(links.collisions, labels, strict=True):
        kind = geometry_of(one.element)
        if kind is None or kind.tag != "mesh":
            uses.append(None)
            continue
        resolver = composed.sources[one.link.scope.source].resolver
        place = f"{one.link.where}:{kind.line}"
        uses.append(MeshUse(named.names[0], mesh_uri(kind), place, resolver, read_submesh(kind)))
    return uses


def _collect_mentions(
    collision: SdfCollision, groups: Sequence[str | None], parts: Sequence[CollisionPiece]
) -> list[Mentions]:
    """What else is said of each piece of a collision."""
    common = mentions_of_element(collision.link.element, collision.element)
    return [(("group", group), *common) if group else common for group in groups or [None] * len(parts)]


def read_visuals(links: SdfLinks, composed: ModelTree) -> VisualSurfaces:
    """The visuals of all links; one that is not understood is left out, it never fails."""
    return VisualSurfaces(
        tuple(
            replace(visual, rgba=_read_color(element))
            for link in links.by_body.values()
            for element in link.element.each("visual")
            for visual in _read_visual(links, link, element, composed)
        )
    )


def _read_color(visual: Element) -> Rgba | None:
    """The diffuse colour of a visual, as transparent as it says."""
    found = parse_numbers(text_of(visual.first("material"), "diffuse"))
    if not found or len(found) not in (3, 4):
        return None
    red, green, blue, alpha = (min(1.0, max(0.0, share)) for share in [*found, 1.0][:4])
    through = parse_numbers(text_of(visual, "transparency")) or [0.0]
    return red, green, blue, alpha * (1.0 - min(1.0, max(0.0, through[0])))


def _read_visual(links: SdfLinks, link: SdfLink, element: Element, composed: ModelTree) -> Iterator[Visual]:
    kind, where = geometry_of(element), link.where
    if kind is None:
        return
    try:
        at = pose_in_link(links.places, link, element)
        if kind.tag == "mesh":
            path = composed.sources[link.scope.source].resolver.find(mesh_uri(kind))
            if path is not None:
                scale = read_mesh_scale(kind, where, "visual") * collada_unit_of(path)
                yield Visual(link.body, path, at.rotation * scale, at.translation)
            return
        geometry = element.first("geometry")
        assert geometry is not None  # it holds the kind
        part = read_polylines(geometry, at, where) if kind.tag == "polyline" else read_primitive(kind, at, where)
        if part.shape is not None:
            yield Visual(link.body, part.shape, np.eye(3), np.zeros(3))
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
    own = _names_of(collision)
    shown = [named for visual in link.each("visual") if (named := _names_of(visual))]
    return collect_mentions(own, shown) if own else ()


def _names_of(element: Element) -> ShapeNames | None:
    """The names of a collision or visual element; of a collision without its own, which its hulls have."""
    kind = geometry_of(element)
    if kind is None:
        return None
    reference = mesh_uri(kind) if kind.tag == "mesh" else ""
    sizes = tuple((child.tag, " ".join(child.text.split())) for child in kind.children)
    shape = reference or (kind.tag, sizes, " ".join(text_of(element, "pose").split()))
    material = element.first("material")
    script = material.first("script") if material else None
    name = "" if element.tag == "collision" else element.attributes.get("name", "")
    return ShapeNames(shape, name, stem_of(reference), text_of(script, "name"))


def collect_notes(composed: ModelTree, links: SdfLinks) -> Iterator[str]:
    """Notes on worlds, older versions of a model, collisions without a shape, and what is decomposed when loaded."""
    root, path = composed.root, composed.sources[0].path
    if composed.worlds:
        yield f"it is a world of {pluralize(len(root.inner), 'model')}, which is only read"
    if root.version > NEWEST:
        own, known = (".".join(map(str, version)) for version in (root.version, NEWEST))
        yield f"SDF {own} is newer than {known}: what is new in it is not understood"
    if not is_main_file(path) and (newest := find_main_file(path.parent)) is not None:
        yield f"{CONFIG} names {newest.name} for newer versions of Gazebo, which do not read this file"
    if actors := [actor.line for actor in root.element.each("actor")]:
        yield f"{pluralize(len(actors), 'actor')}, the first on line {actors[0]}: passed over"
    kinds = [(collision.element.line, geometry_of(collision.element)) for collision in links.collisions]
    if bare := [f"line {line}" for line, kind in kinds if kind is None]:
        yield f"{pluralize(len(bare), 'collision')} without geometry ({join_names(bare, 3)}): passed over"
    cut = [k for _, k in kinds if k is not None and k.attributes.get("optimization") == "convex_decomposition"]
    if cut:
        yield f"{pluralize(len(cut), 'mesh', 'meshes')} to be decomposed by Gazebo when loaded, shown as authored"


def find_files(sources: Sequence[SdfSource]) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """The included and referenced files that are there, with their companions, and the references that lead nowhere."""
    files: dict[Path, None] = {}
    missing: dict[str, None] = {}
    for number, source in enumerate(sources):
        if number:
            files[source.path] = None
        if (config := source.path.parent / CONFIG).is_file():
            files[config] = None
        root, _ = parse_root(source.text.data, str(source.path))
        for reference in references(root):
            path = source.resolver.find(reference)
            if path is None:
                missing[reference] = None
            else:
                files |= dict.fromkeys([path, *find_companions(path).values()])
        files |= dict.fromkeys(path for _, path in find_scripts(source))
    return tuple(files), tuple(missing)
