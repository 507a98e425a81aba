"""Colours that are easy to tell apart, with and without colour blindness, and which hull gets which of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Literal, get_args

import numpy as np

from meshforge.geometry import Floats
from meshforge.symbolic import Hull, SymbolicMesh

LABEL_COLORS = (
    "#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7",
    "#9F003E", "#7D7DF9", "#6D4177", "#86E79C", "#3245B7", "#7DDDFB", "#99BB77", "#457D79", "#C53443",
    "#A975CE", "#4B65D9", "#A840A2", "#F1C955", "#A7DBC8", "#5DA34D", "#DF8CD8", "#7E2491",
)  # fmt: skip
"""Colours of labels, in the order of the vocabulary: Okabe and Ito's, without their black; after these, each the
farthest from those before it, as seen by normal, deuteranopic and protanopic eyes, grey kept free."""
UNLABELLED = "#B4B9C0"
REMOVED, MADE, CHANGED, KEPT = "#D5401A", "#0FA47A", "#8A3FD1", "#C9CED6"
DIFFERENCE_COLORS = {"removed": REMOVED, "made": MADE, "kept": KEPT}
"""Of the hulls in a picture of differences."""
SELECTED, PALE = "#E8760A", "#D9DDE3"
CONFIDENCE = ("#C4472B", "#EFA94A", "#EFE3A0", "#7FB7C9", "#2B6CA3")
"""From no confidence to full: red to blue, light in the middle, which every eye can tell apart."""

# Björn Ottosson, "A perceptual color space for image processing", 2020
_TO_CONES = np.array([
    [0.4122214708, 0.5363325363, 0.0514459929],
    [0.2119034982, 0.6806995451, 0.1073969566],
    [0.0883024619, 0.2817188376, 0.6299787005],
])  # fmt: skip
_TO_LAB = np.array([
    [0.2104542553, 0.7936177850, -0.0040720468],
    [1.9779984951, -2.4285922050, 0.4505937099],
    [0.0259040371, 0.7827717662, -0.8086757660],
])  # fmt: skip
# Machado, Oliveira and Fernandes, "A physiologically-based model for simulation of color vision deficiency", 2009
_DEUTERANOPIA = np.array(
    [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
)
_PROTANOPIA = np.array(
    [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
)

ColorBy = Literal["hull", "label", "body", "confidence"]
COLOR_BY: tuple[ColorBy, ...] = get_args(ColorBy)
UNSURE = 0.5
"""Labels less certain than this are hatched."""
_NEIGHBOUR = 2.0  # a hull in contact counts as this much nearer in colour: it must differ clearly
_WORTH = 0.9  # a colour already used is this much less wanted for each use
_DIMMER = 0.86  # and this much darker each time


def rgb(color: str) -> Floats:
    """Return a colour `#rrggbb` as red, green and blue (3,) in 0..1."""
    return np.array([int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)])


def hexadecimal(color: Floats) -> str:
    """Return red, green and blue (3,) in 0..1 as `#rrggbb`."""
    return "#" + "".join(f"{round(float(c) * 255):02X}" for c in color)


def label_color(index: int) -> str:
    """Return the colour of the label at this place of the vocabulary; after two dozen they come round again."""
    return LABEL_COLORS[index % len(LABEL_COLORS)]


def confidence_color(confidence: float) -> Floats:
    """Return a colour (3,) for a confidence in 0..1."""
    stops = np.array([rgb(c) for c in CONFIDENCE])
    at = np.linspace(0, 1, len(stops))
    return np.array([np.interp(confidence, at, stops[:, k]) for k in range(3)])


def perceive_colors(colors: Floats) -> Floats:
    """Return colours (n, 3) as seen by three kinds of eyes (3, n, 3) in Oklab, where distance is difference."""
    linear = to_linear(colors)
    seen = [np.clip(linear @ eye.T, 0, 1) for eye in (np.eye(3), _DEUTERANOPIA, _PROTANOPIA)]
    return np.array([np.cbrt(s @ _TO_CONES.T) @ _TO_LAB.T for s in seen])


def color_distance(seen: Floats, other: Floats) -> Floats:
    """Return how different perceived colours (3, n, 3) are from one other (3, 1, 3): for most eyes, and for the
    worst."""
    gaps = np.linalg.norm(seen - other, axis=2)
    difference: Floats = 0.5 * gaps[0] + 0.5 * gaps.min(axis=0)
    return difference


@cache
def candidate_colors() -> tuple[Floats, Floats]:
    """Return friendly colours of even strength (n, 3), a blue first, that hulls are given; and how each is
    perceived."""
    lightness, chroma, hue = np.meshgrid([0.68, 0.77, 0.86], [0.07, 0.12], 4.4 + np.arange(30) * (np.pi / 15))
    lab = np.stack([lightness, chroma * np.cos(hue), chroma * np.sin(hue)], axis=-1).reshape(-1, 3)
    linear = (lab @ np.linalg.inv(_TO_LAB).T) ** 3 @ np.linalg.inv(_TO_CONES).T
    angle = hue % (2 * np.pi)
    muddy = ((angle > 0.8) & (angle < 2.3) & (lightness < 0.75)).ravel()  # dark yellows
    linear = linear[((linear >= 0) & (linear <= 1)).all(axis=1) & ~muddy]
    colors = np.where(linear <= 0.0031308, linear * 12.92, 1.055 * linear ** (1 / 2.4) - 0.055)
    return colors, perceive_colors(colors)


def to_linear(colors: Floats) -> Floats:
    """Return colours in sRGB as linear light, both in 0..1."""
    return np.where(colors <= 0.04045, colors / 12.92, ((colors + 0.055) / 1.055) ** 2.4)


@dataclass(frozen=True, slots=True)
class LegendEntry:
    """One part of a legend: a colour, or "", what has it, and how many hulls that is."""

    color: str
    name: str
    count: int | None = None


@dataclass(frozen=True, eq=False, slots=True)
class HullColors:
    """A colour for each hull (n, 3), sRGB in 0..1, and the legend.

    gradient: the legend begins with the scale of confidence; hatched: hulls whose label is not sure.
    """

    colors: Floats
    legend: tuple[LegendEntry, ...] = ()
    gradient: bool = False
    hatched: frozenset[int] = frozenset()


def color_hulls(
    mesh: SymbolicMesh, color_by: ColorBy, vocabulary: Sequence[str] = (), known: Mapping[str, Floats] | None = None
) -> HullColors:
    """Return the colours of a mesh's hulls.

    vocabulary: the order in which labels get colours; labels outside it come after it, in order of the alphabet.
    known: colours of hulls, by name, that stay as they are when colouring by hull.
    """
    match color_by:
        case "hull":
            assigned = {mesh.index[name]: color for name, color in (known or {}).items() if name in mesh.index}
            return HullColors(pick_distinct_colors(mesh, range(len(mesh.hulls)), assigned))
        case "label":
            found = {h.label for h in mesh.hulls if h.label} - set(vocabulary)
            coloring = _color_by_group(mesh, [*vocabulary, *sorted(found)], lambda hull: hull.label)
            unsure = [k for k, h in enumerate(mesh.hulls) if h.confidence is not None and h.confidence < UNSURE]
            note = (LegendEntry("", "hatched: unsure", len(unsure)),) if unsure else ()
            return replace(coloring, legend=coloring.legend + note, hatched=frozenset(unsure))
        case "body":
            return _color_by_group(mesh, list(dict.fromkeys(h.body for h in mesh.hulls)), lambda hull: hull.body)
        case "confidence":
            return _color_by_confidence(mesh)


def label_colors(labels: Iterable[str]) -> dict[str, str]:
    """Return the colour `#rrggbb` of each label of a vocabulary."""
    return {label: label_color(k) for k, label in enumerate(dict.fromkeys(labels))}


def highlight_hulls(mesh: SymbolicMesh, names: frozenset[str]) -> HullColors:
    """Return hulls of these names in a strong colour, all others pale."""
    picked = [h.name in names for h in mesh.hulls]
    colors = np.array([rgb(SELECTED if p else PALE) for p in picked]).reshape(-1, 3)
    rest = LegendEntry(PALE, "others", picked.count(False))
    return HullColors(colors, (LegendEntry(SELECTED, "selected", picked.count(True)), rest))


def _color_by_group(mesh: SymbolicMesh, groups: Sequence[str], group_of: Callable[[Hull], str | None]) -> HullColors:
    color_of: dict[str | None, str] = {None: UNLABELLED}
    color_of.update(label_colors(groups))
    groups_here = [group_of(h) for h in mesh.hulls]
    legend = [LegendEntry(color_of[g], g, groups_here.count(g)) for g in groups if g in groups_here]
    if None in groups_here:
        legend.append(LegendEntry(UNLABELLED, "no label", groups_here.count(None)))
    return HullColors(np.array([rgb(color_of[g]) for g in groups_here]).reshape(-1, 3), tuple(legend))


def _color_by_confidence(mesh: SymbolicMesh) -> HullColors:
    colors = [rgb(UNLABELLED) if h.confidence is None else confidence_color(h.confidence) for h in mesh.hulls]
    without = sum(h.confidence is None for h in mesh.hulls)
    legend = (LegendEntry(UNLABELLED, "no label", without),) if without else ()
    return HullColors(np.array(colors).reshape(-1, 3), legend, gradient=True)


def pick_distinct_colors(
    mesh: SymbolicMesh, picked: Iterable[int], known: Mapping[int, Floats] | None = None
) -> Floats:
    """Return colours (k, 3) of the picked hulls, far from each other, those of hulls in contact farthest; greedy, in
    order.

    known: colours of hulls, by index, that are settled.
    """
    pool, seen = candidate_colors()
    gap_to: dict[int, Floats] = {}
    uses = np.zeros(len(pool))
    nearest = np.full(len(pool), 0.5)
    assigned = dict(known or {})
    order = list(picked)
    for k in sorted(order, key=lambda k: k not in assigned):
        if k not in assigned:
            near = np.array([gap_to[j] for j in sorted(mesh.neighbours(k) & gap_to.keys())])
            wanted = np.minimum(near.min(axis=0, initial=0.5) / _NEIGHBOUR, 0.06) if len(near) else 0.06
            pick = int(np.argmax((wanted + nearest) * _WORTH**uses))
            assigned[k] = pool[pick] * _DIMMER ** uses[pick]
            uses[pick] += 1
        gap_to[k] = color_distance(seen, perceive_colors(assigned[k][None]))
        nearest = np.minimum(nearest, gap_to[k])
    return np.array([assigned[k] for k in order]).reshape(-1, 3)
