"""Writing an edited glTF file: the authored JSON where nothing changed, and all bytes of its buffers; and adding
colliders to an unmarked one, all of which stays as it is. Bodies and hulls under the names of an engine."""

import copy
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path, PurePosixPath

from meshforge.common import AssetError, join_names
from meshforge.formats import base, collision_pieces, references, visuals
from meshforge.formats.base import Output, note_renames, note_shapes_as_hulls, nothing_collides_error
from meshforge.formats.collision_pieces import names_to_keep, new_hulls, refuse_changed_files
from meshforge.formats.engine_names import CollisionNames
from meshforge.formats.gltf.colliders import collision_name_of
from meshforge.formats.gltf.document import BODY, Convention, GltfDocument, NodeRecord
from meshforge.formats.gltf.draft import SceneDraft
from meshforge.formats.gltf.output import pack_scene, prepare_base
from meshforge.formats.gltf.physics import body_nodes
from meshforge.formats.gltf.physics_style import PhysicsStyle
from meshforge.formats.gltf.styles import EngineStyle, GodotStyle, NewPiece, PlainStyle, Style, UnityStyle, UnrealStyle
from meshforge.formats.kinematic_tree import claim_name
from meshforge.formats.meshfile import gltf_document, gltf_scene
from meshforge.formats.meshfile.surface import stack_triangles
from meshforge.symbolic import Asset, Body, FeatureKind, Geom, NonConvexPiece, Surface

_ENGINES: dict[Convention, type[EngineStyle]] = {"unreal": UnrealStyle, "godot": GodotStyle, "unity": UnityStyle}


def write_gltf(asset: Asset, document: GltfDocument, name: str) -> Output:
    """Return the files of an asset that was read from a glTF file; without an edit, its own bytes.

    Raises AssetError: a buffer changed since the asset was read, nothing would be left, or an animation is in the way.
    """
    kept, known = names_to_keep(asset), {piece for element in document.authored for piece in element.names}
    made = new_hulls(asset, known)
    with gltf_document.report_damage(str(asset.path)):
        scene = gltf_scene.GltfScene.of(document.source, asset.path)
        if known <= kept and not made and Path(name).suffix.lower() == asset.path.suffix.lower():
            return Output(document.source, copies=references.find_companions(asset.path))
        refuse_changed_files(document.digests, str(asset.path), "the buffer ")
        base = prepare_base(document.source, scene, name)
        if known <= kept and not made:
            return pack_scene(base, scene, None, name)
        draft = SceneDraft(scene, copy.deepcopy(base.tree), base.before)
        style = style_of(document.convention, draft, Path(name).stem)
        names = _edit_draft(style, document, kept, made, asset.path)
        output = pack_scene(base, scene, draft.geometry, name)
    notes = _note_lacking_shapes(style, made)
    return replace(output, notes=(*notes, *note_renames(names)), names=names)


def _note_lacking_shapes(style: Style, made: Iterable[Geom]) -> list[str]:
    lacking = (geom.shape.kind for geom in made if geom.shape.kind not in style.holds)
    return note_shapes_as_hulls(lacking, f"{style.lacks} {{}}")


def _edit_draft(
    style: Style, document: GltfDocument, kept: set[str], made: Sequence[Geom], path: Path
) -> dict[str, str]:
    """Edit a draft; kept: the pieces that stay; made: the hulls that come. The names that read back otherwise."""
    draft, nodes = style.draft, {name: node for node, name in document.bodies}
    for element in document.authored:
        staying = [k for k, piece in enumerate(element.names) if piece in kept]
        if len(staying) == len(element.names):
            draft.expected[element.node] = element.names
        elif staying:
            style.keep_pieces(element, staying)
        else:
            style.remove(element)
    for geom in made:
        if geom.body not in {BODY, *nodes, *(element.body for element in document.authored)}:
            raise AssetError(f"hull {geom.name!r} is on {geom.body!r}, which is no body of the file", where=str(path))
        parent = next((e for e in document.authored if geom.parent in e.names and e.body == geom.body), None)
        holder = draft.holder_of(nodes.get(geom.body), parent.node if parent else None)
        style.add(NewPiece(geom, _own_name(geom, document), holder, parent))
    if not draft.expected:
        problem = "the edit leaves no collision in this file"
        remedy = "Leave one hull: without any, all its meshes would be taken for collision."
        raise AssetError(problem, where=str(path), remedy=remedy)
    return assign_names(draft, document, renames=style.renames)


