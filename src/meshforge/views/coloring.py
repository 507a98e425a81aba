"""Which hull gets which colour, and what the legend says about it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from meshforge.geometry import Floats
from meshforge.symbolic import Hull, SymbolicMesh
from meshforge.views.palette import (
    PALE,
    SELECTED,
    UNLABELLED,
    apart,
    candidates,
    confidence_color,
    label_color,
    perceived,
    rgb,
)

ColorBy = Literal["hull", "label", "body", "confidence"]
COLOR_BY: tuple[ColorBy, ...] = get_args(ColorBy)
UNSURE = 0.5
"""Labels less certain than this are hatched."""
_NEIGHBOUR = 2.0  # a hull in contact counts as this much nearer in colour: it must differ clearly
_WORTH = 0.9  # a colour already used is this much less wanted for each use
_DIMMER = 0.86  # and this much darker each time


@dataclass(frozen=True, slots=True)
class Entry:
    """One part of a legend: a colour, or "", what has it, and how many hulls that is."""

    color: str
    name: str
    count: int | None = None


@dataclass(frozen=True, eq=False, slots=True)
class Coloring:
    """A colour for each hull (n, 3), sRGB in 0..1, and the legend.

    gradient: the legend begins with the scale of confidence; hatched: hulls whose label is not sure.
    """

    colors: Floats
    legend: tuple[Entry, ...] = ()
    gradient: bool = False
    hatched: frozenset[int] = frozenset()


def color_hulls(
    mesh: SymbolicMesh,
    color_by: ColorBy,
    vocabulary: Sequence[str] = (),
    known: Mapping[str, Floats] | None = None,
) -> Coloring:
    """The colours of a mesh's hulls.

    vocabulary: the order in which labels get colours; labels outside it come after it, in order of the alphabet.
    known: colours of hulls, by name, that stay as they are when colouring by hull.
    """
    match color_by:
        case "hull":
            settled = {mesh.index[name]: color for name, color in (known or {}).items() if name in mesh.index}
            return Coloring(colors_apart(mesh, range(len(mesh.hulls)), settled))
        case "label":
            found = {h.label for h in mesh.hulls if h.label} - set(vocabulary)
            coloring = _grouped(mesh, [*vocabulary, *sorted(found)], lambda hull: hull.label)
            unsure = [k for k, h in enumerate(mesh.hulls) if h.confidence is not None and h.confidence < UNSURE]
            note = (Entry("", "hatched: unsure", len(unsure)),) if unsure else ()
            return replace(coloring, legend=coloring.legend + note, hatched=frozenset(unsure))
        case "body":
            return _grouped(mesh, list(dict.fromkeys(h.body for h in mesh.hulls)), lambda hull: hull.body)
        case "confidence":
            return _confident(mesh)


def label_colors(labels: Iterable[str]) -> dict[str, str]:
    """The colour `#rrggbb` of each label of a vocabulary."""
    return {label: label_color(k) for k, label in enumerate(dict.fromkeys(labels))}


def highlighted(mesh: SymbolicMesh, names: frozenset[str]) -> Coloring:
    """Hulls of these names in a strong colour, all others pale."""
    picked = [h.name in names for h in mesh.hulls]
    colors = np.array([rgb(SELECTED if p else PALE) for p in picked]).reshape(-1, 3)
    rest = Entry(PALE, "others", picked.count(False))
    return Coloring(colors, (Entry(SELECTED, "selected", picked.count(True)), rest))


def _grouped(mesh: SymbolicMesh, groups: Sequence[str], group_of: Callable[[Hull], str | None]) -> Coloring:
    color_of: dict[str | None, str] = {None: UNLABELLED}
    color_of.update(label_colors(groups))
    groups_here = [group_of(h) for h in mesh.hulls]
    legend = [Entry(color_of[g], g, groups_here.count(g)) for g in groups if g in groups_here]
    if None in groups_here:
        legend.append(Entry(UNLABELLED, "no label", groups_here.count(None)))
    return Coloring(np.array([rgb(color_of[g]) for g in groups_here]).reshape(-1, 3), tuple(legend))


def _confident(mesh: SymbolicMesh) -> Coloring:
    colors = [rgb(UNLABELLED) if h.confidence is None else confidence_color(h.confidence) for h in mesh.hulls]
    without = sum(h.confidence is None for h in mesh.hulls)
    legend = (Entry(UNLABELLED, "no label", without),) if without else ()
    return Coloring(np.array(colors).reshape(-1, 3), legend, gradient=True)


def colors_apart(mesh: SymbolicMesh, picked: Iterable[int], known: Mapping[int, Floats] | None = None) -> Floats:
    """Colours (k, 3) of the picked hulls, far from each other, those of hulls in contact farthest; greedy, in order.

    known: colours of hulls, by index, that are settled.
    """
    pool, seen = candidates()
    gap_to: dict[int, Floats] = {}
    uses = np.zeros(len(pool))
    nearest = np.full(len(pool), 0.5)
    settled = dict(known or {})
    order = list(picked)
    for k in sorted(order, key=lambda k: k not in settled):
        if k not in settled:
            near = np.array([gap_to[j] for j in sorted(mesh.neighbours(k) & gap_to.keys())])
            wanted = np.minimum(near.min(axis=0, initial=0.5) / _NEIGHBOUR, 0.06) if len(near) else 0.06
            pick = int(np.argmax((wanted + nearest) * _WORTH**uses))
            settled[k] = pool[pick] * _DIMMER ** uses[pick]
            uses[pick] += 1
        gap_to[k] = apart(seen, perceived(settled[k][None]))
        nearest = np.minimum(nearest, gap_to[k])
    return np.array([settled[k] for k in order]).reshape(-1, 3)
