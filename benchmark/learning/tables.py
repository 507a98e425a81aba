"""The bundled tables, upright, and more of them by stretching."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np

from meshforge.batch.jobs import load_templates, template_folders
from meshforge.formats import load
from meshforge.language import Extractor, Program, Template, parse_extractor, to_canonical_frame
from meshforge.samples import TABLES
from meshforge.symbolic import SymbolicMesh

PROGRAM = Program.parse((TABLES / "tables.mf").read_text("utf-8"))
DEMONSTRATED = ("table_03", "table_08")
RULES: tuple[Extractor, ...] = tuple(
    map(
        parse_extractor,
        (
            "Is(misc)",
            "Is(leg)",
            "Is(drawer)",
            "Geo(Is(panel), +Z)",
            "Attach(Is(handle), Is(drawer))",
            "Diff(Is(leg), Attach(Is(leg), Is(panel)))",
            "Diff(Is(drawer), Geo(Is(drawer), -Z))",
            "Intersect(Attach(Is(leg), Is(panel)), Geo(Is(leg), -Z))",
            "Diff(Attach(Is(drawer), Is(handle)), Geo(Is(drawer), -Z))",
        ),
    )
)
"""What one may want selected on them, the rules of their program among it."""


@cache
def templates() -> dict[str, Template]:
    """Those of the tables' program."""
    return load_templates(PROGRAM.templates, template_folders(TABLES / "tables.mf"))


@cache
def read_tables() -> dict[str, SymbolicMesh]:
    """The tables as they come, by name."""
    paths = sorted(TABLES.glob("table_*.obj"))
    return {path.stem: load(path, path.with_suffix(".labels.json")) for path in paths}


@cache
def upright() -> dict[str, SymbolicMesh]:
    """The tables as the first rule of a program sees them, their contacts known."""
    found = {name: to_canonical_frame(mesh, PROGRAM.orient)[0] for name, mesh in read_tables().items()}
    assert all(mesh.contacts is not None for mesh in found.values())
    return found


def stretch_tables(count: int) -> dict[str, SymbolicMesh]:
    """So many tables: the bundled ones, then the same with each side up to a quarter longer or shorter."""
    found = dict(read_tables())
    draw = np.random.default_rng(0)
    for k in range(len(found), count):
        mesh = list(read_tables().values())[k % len(read_tables())]
        factors = np.diag(draw.uniform(0.8, 1.25, 3))
        hulls = (replace(hull, shape=hull.shape.transform(factors, np.zeros(3))) for hull in mesh.hulls)
        found[f"table_{k + 1:02}"] = SymbolicMesh(tuple(hulls))
    return dict(list(found.items())[:count])
