"""The page of the documentation that tells what each reader finds."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from tests.loads.assets import EDIT, SUFFIXES, Refused
from tests.loads.comparing import TOLERANCE
from tests.loads.rows import Cell, Row

_HEAD = f"""\
# Loaded by others

`script/loads` writes the bundled tables, and samples with joints, turned and mirrored bodies, frames, non-convex
pieces and native shapes, in every format. It edits each of these files by one program and writes it again. Then it
loads all of them in other programs, and compares the shapes that these find with those of MeshForge. The program
deletes, scales, replaces hulls by native shapes, and adds one:

```
{str(EDIT).strip()}
```

A cell says how many files agree, and how many collision shapes they have. A file agrees if it has as many shapes, and
each reaches as far as that of MeshForge in 26 directions of the world (the axes, the diagonals of their planes, those
of the octants), within {TOLERANCE:g} of the largest coordinate. So place, size, turn and handedness agree. Readers
that are less exact are named below.

```sh
python3 -m venv drake && drake/bin/pip install drake   # several readers need other packages than MeshForge
script/loads --python drake=drake/bin/python --page docs/loads.md
```

"""


def page(rows: Sequence[Row], refused: Sequence[Refused]) -> str:
    """The page, in Markdown."""
    return "\n".join([_HEAD.rstrip("\n"), "", *_table(rows), "", *_notes(rows, refused), ""])


def _table(rows: Sequence[Row]) -> Iterator[str]:
    suffixes = [suffix for suffix in SUFFIXES if any(suffix in row.cells for row in rows)]
    yield "| reader | version | " + " | ".join(suffix or "a folder" for suffix in suffixes) + " |"
    yield "| --- " * (len(suffixes) + 2) + "|"
    for row in rows:
        version = f"not run: `pip install '{row.reader.package}'`" if row.version is None else row.version
        cells = [_cell(row.cells.get(suffix)) for suffix in suffixes]
        yield f"| {row.reader.title} | {version} | " + " | ".join(cells) + " |"


def _cell(cell: Cell | None) -> str:
    if cell is None:
        return ""
    return f"{cell.files}: {cell.shapes:,}" + (f", **{cell.wrong} differ**" if cell.wrong else "")


def _notes(rows: Sequence[Row], refused: Sequence[Refused]) -> Iterator[str]:
    yield "An empty cell is a format that the reader does not load. Notes:"
    yield ""
    yield "- MeshForge itself: it reads back what it should have written."
    for row in rows:
        said = [row.reader.about, *(f"Not {suffix}: {why}." for suffix, why in row.reader.absent.items())]
        limits = {f"{suffix} {asset}": row.reader.limits[suffix, asset] for suffix, asset in sorted(row.limits)}
        said += [f"Left out, {name}: {why}." for name, why in limits.items()]
        if any(said):
            yield f"- {row.reader.title}: {' '.join(filter(None, said))}"
    yield "- .urdf with `<capsule>`, which `--urdf-capsules` writes: MuJoCo 4.0 and PyBullet 3.2.7 find it as a"
    yield '  capsule of that radius and length; Drake documents it; yourdfpy 0.0.60 ends with "Unknown tag".'
    yield "- .glb, .gltf: where a scene has visuals, only `KHR_physics_rigid_bodies` marks its colliders, which no"
    yield "  reader here supports: such samples are left out. Polytopes stand for round shapes, up to 6% of"
    yield "  their width inside."
    for one in refused:
        yield f"- {one.suffix} {one.asset} is not written: {one.why}."
    wrong = [told for row in rows for told in row.differences]
    yield ""
    yield "## Differences" if wrong else "There are no differences."
    if wrong:
        yield ""
        yield from (f"- {told}" for told in wrong)
