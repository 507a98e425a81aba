"""Criteria of physics: what `meshforge goal` tries, at the true sites of an asset."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from manifold3d import Manifold

from benchmark.assets.asset import Site
from benchmark.criteria.case import Case
from benchmark.criteria.solid import near, solid
from meshforge.checks.physics.gripper import Pull, try_grasp
from meshforge.checks.physics.motion import try_stand, try_swing
from meshforge.checks.physics.objects import ObjectShape, ProbeShape, objects_on, try_contain, try_pass, try_support
from meshforge.checks.physics.scene import Failure, Place
from meshforge.symbolic import Hull

NO_HULL = "no hull is left"


def stands(case: Case) -> str | None:
    """Why the mesh does not stand."""
    return _text(try_stand(case.mesh.hulls, case.mesh.diagonal)) if case.mesh.hulls else NO_HULL


def supports(case: Case, site: str) -> str | None:
    """Why the surface of some site of that name does not support."""
    objects = [one for name, place in _places(case, site).items() for one in objects_on(name, place)]
    if not objects or not case.mesh.hulls:
        return f"{site}: {NO_HULL}" if objects else None
    return _text(try_support(case.mesh.hulls, objects, case.touching))


def contains(case: Case, site: str, shape: ObjectShape = "box") -> str | None:
    """Why the object does not stay at some site of that name."""
    places = _places(case, site)
    if not places or not case.mesh.hulls:
        return f"{site}: {NO_HULL}" if places else None
    return _text(try_contain(case.mesh.hulls, places, shape, case.touching))


def passes(case: Case, site: str, shape: ProbeShape = "box") -> str | None:
    """Why the probe does not pass at some site of that name."""
    ways = _places(case, site)
    return _text(try_pass(case.mesh.hulls, ways, shape, case.touching)) if ways and case.mesh.hulls else None


def graspable(case: Case, site: str, pull: Pull = "back") -> str | None:
    """Why the gripper fails at some site of that name."""
    grips = _places(case, site)
    if grips and not case.mesh.hulls:
        return f"{site}: {NO_HULL}"
    for name, grip in grips.items():
        if why := try_grasp(case.mesh.hulls, grip, pull, case.touching):
            return f"{name}: {why}"
    return None


def swings(case: Case, site: str) -> str | None:
    """Why what moves at some site of that name does not swing.

    Where several sites move hulls of one label, each moves those of its own parts, and the others stand still.
    """
    sites = case.asset.site(site)
    for (name, joint), where in zip(_places(case, site).items(), sites, strict=True):
        rivals = [other for other in sites if set(other.moving) & set(where.moving)]
        leaf = [hull for hull in case.mesh.hulls if hull.label in where.moving and _mover(hull, case, rivals) is where]
        moving = {hull.name for hull in leaf}
        rest = [hull for hull in case.mesh.hulls if hull.name not in moving]
        if not leaf:
            return f"{name}: no hull {' or '.join(where.moving)} is left"
        if why := try_swing(leaf, rest, joint, case.touching):
            return f"{name}: {why}"
    return None


def _text(why: Failure | None) -> str | None:
    return why.text if why else None


def _places(case: Case, site: str) -> dict[str, Place]:
    return {f"{site} {number}": _to_place(where) for number, where in enumerate(case.asset.site(site), 1)}


def _to_place(site: Site) -> Place:
    x, y, _ = np.asarray(site.axes, dtype=np.float64)
    return Place(np.asarray(site.at), np.asarray(site.size), np.stack([x, y, np.cross(x, y)], axis=1))


def _mover(hull: Hull, case: Case, rivals: Sequence[Site]) -> Site:
    """The site that moves a hull: the one nearest to the part that the hull is of."""
    if len(rivals) == 1:
        return rivals[0]
    body = solid(hull)
    rows = [part.solid for part in case.asset.parts if any(part.label in site.moving for site in rivals)]
    inside = [float((part ^ body).volume()) if near(part, body) else 0.0 for part in rows]
    best = np.argmax(inside) if max(inside) > 0 else np.argmin([body.min_gap(part, 10.0) for part in rows])
    part = rows[int(best)]
    return min(rivals, key=lambda site: _far(site, part))


def _far(site: Site, part: Manifold) -> float:
    """The distance of a site from the box around a part [m]."""
    box = np.array(part.bounding_box())
    return float(np.linalg.norm(np.maximum(np.maximum(box[:3] - site.at, site.at - box[3:]), 0.0)))
