"""Splitting one hull: along a plane, or by a decomposition of what is seen there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from meshforge.batch.preparation import record
from meshforge.batch.preparation.decompose import decompose_surface, settings_to_json, software_versions
from meshforge.common import GeometryError, pluralize, suggest_name
from meshforge.geometry import FINE_SETTINGS, DecomposeSettings, Floats, Polytope, cut, digest, partition
from meshforge.symbolic import Asset, Geom, Surface

Vector = Sequence[float]


def cut_hull(asset: Asset, before: record.Preparation, name: str, at: Vector, across: Vector) -> record.Preparation:
    """Cut a hull along the plane through `at` (3,) [m] across the direction `across` (3,).

    asset: as it was read; before: what is prepared already. `NAME#0` is behind the plane, `NAME#1` where it looks.
    Where just that was done, nothing changes. Raises GeometryError: no such hull, a direction of no length, or a plane
    that misses the hull.
    """
    settings = {"at": [*map(float, at)], "across": [*map(float, across)]}
    if before.has_divided(name, "cut", settings):
        return before
    geom = _find_hull(asset, before, name)
    below, above = cut(geom.shape, np.asarray(at, dtype=np.float64), np.asarray(across, dtype=np.float64))
    if below is None or above is None:
        box = geom.shape.aabb
        raise GeometryError(
            "the plane does not cut it",
            where=name,
            remedy=f"Choose --at within it: it reaches from ({_format_point(box.min)}) to ({_format_point(box.max)}), "
            "in the frame that the asset comes in.",
        )
    remarks = [] if geom.shape.kind in ("polytope", "box") else [f"the {geom.shape.kind} became a polytope"]
    division = _describe_division(name, (below, above), remarks)
    return _divide(asset, before, "cut", settings, software_versions(), [(geom, division)])


def split_hull(
    asset: Asset,
    before: record.Preparation,
    name: str,
    settings: DecomposeSettings,
    *,
    hollow: bool = False,
    cache: Path | None = None,
) -> record.Preparation:
    """Split a hull by a decomposition of what its body shows, or else of the opaque piece that the hull was made of.

    Of each convex piece, what lies in the hull becomes a part; parts below a thousandth of it are dropped.
    Raises GeometryError: no such hull, nothing to decompose, or a decomposition that leaves the hull as it is.
    """
    how = settings_to_json(settings, hollow)
    if before.has_divided(name, "split", how):
        return before
    geom = _find_hull(asset, before, name)
    notes: list[str] = []
    pieces = decompose_surface(
        _find_divider(asset, geom), settings, name, hollow=hollow, cache=cache, note=notes.append
    )
    parting = partition(geom.shape, pieces)
    if not parting.parts:
        raise GeometryError("nothing of what its body shows lies in it", where=name, remedy="Cut it by a plane.")
    if len(parting.parts) == 1 and parting.lost < 0.01:
        problem = f"the decomposition ({pluralize(len(pieces), 'piece')}) does not divide it"
        raise GeometryError(problem, where=name, remedy="Set a lower threshold, or cut it by a plane.")
    remarks = [f"{parting.lost:.0%} of its volume is in no part"]
    remarks += [f"{pluralize(parting.dropped, 'crumb')} dropped"] if parting.dropped else []
    division = _describe_division(name, parting.parts, [*remarks, *notes])
    return _divide(asset, before, "split", how, software_versions(settings), [(geom, division)])


@dataclass(frozen=True, eq=False, slots=True)
class HullDivision:
    """A hull and what takes its place. parts: convex; told: in words; with_body: whether it spans no parts itself, and
    is made anew with all hulls of its body."""

    hull: str
    parts: tuple[Polytope, ...]
    told: str
    with_body: bool = False


def divide_hulls(
    asset: Asset, before: record.Preparation, divisions: Sequence[HullDivision], settings: Mapping[str, Any]
) -> record.Preparation:
    """Put the parts of hulls that span parts in their place, in one step.

    settings: of the step; `pieces` is the engine of the fine pieces, CoACD where there is none. Raises GeometryError:
    no such hull.
    """
    geoms = _list_geoms(asset, before)
    rows = [(_take_hull(asset, geoms, one.hull), one) for one in divisions]
    fine = FINE_SETTINGS[settings.get("pieces", "coacd")]
    return _divide(asset, before, "divide", settings, software_versions(fine), rows)


def _list_geoms(asset: Asset, before: record.Preparation) -> dict[str, Geom]:
    return {geom.name: geom for geom in record.apply_preparation(asset, before).geoms}


def _find_hull(asset: Asset, before: record.Preparation, name: str) -> Geom:
    return _take_hull(asset, _list_geoms(asset, before), name)


def _take_hull(asset: Asset, geoms: Mapping[str, Geom], name: str) -> Geom:
    if name not in geoms:
        remedy = suggest_name(
            name, geoms, f"It has {pluralize(len(geoms), 'hull')}: meshforge info ASSET --project PROJECT"
        )
        raise GeometryError(f"there is no hull {name!r}", where=str(asset.path), remedy=remedy)
    return geoms[name]


def _find_divider(asset: Asset, geom: Geom) -> Surface:
    """What a hull is split by. Raises GeometryError where there is nothing."""
    seen = record.merge_visuals(asset, geom.body)
    piece = next((p for p in asset.opaque if p.name == geom.parent), None)
    found = seen or (piece.surface if piece else None)
    if found is None:
        problem = f"the body {geom.body!r} shows nothing that could be decomposed"
        raise GeometryError(problem, where=geom.name, remedy="Cut the hull by a plane.")
    return found


def _describe_division(hull: str, parts: Sequence[Polytope], notes: Sequence[str]) -> HullDivision:
    return HullDivision(hull, tuple(parts), "; ".join([pluralize(len(parts), "hull"), *notes]))


def _divide(
    asset: Asset,
    before: record.Preparation,
    do: Literal["cut", "split", "divide"],
    settings: Mapping[str, Any],
    software: dict[str, str],
    rows: Sequence[tuple[Geom, HullDivision]],
) -> record.Preparation:
    taken = {*(g.name for g in asset.geoms), *(o.name for o in asset.opaque), *before.hull_digests}
    entries = list[record.Replacement]()
    for geom, one in rows:
        names = record.free_names(one.hull, len(one.parts), taken)
        made = dict(zip(names, map(record.hull_digest, one.parts), strict=True))
        entries.append(record.Replacement(one.hull, "hull", digest(geom.shape), made, one.told, one.with_body))
        taken |= made.keys()
    step = record.PreparationStep(do, dict(settings), software, tuple(entries))
    return before.with_step(step, [part for _, one in rows for part in one.parts])


def _format_point(point: Floats) -> str:
    return ", ".join(f"{x:.4g}" for x in point)
