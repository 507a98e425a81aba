"""Pictures for the README and the documentation, of the bundled tables, seen upright."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

from meshforge.batch import load_templates
from meshforge.formats import load
from meshforge.language import Program, stage
from meshforge.samples import TABLES
from meshforge.symbolic import SymbolicMesh
from meshforge.views import compare, render, sheet, write_png

SHOWN = ("table_03", "table_08", "table_09", "table_11")
CHOICES = ("Geo(Is(handle), -Z)", "Attach(Is(handle), Is(drawer))", "Geo(Is(handle), -Y)")
"""Three readings of a rule of docs/learning.md, on the table that it is asked about."""


def main(folder: Path) -> None:
    """Write the pictures into a folder."""
    _tables(folder / "tables.png")
    _question(folder / "question.png")


def _tables(path: Path) -> None:
    program = Program.read(TABLES / "tables.mf")
    templates = load_templates(program, (TABLES, TABLES / "templates"))
    pairs, titles = [], []
    for name in SHOWN:
        mesh = load(TABLES / f"{name}.obj")
        upright, pose = stage(mesh, program.orient)
        edited = program.run(mesh, templates).mesh
        after: SymbolicMesh = replace(edited, hulls=tuple(hull.moved(pose) for hull in edited.hulls))
        pairs.append(compare(upright, after, size=(520, 400), color_by="hull"))
        titles.append((f"{len(mesh.hulls)} hulls", f"{len(after.hulls)} hulls"))
    pictures = [image for k in (0, 1) for image in (pair[k] for pair in pairs)]
    words = [text for k in (0, 1) for text in (title[k] for title in titles)]
    write_png(path, sheet(pictures, columns=len(SHOWN), titles=words))


def _question(path: Path) -> None:
    mesh, _ = stage(load(TABLES / "table_03.obj"), Program.read(TABLES / "tables.mf").orient)
    drawn = []
    for text in CHOICES:
        (rule,) = Program.parse(f"{text} => Delete").rules
        chosen = frozenset(mesh.hulls[k].name for k in rule.extractor.select(mesh))
        drawn.append(render(mesh, highlight=chosen, size=(520, 400), up="Z"))
    write_png(path, sheet(drawn, columns=len(drawn), titles=[f"choice {k}" for k in range(1, len(drawn) + 1)]))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
