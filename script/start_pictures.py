"""The pictures of the studio's start page: a table before and after, and an asset of each bundled family; transparent,
so that they stand on light and on dark.

`python -m script.start_pictures` draws them into web/src/start/pictures, less than 60 kB in all.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from PIL import Image

from meshforge.batch import load_templates
from meshforge.formats import load
from meshforge.geometry import Aabb
from meshforge.language import Program, to_canonical_frame
from meshforge.rendering import render
from meshforge.samples import FAMILIES, TABLES
from meshforge.symbolic import SymbolicMesh

FOLDER = Path(__file__).resolve().parents[1] / "web" / "src" / "start" / "pictures"
SHOWN = {"bottles": "hand_soap.obj", "cups": "mug/model.urdf", "chairs": "armchair.glb", "tables": "table_03.obj"}
LARGE, SMALL, COLORS = (480, 340), (160, 120), 64


def main() -> None:
    """Draw all of them."""
    FOLDER.mkdir(exist_ok=True)
    program = Program.read(TABLES / "tables.mf")
    mesh = load(TABLES / "table_03.obj")
    before, pose = to_canonical_frame(mesh, program.orient)
    edited = program.run(mesh, load_templates(program.templates, (TABLES, TABLES / "templates"))).mesh
    after = replace(edited, hulls=tuple(hull.move(pose) for hull in edited.hulls))
    _draw("before", before, LARGE, before.aabb)
    _draw("after", after, LARGE, before.aabb)
    for family in FAMILIES:
        mesh = load(family.folder / SHOWN[family.name])
        _draw(family.name, before if family.name == "tables" else mesh, SMALL)


def _draw(name: str, mesh: SymbolicMesh, size: tuple[int, int], bounds: Aabb | None = None) -> None:
    picture = render(mesh, size=size, legend=False, background=None, bounds=bounds)
    picture.quantize(COLORS, Image.Quantize.FASTOCTREE).save(FOLDER / f"{name}.png", optimize=True)


if __name__ == "__main__":
    main()
