"""Contact graphs of real meshes: MeshForge against trimesh, PyBullet and bare calls of the library below."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from contextlib import closing
from functools import partial
from statistics import median
from typing import Any

import numpy as np

from benchmark.clock import Run, in_turns, medians
from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.speed.assets import multi_hull
from benchmark.speed.rivals import Bullet, Coal, Fcl, Pairs, Trimesh
from meshforge.geometry import Polytope, distance
from meshforge.symbolic import Hull, SymbolicMesh

OURS = "MeshForge"
_RIVALS = (Trimesh, Bullet, Fcl, Coal)
_ROUNDS, _SECONDS, _REPEATS = 7, 6.0, 3  # a mesh


def measure(tell: Tell, quick: bool) -> Result:
    """Time all contestants on all meshes, and hold their answers against each other."""
    found = multi_hull(tell, 2, bundled_only=True) if quick else multi_hull(tell)
    rows = []
    for k, (name, mesh) in enumerate(found.items()):
        rows.append(one_mesh(name, mesh, 1 if quick else _ROUNDS))
        tell(f"contact graphs: {k + 1} of {len(found)}")
    return _result(rows)


def one_mesh(name: str, mesh: SymbolicMesh, rounds: int) -> dict[str, Any]:
    """Median seconds of building and asking of each contestant on one mesh, and where the answers differ."""
    shapes = [hull.shape.tessellate() for hull in mesh.hulls]
    known = _of(shapes)
    near, pairs = known.contact_distance, near_pairs(shapes, known.contact_distance)
    rivals = [kind(shapes, near, pairs) for kind in _RIVALS]
    turns: dict[str, Run] = {OURS: lambda: _make_query(_of(_anew(shapes)))}
    with closing(next(r for r in rivals if isinstance(r, Bullet))):
        answers = {rival.name: rival.query(rival.build()) for rival in rivals}
        for rival in rivals:
            turns[f"{rival.name}: build"] = partial(_building, rival)
            turns[f"{rival.name}: ask"] = partial(_make_rival_query, rival)
        seconds = medians(in_turns(turns, rounds, _SECONDS, _REPEATS))
    return {
        "asset": name,
        "hulls": len(shapes),
        "corners": sum(len(shape.vertices) for shape in shapes),
        "near": len(pairs),
        "contacts": len(known.contacts),
        "seconds": seconds,
        "differ": {who: _differences(shapes, known, answer) for who, answer in answers.items()},
    }


def near_pairs(shapes: list[Polytope], near: float) -> list[tuple[int, int]]:
    """Pairs (i, j), i < j, whose boxes are no farther apart than `near`."""
    low, high = np.array([s.aabb.min for s in shapes]), np.array([s.aabb.max for s in shapes])
    gaps = np.maximum(low[:, None] - high, low - high[:, None]).clip(0)
    i, j = np.nonzero(np.triu(np.linalg.norm(gaps, axis=2) <= near, 1))
    return list(zip(i.tolist(), j.tolist(), strict=True))


def _of(shapes: Iterable[Polytope]) -> SymbolicMesh:
    return SymbolicMesh(tuple(Hull(str(k), "body", shape) for k, shape in enumerate(shapes)))


def _anew(shapes: list[Polytope]) -> list[Polytope]:
    """The shapes as other objects, of which nothing is remembered."""
    return [Polytope(shape.vertices, shape.faces) for shape in shapes]


def _make_query(mesh: SymbolicMesh) -> Callable[[], object]:
    return lambda: mesh.contacts


def _building(rival: Any) -> Callable[[], object]:
    if isinstance(rival, Bullet):
        rival.reset()
    return lambda: _keep(rival, rival.build())


def _keep(rival: Any, built: Any) -> None:
    rival.built = built


def _make_rival_query(rival: Any) -> Callable[[], object]:
    return lambda: rival.query(rival.built)


def _differences(shapes: list[Polytope], ours: SymbolicMesh, theirs: Pairs) -> list[dict[str, Any]]:
    """The pairs in one answer only, with their distance in thresholds."""
    return [
        {
            "pair": list(pair),
            "theirs": pair in theirs,
            "thresholds": round(distance(shapes[pair[0]], shapes[pair[1]]) / ours.contact_distance, 9),
        }
        for pair in sorted(ours.contacts ^ theirs)
    ]


def _result(rows: list[dict[str, Any]]) -> Result:
    total = {who: 1e3 * sum(row["seconds"][who] for row in rows) for who in rows[0]["seconds"]}
    lines: list[tuple[Cell, ...]] = [(OURS, "", "", total[OURS], 1.0, 1.0)]
    for kind in _RIVALS:
        steps = [f"{kind.name}: build", f"{kind.name}: ask"]
        build, ask = (total[step] for step in steps)
        lines.append((kind.name, build, ask, build + ask, *_ratios(rows, steps)))
    differ = [(kind.name, sum(len(row["differ"][kind.name]) for row in rows)) for kind in _RIVALS]
    columns = ("", "build, ms", "ask, ms", "in all, ms", "times MeshForge", "median of meshes")
    edges = sum(row["contacts"] for row in rows)
    return Result(
        "contact",
        f"Contact graphs of {len(rows)} meshes",
        (
            Table("From vertices and faces to the pairs in contact", columns, tuple(lines)),
            Table("Pairs in one answer only", ("against", f"of {edges} pairs"), tuple(differ)),
            Table("The meshes", ("hulls, up to", "meshes"), _sizes(rows)),
        ),
        _goals(rows),
        (
            "Hulls are polytopes (primitives are tessellated for all alike), threshold 0.002 of the diagonal.",
            "MeshForge also measures pairs up to three thresholds apart, to show near misses; the others do not.",
            "trimesh and PyBullet find the pairs whose boxes are near; python-fcl and bare coal are given them.",
            f"Medians of {_ROUNDS} rounds; in a round, each runs {_REPEATS} times in a row, the quickest counting.",
            "Bare coal is called with the request that MeshForge uses.",
        ),
        tuple(rows),
    )


def _ratios(rows: list[dict[str, Any]], steps: list[str]) -> tuple[float, float]:
    """How many times our time some steps take, in all and in the median of the meshes."""
    theirs = [sum(row["seconds"][step] for step in steps) for row in rows]
    ours = [row["seconds"][OURS] for row in rows]
    return sum(theirs) / sum(ours), median(t / o for t, o in zip(theirs, ours, strict=True))


def _goals(rows: list[dict[str, Any]]) -> tuple[Goal, ...]:
    def against(kind: Any, *steps: str) -> float:
        return _ratios(rows, [f"{kind.name}: {step}" for step in steps])[0]

    whole = ("build", "ask")
    return (
        Goal("times as fast as trimesh's collision manager", "at least", 10.0, against(Trimesh, *whole)),
        Goal("times as fast as PyBullet's closest points", "at least", 10.0, against(Bullet, *whole)),
        Goal("times bare coal's time, its shapes made from the arrays", "at most", 2.0, 1 / against(Coal, *whole)),
        Goal("times bare coal's time, its shapes made beforehand", "at most", 2.0, 1 / against(Coal, "ask")),
    )


def _sizes(rows: list[dict[str, Any]]) -> tuple[tuple[int, int], ...]:
    steps = (4, 8, 16, 32, 64, 128)
    return tuple(
        (top, sum(low < row["hulls"] <= top for row in rows)) for low, top in zip((0, *steps), steps, strict=False)
    )
