"""A preparation replayed on an asset as it was read: pieces leave, the hulls made of them come in."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from meshforge.asset import Asset, Geom
from meshforge.errors import AssetError
from meshforge.formats import NO_GEOMETRY
from meshforge.geometry import digest
from meshforge.preparation.record import Preparation, Replaced
from meshforge.preparation.sources import sources, surface_digest
from meshforge.words import listed


@dataclass(frozen=True, slots=True)
class Lost:
    """A piece that is not what it was when it was prepared, and why."""

    what: str
    why: str


@dataclass(frozen=True, eq=False, slots=True)
class Fitting:
    """The asset after what of a preparation still fits it; preparation: that part; lost: all else."""

    asset: Asset
    preparation: Preparation
    lost: tuple[Lost, ...]


def prepared(asset: Asset, preparation: Preparation) -> Asset:
    """The asset with the hulls of a preparation.

    Raises AssetError where a piece has changed since: hulls are never put in place of other geometry.
    """
    fit = fitting(asset, preparation)
    if fit.lost:
        raise AssetError(
            f"its preparation is out of date: {listed([f'{lost.what} {lost.why}' for lost in fit.lost], 3)}",
            where=str(asset.path),
            remedy="Do it again with `meshforge prepare`, or take it away with `meshforge prepare --remove`.",
        )
    return fit.asset


def fitting(asset: Asset, preparation: Preparation) -> Fitting:
    """The asset with those hulls of a preparation whose source is what it was."""
    authored = {geom.name for geom in asset.geoms}
    current, kept, lost = asset, [], []
    for step in preparation.steps:
        fits = []
        for entry in step.replaced:
            why = _problem(current, entry)
            if why:
                lost.append(Lost(entry.what, why))
            else:
                fits.append(entry)
                current = _with(current, entry, preparation, authored)
        kept += [replace(step, replaced=tuple(fits))] if fits else []
    return Fitting(_noted(current), preparation.with_only(kept), tuple(lost))


def _noted(asset: Asset) -> Asset:
    """The asset without the note that it has no collision geometry, where it has some."""
    if NO_GEOMETRY not in asset.notes or not asset.geoms:
        return asset
    return replace(asset, notes=tuple(note for note in asset.notes if note != NO_GEOMETRY))


def _problem(asset: Asset, entry: Replaced) -> str | None:
    """Why a piece cannot be replaced any more, None where it can."""
    known = _source_digest(asset, entry)
    if known is None:
        return "has collision geometry now, or nothing to be seen" if entry.kind == "body" else "is gone"
    return None if known == entry.source else "has another geometry now"


def _source_digest(asset: Asset, entry: Replaced) -> str | None:
    if entry.kind == "hull":
        return next((digest(geom.shape) for geom in asset.geoms if geom.name == entry.what), None)
    if entry.kind == "opaque":
        asset = replace(asset, bodies=())  # so that visuals are not read
    found = (s for s in sources(asset) if (s.kind, s.what) == (entry.kind, entry.what))
    return next((surface_digest(source.surface) for source in found), None)


def _with(asset: Asset, entry: Replaced, preparation: Preparation, authored: set[str]) -> Asset:
    """The asset after one replacement. Hulls of a hull stand in its place, others behind all that are there."""
    shapes = {name: preparation.hulls[known] for name, known in entry.made.items()}
    if entry.kind == "hull":
        old = next(geom for geom in asset.geoms if geom.name == entry.what)
        parent = old.parent or (old.name if old.name in authored else None)
        parts = [Geom(name, old.body, shape, parent, mentions=old.mentions) for name, shape in shapes.items()]
        return asset.with_geoms(_spliced(asset.geoms, old, parts))
    gone = next((piece for piece in asset.opaque if piece.name == entry.what), None) if entry.kind == "opaque" else None
    body, parent = (gone.body, gone.name) if gone else (entry.what, None)
    said = gone.mentions if gone else ()
    made = (Geom(name, body, shape, parent, mentions=said) for name, shape in shapes.items())
    return replace(
        asset, geoms=(*asset.geoms, *made), opaque=tuple(piece for piece in asset.opaque if piece is not gone)
    )


def _spliced(geoms: Iterable[Geom], old: Geom, parts: list[Geom]) -> Iterable[Geom]:
    for geom in geoms:
        yield from parts if geom is old else [geom]
