"""Draws docs/pictures/architecture.svg: one file on its way through the program, and the layers of packages.

Usage: python -m script.architecture_picture [FILE]
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from html import escape
from pathlib import Path

FILE = Path(__file__).resolve().parents[1] / "docs" / "pictures" / "architecture.svg"
WIDTH, HEIGHT = 1080, 896
STEPS = (
    ("URDF in", "table.urdf", "formats"),
    ("asset", "bodies, geoms, document", "symbolic"),
    ("symbolic mesh", "hulls, labels, contacts", "symbolic, labels"),
    ("demonstration", "a person's steps", "project, studio"),
    ("program", "rules: which hulls, what", "synthesis, language"),
    ("run", "on every asset", "batch"),
    ("URDF out", "edited/table.urdf", "formats"),
)
"""The stations of a file: what it is there, in other words, and the packages that make it so."""
LAYERS = (
    (("cli", "one file a command"),),
    (("studio", "the web GUI's server"),),
    (("project", "use cases: demonstrate, learn, ask, review, apply"),),
    (("labels", "from names, files, models, propagation"),),
    (("store", "the project folder on disk"),),
    (("inspection", "checks, pictures and differences of one asset"),),
    (("batch", "many assets: workers, outputs, report"), ("samples", "families to try")),
    (("signoff", "how sure each result is; what to ask next"),),
    (
        ("synthesis", "learns programs"),
        ("checks", "legality, fit, free space, physics"),
        ("formats", "reads and writes files"),
    ),
    (("label_model", "what is believed about labels"),),
    (("language", "parses, prints and runs programs"), ("rendering", "draws meshes"), ("engines", "their limits")),
    (("symbolic", "asset, hulls, contact graph"),),
    (("geometry", "hulls, poses, distances, decomposition"),),
    (("common", "errors, atomic files, text"),),
)
"""The packages below `meshforge`, top layer first, each with what it is for."""


def draw() -> Iterator[str]:
    """The lines of the SVG."""
    yield f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif">'
    yield '<marker id="head" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8" orient="auto">'
    yield '<path d="M0,0 L8,4 L0,8 z" fill="#444"/></marker>'
    yield f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>'
    yield from draw_walk()
    yield from draw_layers()
    yield "</svg>"


def draw_walk() -> Iterator[str]:
    """One row of boxes with arrows between them."""
    yield text(30, 36, "One file on its way through the program", size=18, anchor="start", bold=True)
    width, gap = 126, 23
    for number, (title, about, packages) in enumerate(STEPS):
        x = 30 + number * (width + gap)
        yield box(x, 56, width, 58, "#e8f0fa")
        yield text(x + width / 2, 80, title, size=15, bold=True)
        yield text(x + width / 2, 101, about, size=10)
        yield text(x + width / 2, 132, packages, size=11, color="#2a5a9a")
        if number:
            yield f'<path d="M{x - gap + 2},85 H{x - 2}" stroke="#444" stroke-width="1.6" marker-end="url(#head)"/>'


def draw_layers() -> Iterator[str]:
    """The packages as a stack, and an arrow for the direction of imports."""
    yield text(30, 190, "Who may import whom: a package imports only packages on lines below it", 18, "start", True)
    left, right, top, step = 90, WIDTH - 30, 210, 48
    for line, packages in enumerate(LAYERS):
        width = (right - left - 12 * (len(packages) - 1)) / len(packages)
        for number, (name, about) in enumerate(packages):
            x, y = left + number * (width + 12), top + line * step
            yield box(x, y, width, step - 8, "#f4f4f0")
            yield text(x + width / 2, y + 17, name, size=14, bold=True)
            yield text(x + width / 2, y + 33, about, size=11)
    bottom = top + len(LAYERS) * step - 8
    yield f'<path d="M55,{top} V{bottom}" stroke="#444" stroke-width="2" marker-end="url(#head)"/>'
    middle = (top + bottom) / 2
    yield f'<g transform="rotate(-90 44 {middle})">{text(44, middle, "imports", size=12)}</g>'


def box(x: float, y: float, width: float, height: float, fill: str) -> str:
    """A rectangle with round corners [px]."""
    return f'<rect x="{x}" y="{y}" width="{width}" height="{height}" rx="5" fill="{fill}" stroke="#888"/>'


def text(
    x: float, y: float, words: str, size: int, anchor: str = "middle", bold: bool = False, color: str = "#222"
) -> str:
    """One line of text, its baseline at y [px]."""
    weight = ' font-weight="bold"' if bold else ""
    return (
        f'<text x="{x}" y="{y}" font-size="{size}" text-anchor="{anchor}" fill="{color}"{weight}>{escape(words)}</text>'
    )


if __name__ == "__main__":
    target = Path(sys.argv[1]) if sys.argv[1:] else FILE
    target.write_text("\n".join(draw()) + "\n", encoding="utf-8")
