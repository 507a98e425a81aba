"""Reading a USD file: from its stage to an asset."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from meshforge.asset import Asset, Geom, Opaque
from meshforge.errors import AssetError
from meshforge.formats.mesh_parts import MeshPart
from meshforge.formats.triangles import contents
from meshforge.formats.usd.document import Authored, UsdDocument
from meshforge.formats.usd.library import usd
from meshforge.formats.usd.reading.bodies import Bodies, piece_names
from meshforge.formats.usd.reading.colliders import collides, has_physics, is_seen
from meshforge.formats.usd.reading.contact import contact_attributes
from meshforge.formats.usd.reading.files import digests_of, files_of
from meshforge.formats.usd.reading.instancers import instanced_part
from meshforge.formats.usd.reading.joints import read_mechanism
from meshforge.formats.usd.reading.layers import refuse_harmful_layers
from meshforge.formats.usd.reading.mentions import prim_mentions
from meshforge.formats.usd.reading.notes import scene_notes
from meshforge.formats.usd.reading.shapes import parts_of
from meshforge.formats.usd.reading.stage import Scene
from meshforge.formats.usd.reading.visuals import StageSurfaces


@dataclass(frozen=True, eq=False, slots=True)
class Source:
    """A prim with collision: its pieces in the root frame; fixed: why no edit can change it."""

    prim: Any
    body: str
    parts: Sequence[MeshPart]
    fixed: str = ""

    @property
    def path(self) -> str:
        return str(self.prim.GetPath())


def read_usd(path: Path) -> Asset:
    """The asset in a USD file, the layers it refers to included.

    Raises AssetError: damaged, more than memory holds, or there is nothing in it.
    """
    source = contents(path)
    with usd(str(path)) as told:
        refuse_harmful_layers(path, source)
        scene = Scene.open(path)
        asset = _asset(scene, source)
    with usd(str(path)):  # which tells of missing files once more
        files, missing = files_of(path)
    asset = replace(asset, files=files, missing=missing)
    return _with_complaints(asset, told)


def _asset(scene: Scene, source: bytes) -> Asset:
    physics = has_physics(scene)
    bodies = Bodies(scene, physics)
    notes: list[str] = []
    sources = list(sources_of(scene, bodies, physics, notes))
    authored = authored_of(sources, bodies)
    visuals = StageSurfaces.of(scene, bodies) if physics else ()
    geoms = tuple(_geoms(authored, sources))
    mechanism = read_mechanism(scene, bodies, geoms)
    return Asset(
        path=scene.path,
        format="usd",
        bodies=bodies.list_bodies(),
        geoms=geoms,
        document=UsdDocument(source, physics, authored, tuple(bodies.names.items()), digests_of(scene)),
        opaque=tuple(_opaque(authored, sources)),
        visuals=visuals,
        notes=(*scene_notes(scene, physics), *notes),
        mechanism=mechanism,
        up=scene.up,
    )


def sources_of(scene: Scene, bodies: Bodies, physics: bool, notes: list[str]) -> Iterator[Source]:
    """All prims with collision, in the order of the stage."""
    from pxr import UsdGeom

    for prim in scene.prims():
        if prim.IsA(UsdGeom.PointInstancer):
            if part := instanced_part(scene, prim, physics, notes):
                yield Source(prim, bodies.of(prim), [part], "is made many times by a point instancer")
        elif (collides if physics else is_seen)(scene, prim) and (parts := parts_of(scene, prim, notes)):
            yield Source(prim, bodies.of(prim), parts)


def authored_of(sources: Sequence[Source], bodies: Bodies) -> tuple[Authored, ...]:
    """The sources with the names of their pieces."""
    bases = [(bodies.hull_name(source.path, source.body), len(source.parts)) for source in sources]
    return tuple(
        Authored(source.path, source.body, names, source.fixed)
        for source, names in zip(sources, piece_names(bases), strict=True)
    )


def _geoms(authored: Sequence[Authored], sources: Sequence[Source]) -> Iterator[Geom]:
    for element, source in zip(authored, sources, strict=True):
        said, contact = prim_mentions(source.prim), contact_attributes(source.prim)
        for name, part in zip(element.names, source.parts, strict=True):
            if part.shape is not None:
                yield Geom(name, element.body, part.shape, contact=contact, mentions=said)


def _opaque(authored: Sequence[Authored], sources: Sequence[Source]) -> Iterator[Opaque]:
    for element, source in zip(authored, sources, strict=True):
        said = prim_mentions(source.prim)
        for name, part in zip(element.names, source.parts, strict=True):
            if part.shape is None:
                yield Opaque(name, element.body, part.reason, part.surface, part.plane, said)


def _with_complaints(asset: Asset, told: Sequence[str]) -> Asset:
    """The asset with what the library complained about; an asset of nothing with complaints is refused."""
    if told and not asset.geoms and not asset.opaque:
        raise AssetError(f"nothing in it collides; USD says: {told[0]}", where=str(asset.path))
    more = [f"and {len(told) - 3} complaints more of USD"] if len(told) > 3 else []
    return replace(asset, notes=(*asset.notes, *(f"USD says: {text}" for text in told[:3]), *more))