def _own_name(piece: Geom | NonConvexPiece, document: GltfDocument) -> str:
    return piece.name.removeprefix(f"{piece.body}/") if document.bodies else piece.name


def style_of(convention: Convention, draft: SceneDraft, stem: str) -> Style:
    """Return what writes hulls in a convention; stem: of the file."""
    if convention in _ENGINES:
        return _ENGINES[convention](draft, stem)
    return PlainStyle(draft, stem) if convention == "plain" else PhysicsStyle(draft, convention)


def assign_names(draft: SceneDraft, document: GltfDocument, *, renames: bool) -> dict[str, str]:
    """Name the nodes whose pieces would else read back under other names, where the convention allows it.

    Returns the names that cannot be had all the same, with what they read back as.
    """
    misread = _find_misread(draft, document)
    for _ in range(4 if renames and misread else 0):
        for node, (body, _) in misread.items():
            draft.node(node)["name"] = collision_pieces.own_name_of(draft.expected[node], body)
        misread = _find_misread(draft, document)
    return {
        wanted: name
        for node, (_, names) in misread.items()
        for wanted, name in zip(draft.expected[node], names, strict=True)
        if wanted != name
    }


def _find_misread(draft: SceneDraft, document: GltfDocument) -> dict[int, tuple[str | None, tuple[str, ...]]]:
    """The nodes whose pieces would read back under other names, with their body, and these names."""
    scene = gltf_scene.GltfScene(draft.tree, None, draft.scene.path)
    owners, names = body_nodes(scene), dict(document.bodies)
    order = [node for node in scene.placements if node in draft.expected]
    bodies = [(names[owners[node]] if node in owners else BODY) if names else None for node in order]
    sources = [
        (body, collision_name_of(scene, scene.placements[node], document.convention), len(draft.expected[node]))
        for node, body in zip(order, bodies, strict=True)
    ]
    return {
        node: (body, read)
        for node, body, read in zip(order, bodies, collision_pieces.name_element_pieces(sources), strict=True)
        if read != draft.expected[node]
    }


def add_gltf_colliders(asset: Asset, document: GltfDocument, name: str, engine: CollisionNames | None) -> Output:
    """Return the files of a scene with the hulls of an asset beside it, as colliders of KHR_physics_rigid_bodies.

    engine: by whose names they collide instead. Raises AssetError: a buffer changed since, or there is no hull.
    """
    marked = GltfDocument(b"", engine.engine if engine else "khr", (), document.bodies)
    lost: list[NonConvexPiece] = []
    with gltf_document.report_damage(str(asset.path)):
        scene = gltf_scene.GltfScene.of(document.source, asset.path)
        refuse_changed_files(document.digests, str(asset.path), "the buffer ")
        base = prepare_base(document.source, scene, name)
        draft = SceneDraft(scene, copy.deepcopy(base.tree), base.before)
        style = style_of(marked.convention, draft, PurePosixPath(name).stem)
        for piece in _list_pieces(asset, document, draft):
            if engine and not engine.takes_non_convex and isinstance(piece.what, NonConvexPiece):
                lost.append(piece.what)
            elif isinstance(piece.what, Geom) or has_triangles(piece.what):
                style.add(piece)
        if not draft.expected:
            raise nothing_collides_error(asset)
        names = assign_names(draft, marked, renames=engine is None)
        output = pack_scene(base, scene, draft.geometry, name)
    hulls = {geom.name for geom in asset.geoms}
    renamed = {old: now for old, now in names.items() if old in hulls}
    notes = (*_note_lacking_shapes(style, asset.geoms), *(() if engine else note_renames(renamed)), *style.notes)
    losses = [lose_non_convex(engine, lost, is_seen=True)] if engine and lost else []
    return replace(output, notes=notes, names=renamed, lost=tuple(losses))


