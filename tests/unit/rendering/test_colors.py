"""Which hull gets which colour."""

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from numpy.random import default_rng

from meshforge.geometry import Floats
from meshforge.rendering.colors import (
    HULL_COLORS,
    LABEL_COLORS,
    PALE,
    SELECTED,
    UNLABELLED,
    LabelLook,
    color_hulls,
    hexadecimal,
    highlight_hulls,
    label_colors,
    look_of,
    pick_distinct_colors,
    rgb,
    to_linear,
)
from meshforge.symbolic import Label, LabelSource, SymbolicMesh
from tests.unit.rendering.scenes import box, hull, table


def to_lab(colors: Sequence[str]) -> Floats:
    """CIELAB under D65 of colours `#rrggbb`."""
    to_xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
    x, y, z = np.cbrt(to_linear(np.array([rgb(c) for c in colors])) @ to_xyz.T / [0.9505, 1, 1.0888]).T
    return np.stack([116 * y, 500 * (x - y), 200 * (y - z)], axis=1)


def test_what_is_pointed_out_has_no_label_s_colour() -> None:
    css = (Path(__file__).parents[3] / "web/src/styles/tokens.css").read_text(encoding="utf-8")
    shown = to_lab([SELECTED, *re.findall(r"--highlight: (#\w{6});", css)])
    assert len(shown) == 3
    assert np.linalg.norm(shown[:, None] - to_lab([*LABEL_COLORS, UNLABELLED, PALE]), axis=2).min() > 40


def row(count: int) -> SymbolicMesh:
    return SymbolicMesh(tuple(hull(f"h{k}", box((k, 0, 0), (1, 1, 1))) for k in range(count)))


def test_the_vocabulary_s_order_gives_the_colours() -> None:
    assert list(label_colors(["b", "a"]).values()) == list(LABEL_COLORS[:2])
    colors = color_hulls(table(), "label", ["leg", "panel"]).colors
    assert [hexadecimal(c) for c in colors] == [LABEL_COLORS[k] for k in (1, 1, 0, 0)] + [UNLABELLED]


def test_labels_outside_the_vocabulary_come_after_it_by_alphabet() -> None:
    legend = color_hulls(table(), "label", ["drawer"]).legend
    assert [(e.name, e.color, e.count) for e in legend[:3]] == [
        ("leg", LABEL_COLORS[1], 2),
        ("panel", LABEL_COLORS[2], 2),
        ("no label", UNLABELLED, 1),
    ]


def test_unsure_labels_are_hatched_and_guessed_ones_dotted_on_a_paler_ground() -> None:
    coloring = color_hulls(table(), "label")
    assert coloring.hatched == {3} and not coloring.dotted
    assert coloring.legend[-1].name == "hatched: unsure"
    guessed = color_hulls(table().with_labels({"leg0": Label("leg", 0.9, "propagated")}), "label")
    place = table().index["leg0"]
    assert guessed.dotted == {place} and guessed.legend[-2].name == "dotted: guessed"
    assert (guessed.colors[place] > coloring.colors[place]).any() and (guessed.colors >= coloring.colors).all()


@pytest.mark.parametrize(
    ("source", "confidence", "look"),
    [
        ("user", 1.0, "given"),
        ("file", 0.6, "given"),
        ("step", 1.0, "given"),
        ("name", 0.7, "given"),  # its very word
        ("name", 0.6, "guessed"),  # of its body
        ("edit", 1.0, "given"),
        ("propagated", 1.0, "guessed"),
        ("vlm", 0.49, "unsure"),
    ],
)
def test_only_people_files_and_names_give_labels(source: LabelSource, confidence: float, look: LabelLook) -> None:
    assert look_of(Label("leg", confidence, source)) == look


def test_touching_hulls_differ_clearly_even_in_a_long_row() -> None:
    colors = color_hulls(row(90), "hull").colors
    assert np.linalg.norm(np.diff(colors, axis=0), axis=1).min() > 0.25


def test_forty_hulls_have_forty_colours() -> None:
    colors = color_hulls(row(40), "hull").colors
    assert len({hexadecimal(c) for c in colors}) == 40


def test_however_many_hulls_there_are_no_two_have_the_same_colour() -> None:
    colors = color_hulls(row(200), "hull").colors
    assert len({hexadecimal(c) for c in colors}) == 200
    assert colors.min() >= 0
    assert colors.max() <= 1


def test_picked_hulls_have_colours_as_if_there_were_no_others() -> None:
    picked = range(20, 30)
    assert np.array_equal(pick_distinct_colors(row(60), picked), color_hulls(row(10), "hull").colors)


def test_known_hulls_keep_their_colour() -> None:
    mesh = row(6)
    known = {"h2": rgb(HULL_COLORS[7])}
    colors = color_hulls(mesh, "hull", known=known).colors
    assert np.array_equal(colors[2], known["h2"])


def test_highlighting_counts_the_selected() -> None:
    legend = highlight_hulls(table(), frozenset({"knob", "leg0"})).legend
    assert [(e.name, e.count) for e in legend] == [("selected", 2), ("others", 3)]


def test_colours_survive_their_spelling() -> None:
    for value in default_rng(0).integers(0, 256, (50, 3)):
        assert np.array_equal(np.rint(rgb(hexadecimal(value / 255)) * 255), value)
