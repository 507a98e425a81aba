"""Hulls brought within the limits of an engine, as far as nothing is lost and little is added."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from meshforge import geometry
from meshforge.checks.legality import check_legality
from meshforge.checks.physics.pairs import exclude_pairs
from meshforge.engines import Engine, Limit, make_limit
from meshforge.symbolic import Hull, SymbolicMesh

TOLERANCE = 0.01
"""How far a fixed hull may stick out of the old one by default, as a share of the mesh's diagonal."""
_COUNTS = {"vertices": "vertices", "polygons": "polygons", "face-vertices": "polygon_vertices"}

_MARGIN = 1e-6  # beyond the thickness that is asked for, against rounding


@dataclass(frozen=True, slots=True)
class HullFix:
    """A hull that another one of its name took the place of; error: how far that sticks out of it [m].

    vertices, polygons: numbers before and after.
    """

    hull: str
    rules: tuple[str, ...]
    error: float
    vertices: tuple[int, int]
    polygons: tuple[int, int]

    @property
    def description(self) -> str:
        """The change in a sentence."""
        before, after = (f"{self.vertices[k]} vertices on {self.polygons[k]} flat faces" for k in (0, 1))
        return f"{self.hull}: {before}; now {after}, which sticks out by {self.error:.3g} m at most"


@dataclass(frozen=True, eq=False, slots=True)
class FixResult:
    """A fixed mesh, the very same object where nothing was; left: hulls beyond a limit, and why they were left.

    parted: collision meshes of several pieces, each of which is written to a file of its own; excluded: pairs of bodies
    that do not touch any more.
    """

    mesh: SymbolicMesh
    changes: tuple[HullFix, ...]
    left: tuple[str, ...]
    parted: tuple[str, ...] = ()
    excluded: tuple[str, ...] = ()

    def to_json(self) -> dict[str, Any]:
        """Return the changes as JSON-able data; lengths in metres."""
        rows = [
            {
                "hull": change.hull,
                "rules": list(change.rules),
                "error": change.error,
                "vertices": {"before": change.vertices[0], "after": change.vertices[1]},
                "polygons": {"before": change.polygons[0], "after": change.polygons[1]},
            }
            for change in self.changes
        ]
        lists = {name: list(getattr(self, name)) for name in ("left", "parted", "excluded")}
        return {"changes": rows, **lists}


def fix(
    mesh: SymbolicMesh,
    engine: Engine | None,
    tolerance: float | None = None,
    max_vertices: int | None = None,
    exclude: Sequence[str] = (),
) -> FixResult:
    """Return the mesh with fewer vertices where a hull has too many, and more thickness where it has too little, for an
    engine or a number of vertices.

    A new hull is convex, holds all of the old one, and takes over its name, label, body and contact attributes. It is
    left as it is where the new one would stick out by more than `tolerance` [m], by default 1% of the mesh's diagonal
    (without an end where `max_vertices` is given), or would come to overlap a hull of another body. In a URDF or SDF
    for MuJoCo or Bullet, which make one hull of a mesh file, each hull goes into a file of its own.
    exclude: pairs of bodies that are not to touch, see `exclude_pairs`.
    """
    allowed = tolerance if tolerance is not None else np.inf if max_vertices else TOLERANCE * mesh.diagonal
    asked = [make_limit("vertices", max_vertices, "error", "", "")] if max_vertices else []
    limits = (*asked, *(engine.limits if engine else ()))
    faulty, _ = check_legality(mesh)
    hulls, changes, left = list(mesh.hulls), [], []
    for k, hull in enumerate(mesh.hulls):
        broken = [] if hull.name in faulty else _find_broken_limits(limits, hull)
        if not broken:
            continue
        made = _enclose_within_limits(hull, limits, broken)
        why = _find_objection(made, hull, limits, allowed, hulls)
        if made is None or why:
            left.append(f"{hull.name}: left as it is, since {why}")
            continue
        hulls[k] = replace(hull, shape=made.hull, parent=hull.parent or hull.name)
        shapes = hull.shape.tessellate(), made.hull
        (vertices, fewer), (polygons, left_over) = (
            (len(one.vertices) for one in shapes),
            (len(geometry.polygon_sizes(one)) for one in shapes),
        )
        rules = tuple(limit.rule for limit in broken)
        changes.append(HullFix(hull.name, rules, made.error, (vertices, fewer), (polygons, left_over)))
    ready = mesh.with_hulls(hulls) if changes else mesh
    parted = _find_several(mesh) if engine is not None and engine.name in ("mujoco", "bullet") else ()
    if parted and ready.asset:
        ready = replace(ready, asset=replace(ready.asset, one_file_a_hull=True))
    ready, excluded = exclude_pairs(ready, exclude)
    return FixResult(ready, tuple(changes), tuple(left), parted, excluded)


