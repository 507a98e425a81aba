"""Projects to open: assets of many hulls, one of very many, and a family of a thousand."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from meshforge.geometry import Floats, Polytope, convex_hull
from meshforge.project import Project

WORDS = ("frame", "shelf", "door", "handle")


def project_of(folder: Path, assets: int, hulls: int) -> Project:
    """A project of labelled assets, each of so many hulls of 30 points."""
    (folder / "assets").mkdir(parents=True)
    for number in range(assets):
        text = _text(np.random.default_rng([7, hulls, number]), hulls)
        (folder / "assets" / f"piece_{number:04}.obj").write_text(text, encoding="utf-8")
    project = Project.create(folder / "project", [folder / "assets" / "*.obj"], vocabulary=WORDS)
    names = [f"part_{k:03}" for k in range(hulls)]
    for asset in project.assets()[: min(assets, 40)]:
        project.set_labels(asset, {name: WORDS[k % len(WORDS)] for k, name in enumerate(names)})
    return project


def _text(random: np.random.Generator, hulls: int) -> str:
    """An OBJ file of convex lumps on a jittered grid, near enough to touch."""
    side = int(np.ceil(hulls ** (1 / 3)))
    lines, first = [], 1
    for k in range(hulls):
        cell = np.array([k % side, k // side % side, k // side**2], float)
        centre = cell * 0.1 + random.uniform(-0.01, 0.01, 3)
        hull = _lump(random, centre)
        lines.append(f"o part_{k:03}")
        lines += [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in hull.vertices]
        lines += [f"f {a} {b} {c}" for a, b, c in hull.faces + first]
        first += len(hull.vertices)
    return "\n".join(lines) + "\n"


def _lump(random: np.random.Generator, centre: Floats) -> Polytope:
    points = random.normal(size=(30, 3))
    points *= 0.05 / np.linalg.norm(points, axis=1, keepdims=True)
    return convex_hull(np.round(points + centre, 6))