def _list_pieces(asset: Asset, document: GltfDocument, draft: SceneDraft) -> Iterator[NewPiece]:
    nodes, kept = {name: node for node, name in document.bodies}, names_to_keep(asset)
    sources = {name: (element, k) for element in document.authored for k, name in enumerate(element.names)}
    pieces: list[Geom | NonConvexPiece] = [*asset.geoms, *asset.non_convex]
    for what in pieces:
        stays = what.name in sources and what.name in kept
        origin = what.name if stays else what.parent if isinstance(what, Geom) else None
        element, part = sources.get(origin or "", (None, None))
        if element is not None and element.body != what.body:
            element = None
        holder = _holder_of(draft, element, nodes.get(what.body))
        yield NewPiece(what, _own_name(what, document), holder, element, part if stays else None)


def _holder_of(draft: SceneDraft, element: NodeRecord | None, body: int | None) -> int | None:
    """The node that a piece moves with: an animated one at or above where it comes from, else its body, else None."""
    at = element.node if element else None
    while at is not None and at != body:
        if at in draft.referred.animated and draft.keeps_volume(at):
            return at
        at = draft.scene.placements[at].parent
    return body


_NAMELESS = "body"  # how formats without bodies call the one they have


@dataclass(frozen=True, eq=False, slots=True)
class EngineBody:
    """One body; name: of what is seen of it; surfaces: what that is; pieces: what collides, each with its own name."""

    body: Body
    name: str
    surfaces: tuple[Surface, ...]
    pieces: tuple[tuple[Geom | NonConvexPiece, str], ...]


@dataclass(frozen=True, eq=False, slots=True)
class EngineBodies:
    """All bodies of an asset that have anything; lost: what the names cannot hold; notes: for the user."""

    each: tuple[EngineBody, ...]
    lost: tuple[base.Loss, ...]
    notes: tuple[str, ...]


def name_bodies(asset: Asset, engine: CollisionNames, stem: str) -> EngineBodies:
    """Return the bodies of an asset under the names of an engine; stem: of the file, for a body without a name.

    Raises AssetError: there is nothing that collides.
    """
    shown, lost = visuals.read_visual_surfaces(asset)
    found, bare, taken = [], [], set[str]()
    only = [body.name for body in asset.bodies] == [_NAMELESS]
    for body in asset.bodies:
        name = claim_name(stem if only else body.name, taken, engine.body, str.lower, "-")
        geoms = [geom for geom in asset.geoms if geom.body == body.name]
        non_convex = [piece for piece in asset.non_convex if piece.body == body.name and has_triangles(piece)]
        surfaces = tuple(surface for owner, surface in shown if owner == body.name)
        is_bare = engine.shows and not surfaces and bool(geoms or non_convex)
        if is_bare:
            parts = [(hull.vertices, hull.faces) for hull in (geom.shape.tessellate() for geom in geoms)]
            parts += [(p.surface.vertices, p.surface.faces) for p in non_convex if p.surface is not None]
            surfaces = (Surface(*stack_triangles(parts)),)
            bare.append(name)
        if non_convex and not engine.takes_non_convex:
            lost.append(lose_non_convex(engine, non_convex, is_seen=is_bare))
            non_convex = []
        prefix = f"{body.name}/" if len(asset.bodies) == 1 or engine.in_bodies else ""
        pieces: list[Geom | NonConvexPiece] = [*geoms, *non_convex]
        own = tuple((piece, piece.name.removeprefix(prefix)) for piece in pieces)
        found.append(EngineBody(body, name, surfaces, own))
    if not any(family.pieces for family in found):
        raise base.nothing_collides_error(asset)
    stands = f"{engine.title} needs a mesh to be seen: what collides stands for it in {join_names(bare, 3)}"
    kept = tuple(family for family in found if family.surfaces or family.pieces)
    return EngineBodies(kept, tuple(lost), (stands,) if bare else ())


def lose_non_convex(engine: CollisionNames, pieces: Sequence[NonConvexPiece], *, is_seen: bool) -> base.Loss:
    """Return the loss of non-convex pieces, of which an engine takes none; is_seen: whether they are shown."""
    why = f"{engine.title} makes one hull of any mesh that collides; meshforge prepare makes better ones"
    names = tuple(piece.name for piece in pieces)
    return base.Loss(FeatureKind.NON_CONVEX, names, why, "written to be seen alone" if is_seen else None)


def has_triangles(piece: NonConvexPiece) -> bool:
    """Return whether a piece has a surface to write."""
    return piece.surface is not None and len(piece.surface.faces) > 0