def _find_several(mesh: SymbolicMesh) -> tuple[str, ...]:
    """The collision meshes of several pieces in a URDF or SDF."""
    asset = mesh.asset
    if asset is None or asset.format not in ("urdf", "sdf"):
        return ()
    elements = [*(geom.element for geom in asset.geoms), *(piece.element for piece in asset.non_convex)]
    return tuple(dict.fromkeys(filter(None, elements)))


def _find_broken_limits(limits: Sequence[Limit], hull: Hull) -> list[Limit]:
    """The limits that a hull keeps not to and that could be fixed; `volume` asks for more than a new shape."""
    shape = hull.shape
    if not isinstance(shape, geometry.Polytope):
        return []
    fixable = (limit for limit in limits if limit.rule in (*_COUNTS, "thin"))
    return [limit for limit in fixable if limit.is_broken(limit.measure(shape))]


def _enclose_within_limits(hull: Hull, limits: Sequence[Limit], broken: list[Limit]) -> geometry.Enclosure | None:
    made = geometry.Enclosure(hull.shape.tessellate(), 0.0)
    for limit in broken:
        if limit.rule == "thin":
            made = thicken(made.hull, limit.number)
    if any(limit.rule in _COUNTS for limit in broken):
        counts: dict[str, float] = {}
        for rule, name in _COUNTS.items():
            counts[name] = min((limit.number for limit in limits if limit.rule == rule), default=np.inf)
        found = geometry.enclose(made.hull, geometry.HullBudget(**counts))
        return geometry.Enclosure(found.hull, made.error + found.error) if found else None
    return made


def _find_objection(
    made: geometry.Enclosure | None, hull: Hull, limits: Sequence[Limit], allowed: float, hulls: list[Hull]
) -> str | None:
    """Why a fixed hull must not take the place of another; None where it may."""
    if made is None:
        return "no simpler hull around it was found"
    if made.error > allowed:
        return f"a hull within the limits would stick out by {made.error:.3g} m, more than {allowed:.3g} m"
    if any(limit.is_broken(limit.measure(made.hull)) for limit in _find_broken_limits(limits, Hull("", "", made.hull))):
        return "no hull that keeps to all limits was found"
    for other in hulls:
        meets = other.body != hull.body and made.hull.aabb.touches(other.aabb)
        if meets and geometry.distance(made.hull, other.shape) == 0.0 < geometry.distance(hull.shape, other.shape):
            return f"it would come to overlap {other.name} of body {other.body}"
    return None


def thicken(hull: geometry.Polytope, thickness: float) -> geometry.Enclosure:
    """Return the hull swept along its thinnest principal axis, to both sides alike, until it is `thickness` [m] thick.

    It holds the hull it was, and sticks out by the step to each side at most; one that is thick enough stays as it is.
    """
    _, axes, extents = geometry.principal_extents(hull.vertices)
    lacking = thickness * (1 + _MARGIN) - float(extents[2])
    if lacking <= 0:
        return geometry.Enclosure(hull, 0.0)
    step = axes[2] * (lacking / 2)
    made = geometry.convex_hull(np.concatenate([hull.vertices - step, hull.vertices + step]), name="a thickened hull")
    return geometry.Enclosure(made, lacking / 2)
