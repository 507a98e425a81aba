"""What `tables.mf` does to the bundled tables, as a script that somebody writes by hand with trimesh.

Usage: python benchmark/speed/by_hand.py TABLES OUT
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

NEAR = 0.002  # of the diagonal: parts whose boxes are no farther apart touch


def main(tables: Path, out: Path) -> None:
    """Edit every table of a folder, labels beside it, and write it into another one."""
    tray = read_tray(tables)
    out.mkdir(parents=True, exist_ok=True)
    for path in sorted(tables.glob("*.obj")):
        labels = json.loads(path.with_suffix(".labels.json").read_text(encoding="utf-8"))["hulls"]
        edit_table(read_parts(path), labels, tray).export(out / path.name)


def read_tray(tables: Path) -> list[Any]:
    """The parts of the template for drawers."""
    return list(trimesh.load_mesh(tables / "templates" / "tray.obj", process=False).split())


def read_parts(path: Path) -> dict[str, Any]:
    """The hulls by name: trimesh forgets the objects of an OBJ, so they are split, and named in the file's order."""
    names = [line.split()[1] for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("o ")]
    return dict(zip(names, trimesh.load_mesh(path, process=False).split(), strict=True))


def edit_table(parts: dict[str, Any], labels: dict[str, Any], tray: list[Any]) -> Any:
    """Oddments go, the top becomes a box, each leg a hull, drawers become trays and their handles capsules."""
    by_label: dict[str, list[Any]] = {}
    for name, part in parts.items():
        by_label.setdefault(labels[name]["label"], []).append(part)
    panels, legs, drawers, handles = (by_label.get(label, []) for label in ("panel", "leg", "drawer", "handle"))
    near = NEAR * join(list(parts.values())).scale
    level = max(panel.bounds[1, 2] for panel in panels) - near
    made = [panel for panel in panels if panel.bounds[1, 2] <= level]
    top = join([panel for panel in panels if panel.bounds[1, 2] > level]).bounding_box_oriented
    square = top.primitive.transform[:3, :3]  # a table may be turned; square to its top, boxes touch where parts do
    made.append(top.to_mesh())
    made += [join(leg).convex_hull for leg in group(legs, square, near)]
    for drawer in group(drawers, square, near):
        made += put_into_box(tray, join(drawer).bounding_box_oriented)
    boxes = [bounds(drawer, square) for drawer in drawers]
    for handle in handles:
        at_drawer = any(touches(bounds(handle, square), box, near) for box in boxes)
        made.append(build_capsule(handle.bounding_box_oriented) if at_drawer else handle)
    return trimesh.Scene(made)


def join(parts: list[Any]) -> Any:
    """Parts as one mesh."""
    return trimesh.util.concatenate(parts)


def bounds(part: Any, square: Any) -> Any:
    """The lower and the upper corner of the box of a part along some axes (3, 3)."""
    places = part.vertices @ square
    return np.array([places.min(axis=0), places.max(axis=0)])


def touches(one: Any, other: Any, near: float) -> bool:
    """Whether two boxes touch."""
    return bool((one[0] - near <= other[1]).all() and (other[0] - near <= one[1]).all())


def group(parts: list[Any], square: Any, near: float) -> list[list[Any]]:
    """Parts that touch, together."""
    boxes = [bounds(part, square) for part in parts]
    edges = [(i, j) for i in range(len(parts)) for j in range(i) if touches(boxes[i], boxes[j], near)]
    pairs, nodes = np.array(edges, dtype=int).reshape(-1, 2), np.arange(len(parts))
    found = trimesh.graph.connected_components(pairs, nodes=nodes, min_len=1)
    return [[parts[k] for k in sorted(component)] for component in found]


def put_into_box(tray: list[Any], box: Any) -> list[Any]:
    """The parts of a template in the unit cube, in a box."""
    middle = np.eye(4)
    middle[:3, 3] = -0.5
    fit = box.primitive.transform @ np.diag([*box.primitive.extents, 1.0]) @ middle
    copies = [part.copy() for part in tray]
    for copy in copies:
        copy.apply_transform(fit)
    return copies


def build_capsule(box: Any) -> Any:
    """A capsule along the longest side of a box."""
    sides = box.primitive.extents
    axis = int(np.argmax(sides))
    radius = max(np.delete(sides, axis)) / 2
    made = trimesh.creation.capsule(height=max(sides[axis] - 2 * radius, 1e-6), radius=radius, count=[8, 8])
    turn: Any = trimesh.geometry.align_vectors([0, 0, 1], np.eye(3)[axis])  # type: ignore[no-untyped-call]  # has none
    made.apply_transform(box.primitive.transform @ turn)
    return made


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
