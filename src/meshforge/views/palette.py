"""Colours that are easy to tell apart, for people with and without colour blindness."""

from __future__ import annotations

from functools import cache

import numpy as np

from meshforge.geometry import Floats

LABEL_COLORS = (
    "#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7",
    "#9F003E", "#7D7DF9", "#6D4177", "#86E79C", "#3245B7", "#7DDDFB", "#99BB77", "#457D79", "#C53443",
    "#A975CE", "#4B65D9", "#A840A2", "#F1C955", "#A7DBC8", "#5DA34D", "#DF8CD8", "#7E2491",
)  # fmt: skip
"""Colours of labels, in the order of the vocabulary: Okabe and Ito's, without their black; after these, each the
farthest from those before it, as seen by normal, deuteranopic and protanopic eyes, grey kept free."""
UNLABELLED = "#B4B9C0"
REMOVED, MADE, KEPT = "#D5401A", "#0FA47A", "#C9CED6"
DIFFERENCE_COLORS = {"removed": REMOVED, "made": MADE, "kept": KEPT}
"""Of the hulls in a picture of differences."""
SELECTED, PALE = "#E8760A", "#D9DDE3"
CONFIDENCE = ("#C4472B", "#EFA94A", "#EFE3A0", "#7FB7C9", "#2B6CA3")
"""From no confidence to full: red to blue, light in the middle, told apart by every eye."""


def rgb(color: str) -> Floats:
    """A colour `#rrggbb` as red, green and blue (3,) in 0..1."""
    return np.array([int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)])


def hexadecimal(color: Floats) -> str:
    """Red, green and blue (3,) in 0..1 as `#rrggbb`."""
    return "#" + "".join(f"{round(float(c) * 255):02X}" for c in color)


def label_color(index: int) -> str:
    """The colour of the label at this place of the vocabulary; after two dozen they come round again."""
    return LABEL_COLORS[index % len(LABEL_COLORS)]


def confidence_color(confidence: float) -> Floats:
    """A colour (3,) for a confidence in 0..1."""
    stops = np.array([rgb(c) for c in CONFIDENCE])
    at = np.linspace(0, 1, len(stops))
    return np.array([np.interp(confidence, at, stops[:, k]) for k in range(3)])


def perceived(colors: Floats) -> Floats:
    """Colours (n, 3) as seen by three kinds of eyes (3, n, 3) in Oklab, where distance is difference."""
    linear = _linear(colors)
    seen = [np.clip(linear @ eye.T, 0, 1) for eye in (np.eye(3), _DEUTERANOPIA, _PROTANOPIA)]
    return np.array([np.cbrt(s @ _TO_CONES.T) @ _TO_LAB.T for s in seen])


def apart(seen: Floats, other: Floats) -> Floats:
    """How different perceived colours (3, n, 3) are from one other (3, 1, 3): for most eyes, and for the worst."""
    gaps = np.linalg.norm(seen - other, axis=2)
    difference: Floats = 0.5 * gaps[0] + 0.5 * gaps.min(axis=0)
    return difference


@cache
def candidates() -> tuple[Floats, Floats]:
    """Friendly colours of even strength (n, 3), a blue first, that hulls are given; and how each is perceived."""
    lightness, chroma, hue = np.meshgrid([0.68, 0.77, 0.86], [0.07, 0.12], 4.4 + np.arange(30) * (np.pi / 15))
    lab = np.stack([lightness, chroma * np.cos(hue), chroma * np.sin(hue)], axis=-1).reshape(-1, 3)
    linear = (lab @ np.linalg.inv(_TO_LAB).T) ** 3 @ np.linalg.inv(_TO_CONES).T
    angle = hue % (2 * np.pi)
    muddy = ((angle > 0.8) & (angle < 2.3) & (lightness < 0.75)).ravel()  # dark yellows
    linear = linear[((linear >= 0) & (linear <= 1)).all(axis=1) & ~muddy]
    colors = np.where(linear <= 0.0031308, linear * 12.92, 1.055 * linear ** (1 / 2.4) - 0.055)
    return colors, perceived(colors)


def _linear(colors: Floats) -> Floats:
    linear: Floats = np.where(colors <= 0.04045, colors / 12.92, ((colors + 0.055) / 1.055) ** 2.4)
    return linear


# Björn Ottosson, "A perceptual color space for image processing", 2020
_TO_CONES = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
_TO_LAB = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)
# Machado, Oliveira and Fernandes, "A physiologically-based model for simulation of color vision deficiency", 2009
_DEUTERANOPIA = np.array(
    [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
)
_PROTANOPIA = np.array(
    [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
)
