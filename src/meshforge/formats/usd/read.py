"""Reading a USD file: from its stage to an asset, with what it shows, the files that it is made of, and notes."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Self

import numpy as np

from meshforge.common import AssetError, GeometryError, MeshForgeError, file_digest, is_file, join_names, pluralize
from meshforge.common.processes import call_isolated, report_progress
from meshforge.formats import collision_pieces, mesh_reader
from meshforge.formats.libraries import pxr
from meshforge.formats.usd import colliders, stage
from meshforge.formats.usd.colliders import PrimCollision
from meshforge.formats.usd.mechanism import read_mechanism
from meshforge.formats.usd.shapes import read_mesh, read_parts
from meshforge.formats.usd.stage import PrimRecord, UsdDocument, UsdStage, usd
from meshforge.formats.visuals import LazySurfaces, screen_color
from meshforge.symbolic import Asset, FileNote, Mentions, Rgba, Surface

_ISAAC = "SemanticsAPI:"


def read_usd(path: Path) -> Asset:
    """Return the asset in a USD file, the layers it refers to included.

    Raises AssetError: damaged, more than memory holds, or there is nothing in it.
    """
    source = mesh_reader.read_content(path)
    with usd(str(path)) as complaints:
        stage.refuse_far_references(path, source)
        scene = UsdStage.open(path)
        asset = _build_asset(scene, source)
    with usd(str(path)):  # which complains about missing files once more
        files, missing = _find_files(path)
    if complaints and not asset.geoms and not asset.non_convex:
        raise AssetError(f"nothing in it collides; USD says: {complaints[0]}", where=str(path))
    more = [f"and {len(complaints) - 3} complaints more of USD"] if len(complaints) > 3 else []
    notes = (*asset.notes, *(f"USD says: {text}" for text in complaints[:3]), *more)
    layers = tuple(one for one in missing if Path(one).suffix.lower() in (*stage.LAYER_SUFFIXES, stage.PACKAGE_SUFFIX))
    return replace(asset, files=files, missing=missing, needed=layers, notes=notes)


def _build_asset(scene: UsdStage, source: bytes) -> Asset:
    marks = (colliders.COLLISION, colliders.RIGID_BODY)
    physics = any(colliders.has_schema(prim, mark) for prim in scene.prims() for mark in marks)
    bodies = colliders.StageBodies(scene, physics)
    notes: list[str] = []
    sources = list(read_collisions(scene, bodies, physics, notes))
    names = collision_pieces.name_pieces((bodies.hull_name(one.path, one.body), len(one.parts)) for one in sources)
    authored = tuple(PrimRecord(one.body, own, one.path) for one, own in zip(sources, names, strict=True))
    visuals = StageSurfaces.of(scene, bodies) if physics else ()
    mentions = [_mentions_of_prim(source.prim) for source in sources]
    geoms, non_convex = collision_pieces.build_pieces(
        authored,
        [source.parts for source in sources],
        [[own] * len(source.parts) for own, source in zip(mentions, sources, strict=True)],
    )
    prims = {name: source.prim for source, own in zip(sources, names, strict=True) for name in own}
    geoms = tuple(replace(geom, contact=colliders.contact_attributes(prims[geom.name])) for geom in geoms)
    mechanism = read_mechanism(scene, bodies, geoms)
    own, layers_used = scene.path.resolve(), map(_file_of, (one.realPath for one in scene.stage.GetUsedLayers()))
    others = dict.fromkeys(layer for layer in layers_used if layer is not None and layer.resolve() != own)
    digests = tuple((layer, file_digest(layer)) for layer in others)
    return Asset(
        path=scene.path,
        format="usd",
        bodies=bodies.list_bodies(),
        geoms=geoms,
        document=UsdDocument(source, physics, authored, digests),
        non_convex=non_convex,
        visuals=visuals,
        notes=(*_collect_notes(scene, physics), *notes),
        mechanism=mechanism,
        up=scene.up,
    )


def read_collisions(
    scene: UsdStage, bodies: colliders.StageBodies, physics: bool, notes: list[str]
) -> Iterator[PrimCollision]:
    """Yield all prims with collision, in the order of the stage."""
    for prim in scene.prims():
        if (colliders.is_collider if physics else colliders.is_seen)(scene, prim) and (
            parts := read_parts(scene, prim, notes)
        ):
            yield PrimCollision(prim, bodies.of(prim), parts)


def _find_files(path: Path) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """The files beside the main one that are there, in order of mention, and the references that lead nowhere."""
    layers, assets, unresolved = pxr.UsdUtils.ComputeAllDependencies(str(path))
    places = [*(layer.realPath for layer in layers), *assets]
    own = path.resolve()
    found = [file for file in map(_file_of, places) if file is not None and file.resolve() != own]
    missing = (text.removeprefix(f"{path.absolute().parent}/") for text in unresolved)
    return tuple(dict.fromkeys(found)), tuple(dict.fromkeys(missing))


def _file_of(place: Any) -> Path | None:
    """The file of a resolved place; of something within a package, the package."""
    text = str(place).split("[", 1)[0]
    path = Path(text)
    return path if text and is_file(path) else None


def _mentions_of_prim(prim: Any) -> Mentions:
    found = [(kind, name) for kind, each in (("label", prim), ("class", prim.GetParent())) for name in _labels_of(each)]
    found += [("node", prim.GetName()), ("node", prim.GetParent().GetName())]
    material, _ = pxr.UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    if material:
        found.append(("material", material.GetPrim().GetName()))
    return collision_pieces.drop_repeats(found)


def _labels_of(prim: Any) -> Iterator[str]:
    """The labels of a prim, by USD's own schema and by that of Isaac's earlier versions."""
    for schema in prim.GetPrimTypeInfo().GetAppliedAPISchemas():
        if schema.startswith(colliders.LABELS_SCHEMA):
            labels = prim.GetAttribute(schema.replace(colliders.LABELS_SCHEMA, colliders.LABELS, 1)).Get()
            yield from map(str, labels or ())
        elif schema.startswith(_ISAAC):
            data = prim.GetAttribute(f"semantic:{schema.removeprefix(_ISAAC)}:params:semanticData").Get()
            yield str(data or "")


def _collect_notes(scene: UsdStage, physics: bool) -> Iterator[str]:
    """The notes on a stage; physics: whether its prims say what collides."""
    if not physics:
        yield "no prim is marked as collision: all that is seen is taken for it"
    prims = list(scene.prims())
    solid = [
        prim
        for prim in prims
        if colliders.has_schema(prim, colliders.COLLISION) and not colliders.has_schema(prim, colliders.TRIGGER)
    ]
    off = [prim.GetName() for prim in solid if not colliders.is_collider(scene, prim)]
    if off:
        yield FileNote(f"{pluralize(len(off), 'collider')} switched off are left as they are ({join_names(off, 3)})")
    triggers = sum(colliders.has_schema(prim, colliders.TRIGGER) for prim in prims)
    if triggers:
        yield FileNote(f"{pluralize(triggers, 'trigger')} detect bodies without colliding: they are left as they are")
    if chosen := [prim.GetName() for prim in prims if prim.HasVariantSets()]:
        yield f"of variants, the selected ones are read ({join_names(chosen, 3)})"
    if many := [prim.GetName() for prim in prims if prim.IsA(pxr.UsdGeom.PointInstancer)]:
        named = f"{pluralize(len(many), 'point instancer')} ({join_names(many, 3)})"
        yield f"what is shown many times by {named} is not read, and left as it is"
    if sum(prim.IsInstance() for prim in prims):
        yield FileNote("what an edit changes in an instance becomes that instance's own: it is no longer shared")


def read_stage_surfaces(asset: Asset, document: UsdDocument) -> tuple[Surface, ...]:
    """Return what a stage shows in which all that is seen is taken for collision."""
    with usd(str(asset.path)):
        scene = UsdStage.open(asset.path)
        shown = StageSurfaces.of(scene, colliders.StageBodies(scene, document.physics))
    return (*shown,)


class StageSurfaces(LazySurfaces):
    """The visible surfaces of a file, none where it cannot be read any more; bodies: of each prim that shows."""

    def __init__(self, path: Path, bodies: dict[str, str]) -> None:
        self._path, self._bodies = path, bodies

    @classmethod
    def of(cls, scene: UsdStage, bodies: colliders.StageBodies) -> Self:
        """Return the surfaces of an open stage."""
        return cls(
            scene.path,
            {str(prim.GetPath()): bodies.of(prim) for prim in scene.prims() if colliders.is_seen(scene, prim)},
        )

    def _make(self) -> list[Surface]:
        try:
            return call_isolated(_list_surfaces, self._path, self._bodies, where=str(self._path))
        except MeshForgeError:
            return []


def _list_surfaces(path: Path, bodies: Mapping[str, str]) -> list[Surface]:
    with usd(str(path)):
        scene = UsdStage.open(path)
        return [surface for prim, body in bodies.items() for surface in _read_surfaces(scene, prim, body)]


def _read_surfaces(scene: UsdStage, path: str, body: str) -> Iterator[Surface]:
    prim = scene.stage.GetPrimAtPath(path)
    report_progress()
    linear, offset = scene.placement(prim)
    if not (np.isfinite(linear).all() and np.isfinite(offset).all()):
        return
    rgba = _read_color(scene, prim)
    if prim.GetTypeName() != "Mesh":
        shapes = [part.shape for part in read_parts(scene, prim, []) if part.shape is not None]
        yield from (Surface(shape.vertices, shape.faces, body, rgba) for shape in shapes)
        return
    try:
        mesh = read_mesh(scene, prim)
    except GeometryError:
        return
    if len(mesh.faces):
        yield replace(collision_pieces.place_surface(mesh.vertices, mesh.faces, linear, offset, body), rgba=rgba)


def _read_color(scene: UsdStage, prim: Any) -> Rgba | None:
    """The colour of a prim as screens show it: of its preview surface, else its display colour where that is one."""
    material, _ = pxr.UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    surface = material.ComputeSurfaceSource()[0] if material else None
    if surface and surface.GetIdAttr().Get() == "UsdPreviewSurface":
        color, opacity = surface.GetInput("diffuseColor"), surface.GetInput("opacity")
        if color and not color.HasConnectedSource() and color.Get() is not None:
            alpha = opacity.Get() if opacity and not opacity.HasConnectedSource() else None
            return _to_rgba(color.Get(), 1.0 if alpha is None else alpha)
    gprim = pxr.UsdGeom.Gprim(prim)
    colors, alphas = scene.get(gprim.GetDisplayColorAttr()), scene.get(gprim.GetDisplayOpacityAttr())
    if colors and len(colors) == 1:
        return _to_rgba(colors[0], alphas[0] if alphas and len(alphas) == 1 else 1.0)
    return None


def _to_rgba(color: Any, alpha: float) -> Rgba | None:
    return screen_color([*color], alpha) if np.isfinite([*color, alpha]).all() else None
