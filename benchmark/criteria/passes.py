"""Passes: a probe goes along a straight way through an opening and touches nothing."""

from __future__ import annotations

import mujoco
import numpy as np

from benchmark.assets.asset import Site
from benchmark.criteria.case import Case
from benchmark.criteria.contact import collide, deepest, mm
from benchmark.criteria.scene import add_hulls, add_object, axes_of, blank, place, tolerance
from meshforge.geometry import Box, Capsule, Pose, Shape

SHAPES = ("box", "sphere")


def failure(case: Case, site: str, shape: str = "box") -> str | None:
    """Why the probe does not pass at some site of that name: which hull is in the way, and how deep.

    All that the probe sweeps from `at` to the end is one convex body, tried at once: a box, or a capsule.
    """
    assert shape in SHAPES, shape
    sites = case.asset.site(site)
    if not sites or not case.mesh.hulls:
        return None
    spec = blank()
    add_hulls(spec, spec.worldbody, case.mesh.hulls)
    ways = [f"{site} {k}" for k in range(1, len(sites) + 1)]
    for way, where in zip(ways, sites, strict=True):
        add_object(spec, way, _swept(where, shape))
    model = spec.compile()
    data = mujoco.MjData(model)
    for way, where in zip(ways, sites, strict=True):
        axes = axes_of(where)
        place(model, data, way, np.asarray(where.at) + axes[:, 0] * where.size[0] / 2, axes)
    collide(model, data)
    touch = deepest(model, data, tolerance(case.asset))
    return f"{touch.mover}: {touch.other} is {mm(touch.depth)} in the way" if touch else None


def _swept(site: Site, shape: str) -> Shape:
    """What the probe sweeps, about the middle of its way, the way along X."""
    length, wide, high = site.size
    if shape == "box":
        return Box(Pose.identity(), np.array([length / 2, wide, high]))
    return Capsule(Pose.from_rpy((0, 0, 0), (0.0, np.pi / 2, 0.0)), wide, length / 2)
