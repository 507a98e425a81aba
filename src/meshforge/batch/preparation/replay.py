"""A preparation replayed on an asset as it was read: pieces leave, the hulls made of them come in."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from meshforge.batch.preparation.record import Preparation, Replacement, find_sources, surface_digest
from meshforge.common import AssetError, join_names
from meshforge.formats import NO_GEOMETRY
from meshforge.geometry import digest
from meshforge.symbolic import Asset, Geom


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
    """The asset with the hulls of a preparation.

    Raises AssetError where a piece has changed since: hulls are never put in place of other geometry.
    """
    fit = replay_preparation(asset, preparation)
    if fit.lost:
        raise AssetError(
            f"its preparation is out of date: {join_names([f'{lost.what} {lost.why}' for lost in fit.lost], 3)}",
            where=str(asset.path),
            remedy="Do it again with `meshforge prepare`, or take it away with `meshforge prepare --remove`.",
        )
    return fit.asset


def replay_preparation(asset: Asset, preparation: Preparation) -> ReplayResult:
    """The asset with those hulls of a preparation whose source is what it was."""
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
    """The asset without the note that it has no collision geometry, where it has some."""
    if NO_GEOMETRY not in asset.notes or not asset.geoms:
        return asset
    return replace(asset, notes=tuple(note for note in asset.notes if note != NO_GEOMETRY))


def _find_problem(asset: Asset, entry: Replacement) -> str | None:
    """Why a piece cannot be replaced any more, None where it can."""
    known = _source_digest(asset, entry)
    if known is None:
        return "has collision geometry now, or nothing to be seen" if entry.kind == "body" else "is gone"
    return None if known == entry.source else "has another geometry now"


def _source_digest(asset: Asset, entry: Replacement) -> str | None:
    if entry.kind == "hull":
        return next((digest(geom.shape) for geom in asset.geoms if geom.name == entry.what), None)
    if entry.kind == "opaque":
        asset = replace(asset, bodies=())  # so that visuals are not read
    found = (s for s in find_sources(asset) if (s.kind, s.what) == (entry.kind, entry.what))
    return next((surface_digest(source.surface) for source in found), None)


def _replace_piece(asset: Asset, entry: Replacement, preparation: Preparation, authored: set[str]) -> Asset:
    """The asset after one replacement. Hulls of a hull stand in its place, others behind all that are there."""
    shapes = {name: preparation.hulls[known] for name, known in entry.made.items()}
    if entry.kind == "hull":
        old = next(geom for geom in asset.geoms if geom.name == entry.what)
        parent = old.parent or (old.name if old.name in authored else None)
        parts = [Geom(name, old.body, shape, parent, mentions=old.mentions) for name, shape in shapes.items()]
        return asset.with_geoms(_splice(asset.geoms, old, parts))
    gone = next((piece for piece in asset.opaque if piece.name == entry.what), None) if entry.kind == "opaque" else None
    body, parent = (gone.body, gone.name) if gone else (entry.what, None)
    mentions = gone.mentions if gone else ()
    made = (Geom(name, body, shape, parent, mentions=mentions) for name, shape in shapes.items())
    return replace(
        asset, geoms=(*asset.geoms, *made), opaque=tuple(piece for piece in asset.opaque if piece is not gone)
    )


def _splice(geoms: Iterable[Geom], old: Geom, parts: list[Geom]) -> Iterable[Geom]:
    for geom in geoms:
        yield from parts if geom is old else [geom]
