"""Simulated labellers: noisy ones, right for 92 of 100 hulls, and one with systematic errors; no model is like them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping

import numpy as np

from benchmark.learning.repairs import Noise, spoilt
from meshforge.symbolic import Label, SymbolicMesh

ACCURACY = 0.92
FEW, MOST = 12, 2
"""A mesh of so few hulls has so many wrong labels at most (paper: the 95th percentile of a mesh)."""
AFFECTED = 1 / 3
"""The share of assets in which a kind of part is called by a wrong name."""
_TOGETHER = 0.5  # chance that the next wrong hull touches the one before


def noisy(mesh: SymbolicMesh, seed: Iterable[int], *, telling: bool) -> SymbolicMesh:
    """The mesh with the labels of a noisy labeller: wrong ones come together, and name touching or like parts.

    telling: wrong labels are less confident than right ones on average (0.67 and 0.9); else one distribution for both.
    """
    rng = np.random.default_rng(list(seed))
    count = int(rng.binomial(len(mesh.hulls), 1 - ACCURACY))
    if len(mesh.hulls) <= FEW:
        count = min(count, MOST)
    return spoilt(mesh, count, Noise(count, telling=telling), rng, _order_by_contact(mesh, rng))


def mislabel(meshes: Mapping[str, SymbolicMesh], seed: Iterable[int]) -> dict[str, SymbolicMesh]:
    """Meshes by asset in which one kind of part is called by the name of a kind that it touches, in a third of those
    that have it; all else is right. Confidence tells nothing.

    The kind is drawn from those that at least a third of the assets have.
    """
    rng = np.random.default_rng(list(seed))
    having = {
        label: [name for name, mesh in meshes.items() if any(hull.label == label for hull in mesh.hulls)]
        for label in sorted({str(hull.label) for mesh in meshes.values() for hull in mesh.hulls})
    }
    common = [label for label, names in having.items() if len(names) >= AFFECTED * len(meshes)]
    kind = common[int(rng.integers(len(common)))]
    other = _draw_confused_with(kind, meshes, rng)
    count = max(round(AFFECTED * len(having[kind])), 1)
    affected = set(rng.permutation(having[kind])[:count].tolist())
    found = {}
    for name, mesh in meshes.items():
        wrong = {kind: other} if name in affected else {}
        found[name] = mesh.with_labels(
            {h.name: Label(wrong.get(str(h.label), str(h.label)), _draw_confidence(rng), "vlm") for h in mesh.hulls}
        )
    return found


def count_wrong(true: SymbolicMesh, labelled: SymbolicMesh) -> int:
    """How many labels differ."""
    return sum(a.label != b.label for a, b in zip(true.hulls, labelled.hulls, strict=True))


def _draw_confidence(rng: np.random.Generator) -> float:
    return float(rng.beta(18, 2))


def _draw_confused_with(kind: str, meshes: Mapping[str, SymbolicMesh], rng: np.random.Generator) -> str:
    """Another label, the more likely the more often its hulls touch those of the kind; any, where none does."""
    touching: Counter[str] = Counter()
    for mesh in meshes.values():
        for k, hull in enumerate(mesh.hulls):
            if hull.label == kind:
                touching.update(str(mesh.hulls[i].label) for i in mesh.neighbours(k))
    labels = sorted({str(hull.label) for mesh in meshes.values() for hull in mesh.hulls} - {kind})
    weights = np.array([touching[label] for label in labels], float)
    weights = weights if weights.any() else np.ones(len(labels))
    return labels[int(rng.choice(len(labels), p=weights / weights.sum()))]


def _order_by_contact(mesh: SymbolicMesh, rng: np.random.Generator) -> list[int]:
    """All hulls in an order in which the next one often touches the one before."""
    left, order = rng.permutation(len(mesh.hulls)).tolist(), list[int]()
    while left:
        near = [k for k in left if order and k in mesh.neighbours(order[-1])]
        chosen = near[0] if near and rng.random() < _TOGETHER else left[0]
        left.remove(chosen)
        order.append(chosen)
    return order
