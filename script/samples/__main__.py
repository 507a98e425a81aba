"""Makes the bundled tables: `script/make-samples [--out FOLDER] [NAME ...]`."""

from __future__ import annotations

import argparse
from collections import Counter
from pathlib import Path

from meshforge.formats import read
from meshforge.geometry import convex_hull
from meshforge.geometry.decomposition.run import cache_folder
from meshforge.language import Program, Template
from meshforge.samples import TABLES
from meshforge.symbolic import SymbolicMesh
from script.samples.family import FAMILY
from script.samples.pieces import pieces_of, triangles
from script.samples.program import DEMONSTRATED, PROGRAM, tray
from script.samples.table import Table
from script.samples.write import obj_text, write_demonstration, write_table


def main() -> None:
    """Make all tables, or those named, and tell what was made."""
    parser = argparse.ArgumentParser(prog="script/make-samples", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="only these tables, such as table_03")
    parser.add_argument("--out", type=Path, default=TABLES, help="the folder to write to")
    parser.add_argument("--cache", action="store_true", help="use and keep decompositions in the usual cache")
    given = parser.parse_args()
    folder: Path = given.out
    wanted = [table for table in (make() for make in FAMILY) if not given.names or table.name in given.names]
    templates = write_common(folder)
    program = Program.parse(PROGRAM)
    for table in wanted:
        mesh = make_table(table, folder, cache_folder() if given.cache else None)
        if table.name in DEMONSTRATED:
            write_demonstration(folder / "demonstrations", mesh, program, templates)
    print(f"{sum(p.stat().st_size for p in folder.rglob('*') if p.is_file()) / 1e6:.2f} MB in {folder}")


def write_common(folder: Path) -> dict[str, Template]:
    """Write the program and its template; the templates as a run takes them."""
    for name in ("templates", "demonstrations"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    (folder / "tables.mf").write_text(str(Program.parse(PROGRAM)), encoding="ascii")
    path = folder / "templates" / "tray.obj"
    walls = {name: convex_hull(triangles(solid)[0]) for name, solid in tray().items()}
    path.write_text(obj_text("open tray in the unit cube: a floor and four walls", walls), encoding="ascii")
    return {path.name: Template(tuple(geom.shape for geom in read(path).geoms), path.name)}


def make_table(table: Table, folder: Path, cache: Path | None = None) -> SymbolicMesh:
    """Decompose a table, write its files, and tell how many hulls it has of each label."""
    pieces = [p for part in table.parts for p in pieces_of(part, table.pose, table.settings(part), cache)]
    mesh = write_table(folder, table.name, table.about, pieces)
    counts = Counter(piece.label for piece in pieces)
    print(f"{table.name}  {len(pieces):2} hulls  {', '.join(f'{n} {k}' for k, n in counts.items())}  ({table.about})")
    return mesh


if __name__ == "__main__":
    main()
