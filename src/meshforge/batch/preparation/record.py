"""A preparation as data: what of an asset can be decomposed, which pieces are replaced by which hulls and how these
were made; and replayed on an asset as it was read."""

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal, Self

import numpy as np

from meshforge.common import AssetError, join_names, pluralize
from meshforge.formats import NO_GEOMETRY
from meshforge.geometry import Polytope, SurfaceParts, digest, is_line, stack_parts
from meshforge.symbolic import Asset, Geom, NonConvexPiece, Surface

SourceKind = Literal["opaque", "element", "body", "hull"]
"""What is replaced: an opaque piece; all pieces of a collision element; nothing, by what a body shows that
has no collision geometry; or a hull."""

_GRID = 1.4142135e-7
"""[m] Coordinates are compared in these steps; no round number, so that rounding errors tip no round coordinates."""


_DONE = {"decompose": "decomposed", "cut": "cut", "rebuild": "rebuilt", "split": "split", "divide": "divided"}


@dataclass(frozen=True, slots=True)
class Replacement:
    """One piece and the hulls that stand in its place.

    what: the name of the piece, the element or the body; source: the digest of its geometry, by which a change is
    noticed; made: the digest of each hull by its name; remark: how well they fit, for people.
    """

    what: str
    kind: SourceKind
    source: str
    made: dict[str, str]
    remark: str = ""


@dataclass(frozen=True, slots=True)
class PreparationStep:
    """One thing done to an asset.

    do: `decompose` by an engine, `cut` a hull along a plane, or `rebuild` bodies of which hulls span parts; earlier
    versions did `split` and `divide` to hulls, which are read and taken back like these.
    settings: all that it was done with; software: the versions of what did it.
    """

    do: Literal["decompose", "cut", "rebuild", "split", "divide"]
    settings: dict[str, Any]
    software: dict[str, str]
    replaced: tuple[Replacement, ...]

    def __str__(self) -> str:
        """`link/geom0 decomposed into 12 hulls by coacd`."""
        names = [entry.what for entry in self.replaced]
        kind = "hulls" if self.do in ("rebuild", "divide") else "pieces"
        what = names[0] if len(names) == 1 else f"{len(names)} {kind}"
        by = f" by {self.settings['method']}" if "method" in self.settings else ""
        return f"{what} {_DONE[self.do]} into {pluralize(sum(len(entry.made) for entry in self.replaced), 'hull')}{by}"


@dataclass(frozen=True, eq=False, slots=True)
class Preparation:
    """All that is done to one asset, in order; hulls: every hull that the steps name, by the digest they name it by."""

    steps: tuple[PreparationStep, ...] = ()
    hulls: Mapping[str, Polytope] = field(default_factory=dict)

    @property
    def hull_digests(self) -> dict[str, str]:
        """The digests of all hulls it makes by name, those that later steps replace too."""
        return {name: known for step in self.steps for r in step.replaced for name, known in r.made.items()}

    def has_done(self, do: str, hull: str, settings: Mapping[str, Any]) -> bool:
        """Return whether a step did just that to a hull, which is not there any more."""
        alike = (step for step in self.steps if step.do == do and step.settings == settings)
        return any(entry.what == hull for step in alike for entry in step.replaced)

    def with_step(self, step: PreparationStep, hulls: Iterable[Polytope]) -> Self:
        """Return the preparation with one step more, which makes these hulls."""
        made = {hull_digest(hull): hull for hull in hulls}
        return replace(self, steps=(*self.steps, step), hulls={**self.hulls, **made})

    def with_only(self, steps: Iterable[PreparationStep]) -> Self:
        """Return the preparation with these of its steps, and their hulls."""
        shorter = replace(self, steps=tuple(steps))
        return replace(shorter, hulls={known: self.hulls[known] for known in shorter.hull_digests.values()})


def hull_digest(hull: Polytope) -> str:
    """Return a digest of a hull to the last bit; zero has no sign."""
    return hashlib.blake2b((hull.vertices + 0.0).tobytes() + hull.faces.tobytes(), digest_size=8).hexdigest()


def free_names(base: str, count: int, taken: Iterable[str]) -> list[str]:
    """Return names `base#0`, `base#1`, ... for new hulls, numbers that are taken left out."""
    taken, number = set(taken), 0
    names: list[str] = []
    while len(names) < count:
        name = f"{base}#{number}"
        names += [] if name in taken else [name]
        number += 1
    return names


