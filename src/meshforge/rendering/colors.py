"""Colours that are easy to tell apart, with and without colour blindness, and which hull gets which of them."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from meshforge.geometry import Floats
from meshforge.symbolic import CERTAIN_SOURCES, GIVEN_SOURCES, Hull, Label, SymbolicMesh

LABEL_COLORS = (
    "#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7",
    "#9F003E", "#7D7DF9", "#6D4177", "#86E79C", "#3245B7", "#7DDDFB", "#99BB77", "#457D79", "#C53443",
    "#A975CE", "#4B65D9", "#A840A2", "#F1C955", "#A7DBC8", "#5DA34D", "#DF8CD8", "#7E2491",
)  # fmt: skip
"""Colours of labels, in the order of the vocabulary: Okabe and Ito's, without their black; after these, each the
farthest from those before it, as seen by normal, deuteranopic and protanopic eyes, grey kept free."""
HULL_COLORS = (
    "#799BC3", "#D8D776", "#B0D5FE", "#7CA857", "#F7958E", "#46CDB7", "#B1A8FC", "#D47795", "#FBBFC5", "#79EAC2",
    "#D8AD52", "#16B09B", "#D2A4C5", "#40C7E5", "#83C883", "#D77C63", "#BD7EC2", "#F8B6FE", "#EECA9F", "#958BDE",
    "#5DE8F5", "#D0AE83", "#7EA47D", "#9EB4E2", "#F393B1", "#A0E69F", "#B588A9", "#DA99DF", "#90C2A2", "#48A1DB",
    "#F29C6F", "#61A5AC", "#7DC2C9", "#9AE0DD", "#C08883", "#EFC0E3", "#AAC064", "#07AAC7", "#66BEF9", "#B6DEB4",
)  # fmt: skip
"""Colours of hulls, of even strength, without grey and muddy ones: each the farthest from those before it, as above."""
UNLABELLED = "#B4B9C0"
REMOVED, MADE, CHANGED, KEPT = "#D5401A", "#0FA47A", "#8A3FD1", "#C9CED6"
DIFFERENCE_COLORS = {"removed": REMOVED, "made": MADE, "kept": KEPT}
"""Of the hulls in a picture of differences."""
SELECTED, PALE = "#E000F0", "#D9DDE3"
"""Of hulls that are pointed out, which is far from all colours of labels, and of the others."""
ColorBy = Literal["hull", "label", "body"]
COLOR_BY: tuple[ColorBy, ...] = get_args(ColorBy)
UNSURE = 0.5
"""Labels less certain than this are hatched."""
LabelLook = Literal["given", "guessed", "unsure"]
_GIVEN_FROM = dict.fromkeys(GIVEN_SOURCES | CERTAIN_SOURCES, UNSURE) | {"name": 0.7, "edit": 1.0}
"""From which confidence on a label of a source is given; a name of a hull that holds the very word has 0.7."""
_CLEAR = 0.3  # in red, green and blue: hulls in contact should differ by so much
_USED = 0.2  # by how much more a colour must differ for each use that it had already
_DIMMER = 0.9  # and so much darker it is each time


def rgb(color: str) -> Floats:
    """Return a colour `#rrggbb` as red, green and blue (3,) in 0..1."""
    return np.array([int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)])


def hexadecimal(color: Floats) -> str:
    """Return red, green and blue (3,) in 0..1 as `#rrggbb`."""
    return "#" + "".join(f"{round(float(c) * 255):02X}" for c in color)


def label_color(index: int) -> str:
    """Return the colour of the label at this place of the vocabulary; after two dozen they come round again."""
    return LABEL_COLORS[index % len(LABEL_COLORS)]


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
    """A colour for each hull (n, 3), sRGB in 0..1, and the legend; hatched, dotted: not sure, guessed."""

    colors: Floats
    legend: tuple[LegendEntry, ...] = ()
    hatched: frozenset[int] = frozenset()
    dotted: frozenset[int] = frozenset()


def look_of(label: Label | None) -> LabelLook | None:
    """Return whether a label is given, by a person, a file or a name, or else guessed, or not even sure."""
    if label is None or label.confidence < UNSURE:
        return "unsure" if label else None
    return "given" if label.confidence >= _GIVEN_FROM.get(label.source, np.inf) else "guessed"


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
            others = {h.label for h in mesh.hulls if h.label} - set(vocabulary)
            coloring = _color_by_group(mesh, [*vocabulary, *sorted(others)], lambda hull: hull.label)
            looks = [look_of(h.annotation) for h in mesh.hulls]
            marks = {"dotted": "guessed", "hatched": "unsure"}
            found = {m: frozenset(k for k, look in enumerate(looks) if look == marks[m]) for m in marks}
            notes = tuple(LegendEntry("", f"{m}: {marks[m]}", len(found[m])) for m in marks if found[m])
            colors = coloring.colors.copy()
            colors[sorted(found["dotted"])] = (1 + colors[sorted(found["dotted"])]) / 2  # half white
            return HullColors(colors, coloring.legend + notes, **found)
        case "body":
            return _color_by_group(mesh, list(dict.fromkeys(h.body for h in mesh.hulls)), lambda hull: hull.body)


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


def pick_distinct_colors(
    mesh: SymbolicMesh, picked: Iterable[int], known: Mapping[int, Floats] | None = None
) -> Floats:
    """Return colours (k, 3) of the picked hulls, all different, those of hulls in contact clearly; greedy, in order.

    known: colours of hulls, by index, that are settled.
    """
    palette, assigned, order = np.array([rgb(color) for color in HULL_COLORS]), dict(known or {}), list(picked)
    uses = np.zeros(len(palette))
    for color in assigned.values():
        uses[np.linalg.norm(palette - color, axis=1).argmin()] += 1
    for k in order:
        if k not in assigned:
            colors = palette * (_DIMMER**uses)[:, None]
            near = np.array([assigned[j] for j in sorted(mesh.neighbours(k) & assigned.keys())]).reshape(-1, 1, 3)
            gaps = np.linalg.norm(colors - near, axis=2).min(axis=0, initial=_CLEAR)
            pick = int(np.argmax(gaps - _USED * uses))
            assigned[k] = colors[pick]
            uses[pick] += 1
    return np.array([assigned[k] for k in order]).reshape(-1, 3)
