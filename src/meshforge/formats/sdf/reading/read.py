"""Reading an SDF: from its files to an asset."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from meshforge.asset import Asset, Body, Mechanism, Mentions
from meshforge.files import plain_path
from meshforge.formats.base import ReadOptions
from meshforge.formats.collision_meshes import CollisionMeshes, MeshUse, refuse_missing
from meshforge.formats.element_names import piece_names
from meshforge.formats.element_pieces import geoms_of, opaque_of
from meshforge.formats.element_plan import Authored
from meshforge.formats.mesh_parts import MeshPart, mesh_parts
from meshforge.formats.sdf.document import InFile, SdfDocument
from meshforge.formats.sdf.files.elements import geometry_of, mesh_uri
from meshforge.formats.sdf.reading.compose import Composed, compose
from meshforge.formats.sdf.reading.links import Collision, Links, links_of
from meshforge.formats.sdf.reading.masses import computed_masses, is_computed, read_masses
from meshforge.formats.sdf.reading.mechanism import read_joints
from meshforge.formats.sdf.reading.mentions import element_mentions
from meshforge.formats.sdf.reading.notes import notes
from meshforge.formats.sdf.reading.referred import files_of
from meshforge.formats.sdf.reading.shapes import chosen, hull_of, mesh_part, mesh_scale, polylines, primitive
from meshforge.formats.sdf.reading.visuals import read_visuals


def read_sdf(path: Path, options: ReadOptions) -> Asset:
    """The asset in an SDF file with all that it includes; the root frame is that of the world around the model.

    Raises AssetError naming file, line, link and element: text that is not understood, a frame, an included model or a
    collision mesh that is not there.
    """
    composed = compose(plain_path(path), tuple(map(plain_path, options.package_roots)))
    links = links_of(composed)
    uses = _uses(links, composed)
    refuse_missing(use for use in uses if use)
    meshes = CollisionMeshes(chosen)
    parts = [_parts(one, use, meshes) for one, use in zip(links.collisions, uses, strict=True)]
    authored = _authored(links.collisions, [len(own) for own in parts])
    told = [_told(one, meshes.groups(use), own) for one, use, own in zip(links.collisions, uses, parts, strict=True)]
    geoms = geoms_of(authored, parts, told)
    opaque = opaque_of(authored, parts, told)
    joints = read_joints(composed, links)
    elements = {name: one.element for one, own in zip(links.collisions, authored, strict=True) for name in own.names}
    masses = (*read_masses(links), *computed_masses(links, elements, geoms, opaque))
    files, missing = files_of(composed.sources)
    return Asset(
        path=path,
        format="sdf",
        bodies=(*joints.world, *(Body(name, link.pose) for name, link in links.by_body.items())),
        geoms=geoms,
        document=_document(composed, links, authored, meshes),
        opaque=opaque,
        visuals=read_visuals(links, composed),
        files=files,
        missing=missing,
        notes=(*composed.notes, *joints.notes, *notes(composed, links)),
        mechanism=Mechanism(tuple(joints.joints), masses),
    )


def _document(composed: Composed, links: Links, authored: tuple[Authored, ...], meshes: CollisionMeshes) -> SdfDocument:
    return SdfDocument(
        tuple(composed.sources),
        authored,
        tuple(InFile(one.link.scope.source, one.element.start) for one in links.collisions),
        {body: InFile(link.scope.source, link.element.start) for body, link in links.by_body.items()},
        tuple(composed.worlds),
        tuple(body for body, link in links.by_body.items() if is_computed(link.element)),
        meshes.digests(),
    )


def _authored(found: Sequence[Collision], pieces: Sequence[int]) -> tuple[Authored, ...]:
    """The collisions with the names of their pieces, of which each has so many."""
    own = [(one.link.body, one.element.attributes.get("name"), count) for one, count in zip(found, pieces, strict=True)]
    return tuple(Authored(body, names) for (body, _, _), names in zip(own, piece_names(own), strict=True))


def _uses(links: Links, composed: Composed) -> list[MeshUse | None]:
    """The mesh file of each collision, None where it has another geometry or none."""
    uses: list[MeshUse | None] = []
    labels = _authored(links.collisions, [1] * len(links.collisions))
    for one, named in zip(links.collisions, labels, strict=True):
        kind = geometry_of(one.element)
        if kind is None or kind.tag != "mesh":
            uses.append(None)
            continue
        resolver = composed.sources[one.link.scope.source].resolver
        place = f"{one.link.where}:{kind.line}"
        uses.append(MeshUse(named.names[0], mesh_uri(kind), place, resolver, mesh_part(kind)))
    return uses


def _parts(collision: Collision, use: MeshUse | None, meshes: CollisionMeshes) -> list[MeshPart]:
    """The pieces of a collision, in the root frame; none where it has no geometry."""
    kind, pose, where = geometry_of(collision.element), collision.pose, collision.link.where
    if kind is None:
        return []
    if use is not None:
        linear = pose.rotation * mesh_scale(kind, where, use.label)
        if kind.attributes.get("optimization") == "convex_hull":
            return [hull_of(meshes.surfaces(use), linear, pose.translation)]
        return mesh_parts(meshes.pieces(use), linear, pose.translation)
    geometry = collision.element.first("geometry")
    assert geometry is not None  # it holds the kind
    return [polylines(geometry, pose, where) if kind.tag == "polyline" else primitive(kind, pose, where)]


def _told(collision: Collision, groups: Sequence[str | None], parts: Sequence[MeshPart]) -> list[Mentions]:
    """What else is said of each piece of a collision."""
    common = element_mentions(collision.link.element, collision.element)
    return [(("group", group), *common) if group else common for group in groups or [None] * len(parts)]
