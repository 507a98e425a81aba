"""Supports: boxes and balls put onto a surface stay there."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from benchmark.assets.asset import Site
from benchmark.criteria.case import Case
from benchmark.criteria.contact import advance, calm, collide, deepest, mm
from benchmark.criteria.scene import add_hulls, add_object, axes_of, blank, place, step_for, tolerance
from meshforge.geometry import Box, Floats, Pose, Shape, Sphere

_SECONDS, _LOOK, _SOONEST = 1.5, 0.05, 0.24  # [s]
_SPOTS = ((0.0, 0.0), (0.6, 0.6), (-0.6, 0.6), (-0.6, -0.6), (0.6, -0.6))
_UNEVEN = 0.2  # of the radius: objects are let down from so high, and may lie so far from the surface's height


def failure(case: Case, site: str) -> str | None:
    """Why the surface of some site of that name does not support: which object lies where it should not."""
    sites = case.asset.site(site)
    if not sites:
        return None
    if not case.mesh.hulls:
        return f"{site}: no hull is left"
    spec = blank(step_for(min(where.size[2] for where in sites)))
    add_hulls(spec, spec.worldbody, case.mesh.hulls)
    objects = [row for k, where in enumerate(sites, 1) for row in _objects(f"{site} {k}", where)]
    for name, shape, _, _ in objects:
        add_object(spec, name, shape)
    model = spec.compile()
    data = mujoco.MjData(model)
    touching = tolerance(case.asset)
    for name, shape, spot, where in objects:
        up = float(shape.aabb.max[2]) + touching + _UNEVEN * where.size[2]
        place(model, data, name, spot + np.array([0.0, 0.0, up]), axes_of(where))
    collide(model, data)
    touch = deepest(model, data, touching)
    if touch:
        return f"{touch.mover}: {touch.other} is {mm(touch.depth)} in it from the start"
    return _stay(model, data, objects, touching)


Put = tuple[str, Shape, Floats, Site]


def _objects(name: str, site: Site) -> list[Put]:
    """Name, shape, spot on the surface of each object, and its site."""
    long, wide, radius = site.size
    axes = axes_of(site)
    rows: list[Put] = []
    for k, (x, y) in enumerate(_SPOTS, 1):
        spot = np.asarray(site.at) + axes @ np.array([x * long, y * wide, 0.0])
        rows.append((f"{name}, box {k}", Box(Pose.identity(), np.full(3, 1.5 * radius)), spot, site))
        rows.append((f"{name}, ball {k}", Sphere(Pose.identity(), radius), spot, site))
    return rows


def _stay(model: Any, data: Any, objects: list[Put], touching: float) -> str | None:
    """Simulate until all is at rest, something is lost, or time is up; then look where everything lies."""
    while data.time < _SECONDS:
        if not advance(model, data, _LOOK):
            return "the simulation breaks down"
        for name, _, spot, where in objects:
            way = float(np.linalg.norm((data.body(name).xpos - spot)[:2]))
            if way > where.size[2]:
                return f"{name} goes away by {mm(way)} within {data.time:.2f} s, its radius {mm(where.size[2])}"
        if data.time > _SOONEST and calm(data):
            break
    for name, shape, spot, where in objects:
        high = float(data.body(name).xpos[2] - spot[2] - shape.aabb.max[2])
        if abs(high) > touching + _UNEVEN * where.size[2]:
            return f"{name} lies {mm(abs(high))} {'above' if high > 0 else 'below'} the surface"
    return None
