"""Pictures for the README: some bundled tables before and after the program, seen upright."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

from meshforge.batch import load_templates
from meshforge.formats import load
from meshforge.language import Program, stage
from meshforge.samples import TABLES
from meshforge.symbolic import SymbolicMesh
from meshforge.views import compare, sheet, write_png

SHOWN = ("table_03", "table_08", "table_09", "table_11")


def main(folder: Path) -> None:
    """Write the pictures into a folder."""
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
    write_png(folder / "tables.png", sheet(pictures, columns=len(SHOWN), titles=words))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
