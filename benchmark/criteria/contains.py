"""Contains: an object is put into a cavity, is free there, and stays."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from benchmark.assets.asset import Site
from benchmark.criteria.case import Case
from benchmark.criteria.contact import advance, calm, collide, deepest, mm
from benchmark.criteria.scene import add_hulls, add_object, axes_of, blank, place, step_for, tolerance
from meshforge.geometry import Box, Cylinder, Pose, Shape, Sphere

SHAPES = ("box", "sphere", "cylinder")
_SECONDS, _LOOK, _SOONEST = 1.0, 0.05, 0.24  # [s]


def failure(case: Case, site: str, shape: str = "box") -> str | None:
    """Why the object does not stay at some site of that name: what it is in at first, or how far it moves."""
    assert shape in SHAPES, shape
    sites = case.asset.site(site)
    if not sites:
        return None
    if not case.mesh.hulls:
        return f"{site}: no hull is left"
    spec = blank(step_for(min(min(where.size) for where in sites)))
    add_hulls(spec, spec.worldbody, case.mesh.hulls)
    put = {f"{site} {k}": where for k, where in enumerate(sites, 1)}
    for name, where in put.items():
        add_object(spec, name, _object(where, shape))
    model = spec.compile()
    data = mujoco.MjData(model)
    for name, where in put.items():
        place(model, data, name, np.asarray(where.at), axes_of(where))
    collide(model, data)
    touch = deepest(model, data, tolerance(case.asset))
    if touch:
        return f"{touch.mover}: {touch.other} is {mm(touch.depth)} in the object from the start"
    return _stays(model, data, put)


def _object(site: Site, shape: str) -> Shape:
    x, y, z = site.size
    if shape == "box":
        return Box(Pose.identity(), np.array(site.size))
    return Sphere(Pose.identity(), min(x, y, z)) if shape == "sphere" else Cylinder(Pose.identity(), min(x, y), z)


def _stays(model: Any, data: Any, put: dict[str, Site]) -> str | None:
    """Simulate until all is at rest, something leaves, or time is up."""
    while data.time < _SECONDS:
        if not advance(model, data, _LOOK):
            return "the simulation breaks down"
        for name, where in put.items():
            way, half = float(np.linalg.norm(data.body(name).xpos - where.at)), min(where.size)
            if way >= half:
                return f"{name}: the object, {mm(half)} in half, moves by {mm(way)} within {data.time:.2f} s"
        if data.time > _SOONEST and calm(data):
            break
    return None