@dataclass(frozen=True, eq=False, slots=True)
class DecompositionSource:
    """Geometry without hulls.

    what: the name of the opaque piece, the element or the body; base: what names of its hulls begin with;
    surface: its triangles.
    """

    what: str
    kind: SourceKind
    body: str
    base: str
    surface: Surface

    @property
    def is_hopeless(self) -> bool:
        """Whether it has no area, so that no engine makes hulls of it."""
        return is_line(self.surface.vertices[self.surface.faces].reshape(-1, 3))


def find_sources(asset: Asset, as_read: Asset | None = None) -> tuple[DecompositionSource, ...]:
    """Return all that can be decomposed, in the order of the file; planes and the like, which have no triangles, stay.

    as_read: where it is given, a collision element of which all pieces are still as they were read is one source.
    """
    whole = _find_elements(as_read) if as_read else {}
    elements = {e: own for e, own in _find_elements(asset).items() if len(own) == len(whole.get(e, ()))}
    joined = (_join_element(element, own) for element, own in elements.items())
    pieces = (
        DecompositionSource(piece.name, "opaque", piece.body, piece.name, piece.surface)
        for piece in asset.non_convex
        if piece.surface is not None and len(piece.surface.faces) and piece.element not in elements
    )
    return (*(source for source in joined if source), *pieces, *_find_bare_bodies(asset))


def _find_elements(asset: Asset) -> dict[str, list[Geom | NonConvexPiece]]:
    found = dict[str, list[Geom | NonConvexPiece]]()
    pieces: list[Geom | NonConvexPiece] = [*asset.geoms, *asset.non_convex]
    for piece in pieces:
        if piece.element:
            found.setdefault(piece.element, []).append(piece)
    return found


def _join_element(element: str, pieces: Sequence[Geom | NonConvexPiece]) -> DecompositionSource | None:
    body = pieces[0].body
    hulls = [piece.shape.tessellate() for piece in pieces if isinstance(piece, Geom)]
    shown = [piece.surface for piece in pieces if isinstance(piece, NonConvexPiece) and piece.surface]
    joined = _stack([*(Surface(hull.vertices, hull.faces) for hull in hulls), *shown], body)
    return DecompositionSource(element, "element", body, element, joined) if joined else None


def _find_bare_bodies(asset: Asset) -> Iterable[DecompositionSource]:
    """The bodies without collision geometry, by what they show. Their hulls are called as if the file had one geom."""
    solid = {geom.body for geom in asset.geoms} | {piece.body for piece in asset.non_convex}
    for body in asset.bodies:
        seen = merge_visuals(asset, body.name) if body.name not in solid else None
        if seen:
            yield DecompositionSource(body.name, "body", body.name, f"{body.name}/geom0", seen)


def merge_visuals(asset: Asset, body: str) -> Surface | None:
    """Return all that a body shows, None where that is nothing; what has no body counts for one that is alone."""
    alone = len(asset.bodies) == 1
    own = [s for s in asset.visuals if len(s.faces) and (s.body == body or (s.body is None and alone))]
    return _stack(own, body)


def find_surfaces(asset: Asset) -> dict[str, Surface]:
    """Return the surface that the hulls of each body stand for, of an asset as it was read; bodies without any are left
    out.

    Non-convex collision pieces of a body count where it has any, since hulls are made of these; else what it shows.
    """
    found = dict[str, Surface]()
    for body in asset.bodies:
        pieces = [p.surface for p in asset.non_convex if p.body == body.name and p.surface and len(p.surface.faces)]
        if surface := _stack(pieces, body.name) or merge_visuals(asset, body.name):
            found[body.name] = surface
    return found


def _stack(own: Sequence[Surface], body: str) -> Surface | None:
    if not own:
        return None
    faces = [s.faces + start for s, start in zip(own, np.cumsum([0, *(len(s.vertices) for s in own)]), strict=False)]
    parts = [s.parts or SurfaceParts(np.zeros(len(s.faces), np.int64), (f"part_{k}",)) for k, s in enumerate(own)]
    return Surface(np.concatenate([s.vertices for s in own]), np.concatenate(faces), body, parts=stack_parts(parts))


