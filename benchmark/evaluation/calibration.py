"""Whether the three thresholds are right on meshes that nothing else is measured on: epsilon, delta and eta."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from manifold3d import Manifold

from benchmark.assets import CATEGORIES, Sample, samples
from benchmark.assets.pictures import upright
from benchmark.evaluation.sessions import QUICK
from benchmark.journal import run_units
from benchmark.report import Result, Table, Tell
from benchmark.study.labels import count_wrong, noisy
from benchmark.tasks import task
from meshforge.common import MeshForgeError
from meshforge.geometry import distance
from meshforge.language import Direction, Geo, Is, select, to_canonical_frame
from meshforge.symbolic import SymbolicMesh

UPRIGHT: tuple[Direction, ...] = ("+Z", "-Z")
EPSILONS = (0.0005, 0.001, 0.002, 0.004, 0.008)
DELTAS = (0.01, 0.02, 0.05, 0.1, 0.2)
_FACE = 0.01  # of a label's extent: what lies in this outermost slice is at the boundary
_JOINT = 0.001  # m: parts that the generators join are no farther apart
_COVERED = 0.02  # of a hull's volume: less of a part than this is not held by it


def measure(tell: Tell, quick: bool) -> Result:
    """Judge the calibration set."""
    names = (QUICK,) if quick else CATEGORIES
    rows = [
        row for rows in run_units("calibration", judge_thresholds, [(name,) for name in names], tell) for row in rows
    ]
    errors = [row["wrong"] for row in rows]
    few = [row["wrong"] for row in rows if row["hulls"] <= 12]
    touching = tuple((x, _right(rows, f"epsilon {x}")) for x in EPSILONS)
    outermost = tuple((x, _right(rows, f"delta {x}")) for x in DELTAS)
    return Result(
        "calibration",
        "The thresholds, on the calibration set",
        (
            Table("Contact: pairs of parts classified correctly", ("epsilon", "right, %"), touching),
            Table(
                "Extremity: hulls of a label classified as boundary or not, correctly", ("delta", "right, %"), outermost
            ),
            Table(
                "Wrong labels of a mesh, noisy labeller",
                ("meshes", "mean", "95th percentile", "of meshes with up to 12 hulls", "accuracy, %"),
                (
                    (
                        len(rows),
                        float(np.mean(errors)),
                        float(np.percentile(errors, 95)),
                        _most(few),
                        100 - 100 * sum(errors) / sum(row["hulls"] for row in rows),
                    ),
                ),
            ),
        ),
        (),
        (
            f"{len(rows)} meshes of other seeds than the 600. Two parts touch if their solids are within 1 mm, as "
            "the generators join parts; they are classified as touching if hulls of both are within epsilon, leaving "
            "out hulls that belong to several parts. A hull is at the upper or lower boundary of its label if it "
            "contains some of the outermost hundredth of that label's parts, upright; it is classified on the mesh as "
            "landmarks orient it, which is slightly tilted. The paper, by annotators: 100% for epsilon = 0.002, 96% "
            "for delta = 0.05.",
            "At most two labels of a mesh of up to twelve hulls are wrong since the simulated labeller draws no more, "
            "after the paper; so the percentile of these has no goal.",
        ),
    )


def _most(errors: Sequence[int]) -> float:
    """The 95th percentile, 0 of nothing."""
    return float(np.percentile(errors, 95)) if errors else 0.0


def judge_thresholds(category: str) -> list[dict[str, Any]]:
    """Counts of each mesh of a category."""
    rows = []
    for place, sample in enumerate(samples(category, True)):
        labelled = noisy(sample.mesh, (1, *category.encode(), place), telling=False)
        counts: Counter[str] = Counter()
        _contacts(sample, counts)
        _boundary(sample, _orient(sample), counts)
        rows.append({"mesh": sample.name, "hulls": len(sample.mesh.hulls), "wrong": count_wrong(sample.mesh, labelled),
                     **counts})  # fmt: skip
    return rows


def _right(rows: Sequence[dict[str, Any]], key: str) -> float:
    tried: int = sum(row.get(f"{key} of", 0) for row in rows)
    right: int = sum(row.get(key, 0) for row in rows)
    return 100 * right / max(tried, 1)


def _holders(sample: Sample, mesh: SymbolicMesh) -> list[list[int]]:
    """For each part the hulls that hold nothing but it."""
    found: list[list[int]] = [[] for _ in sample.asset.parts]
    for k, hull in enumerate(mesh.hulls):
        solid = Manifold.hull_points(hull.vertices)
        shares = [float((solid ^ part.solid).volume()) for part in sample.asset.parts]
        own = [place for place, share in enumerate(shares) if share > _COVERED * hull.volume]
        if len(own) == 1:
            found[own[0]].append(k)
    return found


def _contacts(sample: Sample, counts: Counter[str]) -> None:
    mesh = upright(sample)
    holders, parts, length = _holders(sample, mesh), sample.asset.parts, mesh.diagonal
    for i in range(len(parts)):
        for j in range(i):
            if not holders[i] or not holders[j]:
                continue
            near = float(parts[i].solid.min_gap(parts[j].solid, 0.05 * length))
            gaps = (distance(mesh.hulls[a].shape, mesh.hulls[b].shape) for a in holders[i] for b in holders[j])
            gap = min(gaps)
            for x in EPSILONS:
                counts[f"epsilon {x}"] += (gap <= x * length) == (near <= _JOINT)
                counts[f"epsilon {x} of"] += 1


def _orient(sample: Sample) -> SymbolicMesh | None:
    """The mesh as the category's hard task orients it, which may lean a little; None where it cannot be oriented."""
    try:
        orient = task(f"{sample.asset.category}-hard").program.orient
        return to_canonical_frame(sample.mesh, orient, None)[0]
    except MeshForgeError:
        return None


def _boundary(sample: Sample, met: SymbolicMesh | None, counts: Counter[str]) -> None:
    mesh = upright(sample)
    for label in sorted({hull.label for hull in mesh.hulls if hull.label}) if met else ():
        solids = [part.solid for part in sample.asset.parts if part.label == label]
        own = [k for k, hull in enumerate(mesh.hulls) if hull.label == label]
        for direction in UPRIGHT if met and solids else ():
            known = set(_outermost(mesh, label, solids, direction))
            for x in DELTAS:
                told = select(Geo(Is(label), direction), met, x) if met else ()
                counts[f"delta {x}"] += sum((k in told) == (k in known) for k in own)
                counts[f"delta {x} of"] += len(own)


def _outermost(mesh: SymbolicMesh, label: str, solids: Sequence[Manifold], direction: Direction) -> Iterator[int]:
    """The hulls of a label that hold something of its parts' outermost slice."""
    axis, sign = "XYZ".index(direction[1]), 1.0 if direction[0] == "+" else -1.0
    boxes = np.array([solid.bounding_box() for solid in solids])
    low, high = boxes[:, axis].min(), boxes[:, axis + 3].max()
    face = high - _FACE * (high - low) if sign > 0 else -(low + _FACE * (high - low))
    normal = tuple(sign * np.eye(3)[axis])
    slices = [solid.trim_by_plane(normal, float(face)) for solid in solids]
    for k, hull in enumerate(mesh.hulls):
        if hull.label == label:
            solid = Manifold.hull_points(hull.vertices)
            if any(float((solid ^ part).volume()) > 0 for part in slices):
                yield k
