"""Reading a glTF file or GLB: from its bytes to an asset."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from urllib.parse import unquote

from meshforge.asset import Asset, Body, Geom, Inertial, Mechanism, Mentions, Opaque, unique_names
from meshforge.errors import AssetError
from meshforge.formats.collision_meshes import digest_of
from meshforge.formats.companions import companions
from meshforge.formats.gltf.document import BODY, Authored, Convention, GltfDocument
from meshforge.formats.gltf.reading.bodies import body_nodes, rigid
from meshforge.formats.gltf.reading.mentions import source_mentions
from meshforge.formats.gltf.reading.motions import inertial_of
from meshforge.formats.gltf.reading.names import hull_names
from meshforge.formats.gltf.reading.notes import scene_notes
from meshforge.formats.gltf.reading.sources import Reader, Source
from meshforge.formats.gltf.reading.visuals import SceneSurfaces, visible
from meshforge.formats.meshfile.gltf import Scene, damage_at
from meshforge.formats.meshfile.gltf.items import entries
from meshforge.formats.triangles import contents
from meshforge.geometry import Pose


def read_gltf(path: Path) -> Asset:
    """The asset in a glTF file or GLB.

    Raises AssetError: damaged, compressed in a way that is not read, a buffer is missing, or there is nothing in it.
    """
    source = contents(path)
    with damage_at(str(path)):
        scene = Scene.of(source, path)
        reader = Reader(scene)
        sources = reader.read()
        bodies = named_bodies(scene)
        fixed = _is_fixed(scene, reader.convention, sources, bodies)
        notes = [*scene_notes(scene, reader.convention), *reader.notes]
        authored = authored_of(sources, bodies)
        said = [source_mentions(scene, source) for source in sources]
        geoms = tuple(_geoms(authored, sources, said))
        masses = tuple(_masses(scene, bodies, geoms))
        digests = tuple((file, digest_of(file)) for file in scene.buffers.files() if file.is_file())
    if not sources:
        raise AssetError("there is no mesh and no collider in its scene", where=str(path))
    files, missing = _files(scene, path)
    return Asset(
        path=path,
        format="gltf",
        bodies=_bodies(scene, bodies, fixed),
        geoms=geoms,
        document=GltfDocument(source, reader.convention, authored, _nodes_of(bodies), digests),
        opaque=tuple(_opaque(authored, sources, said)),
        visuals=_visuals(source, path, bodies, reader.convention),
        files=files,
        missing=missing,
        notes=tuple(notes),
        mechanism=Mechanism(inertials=masses),
        up="y",
    )


def named_bodies(scene: Scene) -> dict[int, tuple[int, str]]:
    """For each node in a rigid body, the node that is the body, and the body's name."""
    owners = body_nodes(scene)
    nodes = list(dict.fromkeys(owners.values()))
    own = [scene.placements[node].node.get("name") for node in nodes]
    wanted = [name if isinstance(name, str) and name else f"body{k}" for k, name in enumerate(own)]
    names = dict(zip(nodes, unique_names([BODY, *wanted])[1:], strict=True))
    return {node: (owner, names[owner]) for node, owner in owners.items()}


def authored_of(sources: Sequence[Source], bodies: Mapping[int, tuple[int, str]]) -> tuple[Authored, ...]:
    """The sources with the names of their pieces; names begin with the body where the file has rigid bodies."""
    own = [bodies[source.node][1] if source.node in bodies else BODY for source in sources]
    named = [
        (body if bodies else None, source.name, len(source.parts)) for body, source in zip(own, sources, strict=True)
    ]
    return tuple(
        Authored(source.node, body, names, source.owner)
        for source, body, names in zip(sources, own, hull_names(named), strict=True)
    )


def _nodes_of(bodies: Mapping[int, tuple[int, str]]) -> tuple[tuple[int, str], ...]:
    return tuple(dict.fromkeys(bodies.values()))


def _is_fixed(
    scene: Scene, convention: Convention, sources: Sequence[Source], bodies: Mapping[int, tuple[int, str]]
) -> bool:
    """Whether something that collides or is seen is part of no rigid body."""
    nodes = [*(source.node for source in sources), *visible(scene, convention)]
    return not bodies or any(node not in bodies for node in nodes)


def _bodies(scene: Scene, bodies: Mapping[int, tuple[int, str]], fixed: bool) -> tuple[Body, ...]:
    """The body of the root frame where something is part of it, then the rigid ones."""
    moving = [Body(name, rigid(scene.placements[node])) for node, name in _nodes_of(bodies)]
    return (*([Body(BODY, Pose.identity())] if fixed else []), *moving)


def _masses(scene: Scene, bodies: Mapping[int, tuple[int, str]], geoms: Sequence[Geom]) -> Iterator[Inertial]:
    for node, name in _nodes_of(bodies):
        hulls = [geom.shape for geom in geoms if geom.body == name]
        inertial = inertial_of(scene.placements[node], name, hulls)
        if inertial is not None:
            yield inertial


def _geoms(
    authored: Sequence[Authored], sources: Sequence[Source], said: Sequence[Sequence[Mentions]]
) -> Iterator[Geom]:
    for element, source, words in zip(authored, sources, said, strict=True):
        for name, part, own in zip(element.names, source.parts, words, strict=True):
            if part.shape is not None:
                yield Geom(name, element.body, part.shape, mentions=own)


def _opaque(
    authored: Sequence[Authored], sources: Sequence[Source], said: Sequence[Sequence[Mentions]]
) -> Iterator[Opaque]:
    for element, source, words in zip(authored, sources, said, strict=True):
        for name, part, own in zip(element.names, source.parts, words, strict=True):
            if part.shape is None:
                yield Opaque(name, element.body, part.reason, part.surface, source.plane, own)


def _visuals(
    source: bytes, path: Path, bodies: Mapping[int, tuple[int, str]], convention: Convention
) -> SceneSurfaces | tuple[()]:
    if convention == "plain":
        return ()
    return SceneSurfaces(source, path, {node: name for node, (_, name) in bodies.items()})


def _files(scene: Scene, path: Path) -> tuple[tuple[Path, ...], tuple[str, ...]]:
    """The files beside it that are there, and the references that lead nowhere."""
    found = companions(path)
    uris = [e.get("uri") for key in ("buffers", "images") for e in entries(scene.tree, key) if isinstance(e, dict)]
    named = [uri for uri in uris if isinstance(uri, str) and not uri.startswith("data:")]
    there = {(path.parent / key).resolve() for key in found}
    missing = [uri for uri in named if (path.parent / unquote(uri)).resolve() not in there]
    return tuple(dict.fromkeys(found.values())), tuple(dict.fromkeys(missing))
