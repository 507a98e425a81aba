"""The bodies of an asset under the names of an engine: the meshes of each, and what of it collides."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

from meshforge.common import join_names
from meshforge.formats import base, visuals
from meshforge.formats.engine_names.conventions import CollisionNames
from meshforge.formats.meshfile.surface import stack_triangles
from meshforge.symbolic import Asset, Body, FeatureKind, Geom, Opaque, Surface

_NAMELESS = "body"  # how formats without bodies call the one they have


@dataclass(frozen=True, eq=False, slots=True)
class EngineBody:
    """One body; name: of what is seen of it; surfaces: what that is; hulls, opaque: what collides, each by its name."""

    body: Body
    name: str
    surfaces: tuple[Surface, ...]
    hulls: dict[str, Geom]
    opaque: dict[str, Opaque]


@dataclass(frozen=True, eq=False, slots=True)
class EngineBodies:
    """All bodies of an asset that have anything; lost: what the names cannot hold; notes: for the user."""

    each: tuple[EngineBody, ...]
    lost: tuple[base.Loss, ...]
    notes: tuple[str, ...]

    @property
    def names(self) -> dict[str, str]:
        """The names of hulls in the file, by those in the asset."""
        return {geom.name: name for family in self.each for name, geom in family.hulls.items()}


def name_bodies(asset: Asset, engine: CollisionNames, stem: str) -> EngineBodies:
    """The bodies of an asset under the names of an engine; stem: of the file, for a body without a name.

    Raises AssetError: there is nothing that collides.
    """
    return _Namer(asset, engine, stem).name_all()


class _Namer:
    def __init__(self, asset: Asset, engine: CollisionNames, stem: str) -> None:
        self.asset, self.engine, self.stem = asset, engine, stem
        self.taken: set[str] = set()
        surfaces, refused = visuals.read_visual_surfaces(asset)
        self.surfaces = {body.name: [s for owner, s in surfaces if owner == body.name] for body in asset.bodies}
        self.lost = list(refused)
        self.bare: list[str] = []

    def name_all(self) -> EngineBodies:
        asset, engine = self.asset, self.engine
        collides = [piece for piece in asset.opaque if _has_triangles(piece)] if engine.takes_opaque else []
        if not asset.geoms and not collides:
            raise base.no_hulls_error(asset)
        bases = [self.stem] if [body.name for body in asset.bodies] == [_NAMELESS] else [b.name for b in asset.bodies]
        names = [self._claim_name(engine.body, name) for name in bases]
        found = [self._name_body(*pair) for pair in zip(asset.bodies, names, strict=True)]
        notes = list[str]()
        if self.bare:
            notes.append(
                f"{engine.title} needs a mesh to be seen: what collides stands for it in {join_names(self.bare, 3)}"
            )
        kept = tuple(one for one in found if one.surfaces or one.hulls or one.opaque)
        return EngineBodies(kept, tuple(self.lost), tuple(notes))

    def _name_body(self, body: Body, name: str) -> EngineBody:
        engine = self.engine
        geoms = [geom for geom in self.asset.geoms if geom.body == body.name]
        opaque = [piece for piece in self.asset.opaque if piece.body == body.name and _has_triangles(piece)]
        surfaces = tuple(self.surfaces[body.name])
        bare = engine.shows and not surfaces and bool(geoms or opaque)
        if bare:
            surfaces = _merge_surfaces(geoms, opaque)
            self.bare.append(name)
        if opaque and not engine.takes_opaque:
            why = f"{engine.title} makes one hull of any mesh that collides; meshforge prepare makes better ones"
            instead = "written to be seen alone" if bare else None
            self.lost.append(base.Loss(FeatureKind.OPAQUE, tuple(piece.name for piece in opaque), why, instead))
            opaque = []
        hulls = {
            self._claim_name(partial(engine.hull, name, geom, k), self._own_name_of(geom)): geom
            for k, geom in enumerate(geoms)
        }
        pieces = {self._claim_name(engine.opaque, self._own_name_of(piece)): piece for piece in opaque}
        return EngineBody(body, name, surfaces, hulls, pieces)

    def _own_name_of(self, thing: Geom | Opaque) -> str:
        """The name without the body, where there is only one or the engine reads it below its body."""
        alone = len(self.asset.bodies) == 1 or self.engine.in_bodies
        return thing.name.removeprefix(f"{thing.body}/") if alone else thing.name

    def _claim_name(self, named: Callable[[str], str], wanted: str) -> str:
        """What `named` makes of a name, or of it with a number, that no other has; Unreal takes no notice of case."""
        name, number = named(wanted), 2
        while name.lower() in self.taken:
            name, number = named(f"{wanted}-{number}"), number + 1
        self.taken.add(name.lower())
        return name


def _has_triangles(piece: Opaque) -> bool:
    return piece.surface is not None and len(piece.surface.faces) > 0


def _merge_surfaces(geoms: Sequence[Geom], opaque: Sequence[Opaque]) -> tuple[Surface, ...]:
    hulls = [geom.shape.tessellate() for geom in geoms]
    parts: list[Surface] = [Surface(hull.vertices, hull.faces) for hull in hulls]
    parts += [piece.surface for piece in opaque if piece.surface is not None]
    return (Surface(*stack_triangles((part.vertices, part.faces) for part in parts)),)
