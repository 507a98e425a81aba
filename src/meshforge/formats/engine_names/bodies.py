"""The bodies of an asset under the names of an engine: what each shows, and what of it collides."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from meshforge.common import join_names
from meshforge.formats import base, visuals
from meshforge.formats.engine_names.conventions import CollisionNames, claim_name
from meshforge.formats.meshfile.surface import stack_triangles
from meshforge.symbolic import Asset, Body, FeatureKind, Geom, NonConvexPiece, Surface

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
        name = claim_name(engine.body, stem if only else body.name, taken)
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
    """Return the loss of non-convex pieces of which an engine takes none; is_seen: whether they are there to be
    seen."""
    why = f"{engine.title} makes one hull of any mesh that collides; meshforge prepare makes better ones"
    names = tuple(piece.name for piece in pieces)
    return base.Loss(FeatureKind.NON_CONVEX, names, why, "written to be seen alone" if is_seen else None)


def has_triangles(piece: NonConvexPiece) -> bool:
    """Return whether a piece has a surface to write."""
    return piece.surface is not None and len(piece.surface.faces) > 0
