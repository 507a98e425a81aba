"""What the batch says about readings: how many hulls each selects there, and how like the demonstrated ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.spatial import cKDTree

from meshforge.geometry import Floats
from meshforge.language import Attach, Diff, Geo
from meshforge.symbolic import bits, descriptors
from meshforge.synthesis.search.field import Field
from meshforge.synthesis.search.term import Joined, Term

STRANGE_LABEL = 3.0
"""A hull whose label no demonstrated hull has counts as at least so far from them, in standard deviations."""


@dataclass(frozen=True, slots=True)
class Evidence:
    """Of one reading: the share of the assets where it selects nothing; and how far the hulls that it selects on the
    others are from the nearest demonstrated one, squared, in standard deviations of the descriptors.
    """

    idle: float
    strange: float


NO_EVIDENCE = Evidence(0.0, 0.0)


def evidence(field: Field, selections: Sequence[int], readings: Sequence[int]) -> tuple[Evidence, ...]:
    """The evidence on some readings, given as groups of the field.

    selections: the hulls that were shown on each of the field's first meshes, as bit sets; the batch is the rest.
    """
    shown, rest = len(selections), len(field.meshes) - len(selections)
    counts = np.array([len(mesh.hulls) for mesh in field.meshes[shown:]], dtype=np.int64)
    if not rest or not counts.sum() or not any(selections):
        return tuple(NO_EVIDENCE for _ in readings)
    places = np.array([group for groups in field.groups[shown:] for group in groups], dtype=np.int64)
    ends = np.concatenate([[0], np.cumsum(counts)])
    chosen = _unpacked(readings, field.width)[:, places]
    many = _summed(chosen.astype(float), ends)
    strange = _summed(chosen * _strangeness(field, selections), ends)
    active = many > 0
    meshes = np.maximum(active.sum(axis=1), 1)
    odd = np.where(active, strange / np.maximum(many, 1), 0.0).sum(axis=1) / meshes
    idle = 1 - active.mean(axis=1)
    rows = zip(idle.tolist(), odd.tolist(), strict=True)
    return tuple(Evidence(*row) for row in rows)


def _strangeness(field: Field, selections: Sequence[int]) -> Floats:
    """How far each hull of the batch is from the nearest demonstrated one, squared."""
    rows = descriptors(field.meshes)
    rows = rows / np.maximum(rows.std(axis=0), 1e-9)
    starts = np.concatenate([[0], np.cumsum([len(mesh.hulls) for mesh in field.meshes])]).astype(int)
    hulls = [hull for mesh in field.meshes for hull in mesh.hulls]
    first = int(starts[len(selections)])
    shown = [int(start) + hull for start, mask in zip(starts, selections, strict=False) for hull in sorted(bits(mask))]
    far = cKDTree(rows[shown]).query(rows[first:])[0]
    known = {hulls[place].label for place in shown}
    foreign = np.array([hull.label not in known for hull in hulls[first:]])
    squared: Floats = np.where(foreign, np.maximum(far, STRANGE_LABEL), far) ** 2
    return squared


def _unpacked(readings: Sequence[int], width: int) -> npt.NDArray[np.bool_]:
    """Whether each reading has each group: (readings, width)."""
    size = (width + 7) // 8
    packed = np.frombuffer(b"".join(row.to_bytes(size, "little") for row in readings), np.uint8)
    table = np.unpackbits(packed.reshape(len(readings), size), axis=1, count=width, bitorder="little")
    return table.astype(np.bool_)


def _summed(values: Floats, ends: npt.NDArray[np.int64]) -> Floats:
    """The sums of the columns of each mesh; ends: where the meshes begin, and the end of the last."""
    total = np.concatenate([np.zeros((len(values), 1)), np.cumsum(values, axis=1)], axis=1)
    summed: Floats = total[:, ends[1:]] - total[:, ends[:-1]]
    return summed


def untried(term: Term, shown: int) -> int:
    """How many set operators in a term could lose an operand without a difference on the demonstrated meshes.

    shown: the groups of demonstrated hulls.
    """
    made = term.form
    if not isinstance(made, Joined):
        return 0
    left, right = made.left.bits & shown, made.right.bits & shown
    idle = not left & right if made.operator is Diff else not left & ~right or not right & ~left
    return idle + untried(made.left, shown) + untried(made.right, shown)


def unneeded(term: Term, shown: int, field: Field) -> int:
    """How many `Attach` and `Geo` in a term leave nothing out of their label on the demonstrated meshes.

    shown: the groups of demonstrated hulls.
    """
    made = term.form
    match made:
        case Joined():
            return unneeded(made.left, shown, field) + unneeded(made.right, shown, field)
        case Attach(base, _) | Geo(base, _):
            return int(field.bits(base) & shown == term.bits & shown)
        case _:
            return 0
