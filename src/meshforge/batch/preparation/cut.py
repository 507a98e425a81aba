"""Hulls replaced by others: one cut along a plane by a person, or those of a body that is rebuilt."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from meshforge.batch.preparation import record
from meshforge.batch.preparation.decompose import software_versions
from meshforge.common import GeometryError, pluralize, suggest_name
from meshforge.geometry import FINE_SETTINGS, Floats, Polytope, cut, digest
from meshforge.symbolic import Asset, Geom

Vector = Sequence[float]


def cut_hull(asset: Asset, before: record.Preparation, name: str, at: Vector, across: Vector) -> record.Preparation:
    """Cut a hull along the plane through `at` (3,) [m] across the direction `across` (3,).

    asset: as it was read; before: what is prepared already. `NAME#0` is behind the plane, `NAME#1` where it looks.
    Where just that was done, nothing changes. Raises GeometryError: no such hull, a direction of no length, or a plane
    that misses the hull.
    """
    settings = {"at": [*map(float, at)], "across": [*map(float, across)]}
    if before.has_done("cut", name, settings):
        return before
    geom = _take_hull(asset, _list_geoms(asset, before), name)
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
    division = HullParts(name, (below, above), "; ".join(["2 hulls", *remarks]))
    return replace_hulls(asset, before, [division], settings, "cut")


@dataclass(frozen=True, eq=False, slots=True)
class HullParts:
    """A hull and what takes its place. parts: convex; told: in words."""

    hull: str
    parts: tuple[Polytope, ...]
    remark: str


def replace_hulls(
    asset: Asset,
    before: record.Preparation,
    rows: Sequence[HullParts],
    settings: Mapping[str, Any],
    do: Literal["cut", "rebuild"] = "rebuild",
) -> record.Preparation:
    """Put other hulls in the place of some, in one step.

    settings: of the step; `pieces` of a rebuild is the engine of the fine pieces. Raises GeometryError: no such hull.
    """
    geoms = _list_geoms(asset, before)
    taken = {*(g.name for g in asset.geoms), *(o.name for o in asset.non_convex), *before.hull_digests}
    entries = list[record.Replacement]()
    for one in rows:
        names = record.free_names(one.hull, len(one.parts), taken)
        made = dict(zip(names, map(record.hull_digest, one.parts), strict=True))
        geom = _take_hull(asset, geoms, one.hull)
        entries.append(record.Replacement(one.hull, "hull", digest(geom.shape), made, one.remark))
        taken |= made.keys()
    software = software_versions(FINE_SETTINGS[settings["pieces"]] if do == "rebuild" else None)
    step = record.PreparationStep(do, dict(settings), software, tuple(entries))
    return before.with_step(step, [part for one in rows for part in one.parts])


def _list_geoms(asset: Asset, before: record.Preparation) -> dict[str, Geom]:
    return {geom.name: geom for geom in record.apply_preparation(asset, before).geoms}


def _take_hull(asset: Asset, geoms: Mapping[str, Geom], name: str) -> Geom:
    if name not in geoms:
        remedy = suggest_name(
            name, geoms, f"It has {pluralize(len(geoms), 'hull')}: meshforge info ASSET --project PROJECT"
        )
        raise GeometryError(f"there is no hull {name!r}", where=str(asset.path), remedy=remedy)
    return geoms[name]


def _format_point(point: Floats) -> str:
    return ", ".join(f"{x:.4g}" for x in point)
