"""Whether the masses and inertias in a file can be those of its bodies."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from meshforge.checks.legality import Finding
from meshforge.common import join_names
from meshforge.geometry import Aabb, inertia
from meshforge.symbolic import Hull, Inertial, SymbolicMesh

LIGHTEST, HEAVIEST = 5.0, 25_000.0
"""Densities [kg/m^3] beyond which a mass is doubted: below any foam, and above osmium."""
OFF = 10.0
"""Inertias that differ by more than this factor from those of the hulls are doubted."""
_ROUNDING = 1e-4  # of inertias that are written with few digits
_OUTSIDE = 0.1  # of the size of the hulls, by which a centre of mass may lie outside of their box

_REMEDIES = {
    "mass": "Correct mass and inertia in the file.",
    "density": "Correct the mass in the file, or apply --mass recompute.",
    "centre": "Correct the inertial origin in the file.",
    "inertia": "Correct the inertia in the file.",
}


@dataclass(frozen=True, slots=True)
class _MassDoubt:
    rule: str
    body: str
    problem: str


def check_masses(mesh: SymbolicMesh) -> Iterator[Finding]:
    """What is odd about the masses in the asset of a mesh: a finding for each rule, with its bodies."""
    doubts = list(_find_doubts(mesh))
    for rule, remedy in _REMEDIES.items():
        problems = [f"body {doubt.body!r}: {doubt.problem}" for doubt in doubts if doubt.rule == rule]
        if problems:
            yield Finding(
                f"physics-{rule}", "error" if rule == "mass" else "warning", (), join_names(problems, 3), remedy
            )


def _find_doubts(mesh: SymbolicMesh) -> Iterator[_MassDoubt]:
    for inertial in mesh.asset.mechanism.inertials if mesh.asset else ():
        hulls = [hull for hull in mesh.hulls if hull.body == inertial.body]
        problem = find_inertial_problem(inertial)
        if problem:
            yield _MassDoubt("mass", inertial.body, problem)
        elif hulls:
            yield from _compare_with_hulls(inertial, hulls)


def find_inertial_problem(inertial: Inertial) -> str | None:
    """Why no solid has such a mass and inertia, None where one may."""
    if not (np.isfinite(inertial.mass) and np.isfinite(inertial.inertia).all() and np.isfinite(inertial.centre).all()):
        return "mass or inertia is not a finite number"
    if inertial.mass <= 0:
        return f"its mass is {inertial.mass:g} kg"
    low, middle, high = np.linalg.eigvalsh((inertial.inertia + inertial.inertia.T) / 2).tolist()
    if low <= 0:
        return f"its inertia has a principal moment of {low:.3g} kg m²"
    if low + middle < high * (1 - _ROUNDING):
        return f"its principal moments of inertia break the triangle rule: {low:.3g} + {middle:.3g} < {high:.3g} kg m²"
    return None


def _compare_with_hulls(inertial: Inertial, hulls: list[Hull]) -> Iterator[_MassDoubt]:
    shapes = [hull.shape for hull in hulls]
    volume = sum(shape.volume for shape in shapes)
    density = inertial.mass / volume
    if not LIGHTEST <= density <= HEAVIEST:
        problem = f"{inertial.mass:.3g} kg on hulls of {1000 * volume:.3g} l are {density:.3g} kg/m³"
        yield _MassDoubt("density", inertial.body, problem)
    box = Aabb.union(shape.aabb for shape in shapes)
    beyond = float(np.maximum(box.min - inertial.centre, inertial.centre - box.max).max())
    if beyond > _OUTSIDE * box.diagonal:
        problem = f"its centre of mass lies {beyond:.3g} m outside of the box of its hulls"
        yield _MassDoubt("centre", inertial.body, problem)
    _, solid = inertia(shapes, inertial.mass)
    ratio = np.linalg.eigvalsh(inertial.inertia) / np.linalg.eigvalsh(solid)
    worst = float(ratio[np.abs(np.log(ratio)).argmax()])
    if not 1 / OFF <= worst <= OFF:
        problem = f"its inertia is {worst:.3g} times that of its hulls at that mass"
        yield _MassDoubt("inertia", inertial.body, problem)
