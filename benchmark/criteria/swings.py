"""Swings: a leaf turns through its range and does not touch the rest."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
from manifold3d import Manifold

from benchmark.assets.asset import Site
from benchmark.criteria.case import Case
from benchmark.criteria.contact import collide, deepest, mm
from benchmark.criteria.scene import add_hulls, axes_of, blank, tolerance
from benchmark.criteria.solid import near, solid
from meshforge.geometry import Floats
from meshforge.symbolic import Hull

_ARC = 2.0  # of the tolerance, how far the outermost point goes between two looks
_FINEST, _COARSEST = 0.25, 0.5  # degrees between two looks


def failure(case: Case, site: str) -> str | None:
    """Why what moves at some site of that name does not swing: which hulls meet, at what angle, and how deep.

    Where several sites move hulls of one label, each moves those of its own parts, and the others stand still.
    """
    sites = case.asset.site(site)
    for number, where in enumerate(sites):
        rivals = [other for other in sites if set(other.moving) & set(where.moving)]
        why = _jams(case, where, rivals)
        if why:
            return f"{site} {number + 1}: {why}"
    return None


def _jams(case: Case, site: Site, rivals: Sequence[Site]) -> str | None:
    leaf = [hull for hull in case.mesh.hulls if hull.label in site.moving and _mover(hull, case, rivals) is site]
    moving = {hull.name for hull in leaf}
    rest = [hull for hull in case.mesh.hulls if hull.name not in moving]
    if not leaf:
        return f"no hull {' or '.join(site.moving)} is left"
    least = tolerance(case.asset)
    model = _scene(leaf, rest, site)
    data = mujoco.MjData(model)
    for angle in _angles(leaf, site, least):
        data.qpos[0] = np.radians(angle)
        collide(model, data)
        touch = deepest(model, data, least)
        if touch:
            return f"at {angle:.0f} degrees {touch.mover} is {mm(touch.depth)} in {touch.other}"
    return None


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


def _scene(leaf: list[Hull], rest: list[Hull], site: Site) -> Any:
    spec = blank()
    add_hulls(spec, spec.worldbody, rest)
    body = spec.worldbody.add_body(name="leaf")
    body.add_joint(name="hinge", type=mujoco.mjtJoint.mjJNT_HINGE, pos=site.at, axis=axes_of(site)[:, 0])
    body.explicitinertial, body.mass, body.inertia = True, 1.0, [1.0, 1.0, 1.0]
    add_hulls(spec, body, leaf, object_side=True)
    return spec.compile()


def _angles(leaf: list[Hull], site: Site, least: float) -> Floats:
    """The angles to be looked at [degrees], so close that nothing is missed."""
    begin, end = site.size[:2]
    points = np.concatenate([hull.vertices for hull in leaf]) - site.at
    reach = float(np.linalg.norm(np.cross(points, axes_of(site)[:, 0]), axis=1).max())
    step = float(np.clip(np.degrees(_ARC * least / reach), _FINEST, _COARSEST))
    return np.linspace(begin, end, max(2, int(np.ceil(abs(end - begin) / step)) + 1))