def surface_digest(surface: Surface) -> str:
    """Return a digest of triangles in their order, the same for coordinates that differ by rounding."""
    steps = np.rint(surface.vertices[surface.faces] / _GRID).astype(np.int64)
    return hashlib.blake2b(steps.tobytes(), digest_size=8).hexdigest()


@dataclass(frozen=True, slots=True)
class PieceProblem:
    """A piece that is not what it was when it was prepared, and why."""

    what: str
    why: str


@dataclass(frozen=True, eq=False, slots=True)
class ReplayResult:
    """The asset after what of a preparation still fits it; preparation: that part; lost: all else."""

    asset: Asset
    preparation: Preparation
    lost: tuple[PieceProblem, ...]


def apply_preparation(asset: Asset, preparation: Preparation) -> Asset:
    """Return the asset with the hulls of a preparation.

    Raises AssetError where a piece has changed since: hulls are never put in place of other geometry.
    """
    fit = replay_preparation(asset, preparation)
    if fit.lost:
        problem = f"its preparation is out of date: {join_names([f'{lost.what} {lost.why}' for lost in fit.lost], 3)}"
        remedy = "Do it again with `meshforge prepare`, or take it away with `meshforge prepare --remove`."
        raise AssetError(problem, where=str(asset.path), remedy=remedy)
    return fit.asset


def replay_preparation(asset: Asset, preparation: Preparation) -> ReplayResult:
    """Return the asset with those hulls of a preparation whose source is what it was."""
    authored = {geom.name for geom in asset.geoms}
    current, kept, lost = asset, [], []
    for step in preparation.steps:
        fits = []
        for entry in step.replaced:
            why = _find_problem(current, entry)
            if why:
                lost.append(PieceProblem(entry.what, why))
            else:
                fits.append(entry)
                current = _replace_piece(current, entry, preparation, authored)
        kept += [replace(step, replaced=tuple(fits))] if fits else []
    return ReplayResult(_drop_outdated_note(current), preparation.with_only(kept), tuple(lost))


def _drop_outdated_note(asset: Asset) -> Asset:
    if NO_GEOMETRY not in asset.notes or not asset.geoms:
        return asset
    return replace(asset, notes=tuple(note for note in asset.notes if note != NO_GEOMETRY))


def _find_problem(asset: Asset, entry: Replacement) -> str | None:
    known = _source_digest(asset, entry)
    if known is None:
        return "has collision geometry now, or nothing to be seen" if entry.kind == "body" else "is gone"
    return None if known == entry.source else "has another geometry now"


def _source_digest(asset: Asset, entry: Replacement) -> str | None:
    if entry.kind == "hull":
        return next((digest(geom.shape) for geom in asset.geoms if geom.name == entry.what), None)
    if entry.kind in ("opaque", "element"):
        asset = replace(asset, bodies=())  # so that visuals are not read
    sources = find_sources(asset, asset if entry.kind == "element" else None)
    found = (s for s in sources if (s.kind, s.what) == (entry.kind, entry.what))
    return next((surface_digest(source.surface) for source in found), None)


def _replace_piece(asset: Asset, entry: Replacement, preparation: Preparation, authored: set[str]) -> Asset:
    """The asset after one replacement. Hulls of a hull stand in its place, others behind all that are there."""
    shapes = {name: preparation.hulls[known] for name, known in entry.made.items()}
    if entry.kind == "hull":
        old = next(geom for geom in asset.geoms if geom.name == entry.what)
        parent = old.parent or (old.name if old.name in authored else None)
        parts = [Geom(name, old.body, shape, parent, mentions=old.mentions) for name, shape in shapes.items()]
        return asset.with_geoms(part for geom in asset.geoms for part in (parts if geom is old else [geom]))
    gone: Sequence[Geom | NonConvexPiece] = ()
    if entry.kind == "element":
        gone = _find_elements(asset)[entry.what]
    elif entry.kind == "opaque":
        gone = [piece for piece in asset.non_convex if piece.name == entry.what]
    body, parent = (gone[0].body, gone[0].name) if gone else (entry.what, None)
    mentions = tuple(one for one in gone[0].mentions if len(gone) == 1 or one[0] != "group") if gone else ()
    made = (Geom(name, body, shape, parent, mentions=mentions) for name, shape in shapes.items())
    return replace(
        asset,
        geoms=(*(geom for geom in asset.geoms if geom not in gone), *made),
        non_convex=tuple(piece for piece in asset.non_convex if piece not in gone),
    )
