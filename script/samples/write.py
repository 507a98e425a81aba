"""The files of the family: hulls as OBJ groups, labels beside them, demonstrations, the template."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path

from meshforge.formats import load
from meshforge.geometry import Polytope
from meshforge.language import Program, Template
from meshforge.symbolic import Label, SymbolicMesh, write_labels
from script.samples.part import LABELS
from script.samples.pieces import DIGITS, Piece


def write_table(folder: Path, name: str, about: str, pieces: Sequence[Piece]) -> SymbolicMesh:
    """Write NAME.obj and NAME.labels.json; the labelled mesh as it reads back."""
    path = folder / f"{name}.obj"
    width = len(str(len(pieces) - 1))
    names = [f"convex_{k:0{width}}" for k in range(len(pieces))]
    path.write_text(obj_text(about, {n: p.hull for n, p in zip(names, pieces, strict=True)}), encoding="ascii")
    labels = {n: Label(p.label, 1.0, "file") for n, p in zip(names, pieces, strict=True)}
    mesh = load(path).with_labels(labels)
    if [hull.name for hull in mesh.hulls] != names:
        raise SystemExit(f"{path} does not read back as it was written")
    write_labels(folder / f"{name}.labels.json", mesh, LABELS)
    return mesh


def obj_text(about: str, hulls: Mapping[str, Polytope]) -> str:
    """Hulls as groups of one OBJ file."""
    lines, first = [f"# {about}"], 1
    for name, hull in hulls.items():
        lines.append(f"o {name}")
        lines += ["v " + " ".join(_number(x) for x in vertex) for vertex in hull.vertices]
        lines += ["f " + " ".join(str(first + k) for k in face) for face in hull.faces]
        first += len(hull.vertices)
    return "\n".join(lines) + "\n"


def _number(x: float) -> str:
    return f"{round(x, DIGITS) + 0.0:.{DIGITS}f}".rstrip("0").rstrip(".")


def write_demonstration(folder: Path, mesh: SymbolicMesh, program: Program, templates: Mapping[str, Template]) -> None:
    """Write demonstrations/ID.json: what the program selects on the mesh, rule by rule."""
    assert mesh.asset is not None
    asset = mesh.asset.path.name
    trace = program.run(mesh, templates).trace
    steps = [
        json.dumps({"rule": line.rule, "select": list(line.selected), "action": str(rule.action)})
        for rule, line in zip(program.rules, trace, strict=True)
    ]
    text = f'{{\n  "asset": {json.dumps(asset)},\n  "steps": [\n    ' + ",\n    ".join(steps) + "\n  ]\n}\n"
    (folder / f"{asset}.json").write_text(text, encoding="utf-8")
