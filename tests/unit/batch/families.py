"""Small families of assets made by hand, for tests of batches and projects."""

import json
from collections.abc import Mapping
from pathlib import Path

FACES = ((1, 4, 3, 2), (5, 6, 7, 8), (1, 2, 6, 5), (2, 3, 7, 6), (3, 4, 8, 7), (4, 1, 5, 8))

Corner = tuple[float, float, float]

PROGRAM = """\
labels top, leg, misc

Is(misc) => Delete
Is(leg) => Each(Merge)
"""


def obj(boxes: Mapping[str, tuple[Corner, Corner]]) -> str:
    """An OBJ text of named boxes, each given by its lowest and highest corner."""
    lines = []
    for k, (name, ((x0, y0, z0), (x1, y1, z1))) in enumerate(boxes.items()):
        around = ((x0, y0), (x1, y0), (x1, y1), (x0, y1))
        lines += [f"o {name}", *(f"v {x} {y} {z}" for z in (z0, z1) for x, y in around)]
        lines += ["f " + " ".join(str(8 * k + corner) for corner in face) for face in FACES]
    return "\n".join(lines) + "\n"


def table_boxes(height: float = 1.0) -> dict[str, tuple[Corner, Corner]]:
    """A top on two legs of two blocks each, and a crumb that belongs to nothing."""
    half = height / 2
    return {
        "top": ((0, 0, height), (2, 1, height + 0.1)),
        "left_low": ((0, 0, 0), (0.1, 1, half)),
        "left_high": ((0, 0, half), (0.1, 1, height)),
        "right_low": ((1.9, 0, 0), (2, 1, half)),
        "right_high": ((1.9, 0, half), (2, 1, height)),
        "crumb": ((5, 5, 5), (5.1, 5.1, 5.1)),
    }


def label_of(name: str) -> str:
    return {"top": "top", "crumb": "misc"}.get(name, "leg")


def write_table(path: Path, height: float = 1.0, *, labels: bool = True) -> Path:
    """A table as OBJ, with its labels beside it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    boxes = table_boxes(height)
    path.write_text(obj(boxes))
    if labels:
        given = {"vocabulary": ["top", "leg", "misc"], "hulls": {name: label_of(name) for name in boxes}}
        path.with_suffix(".labels.json").write_text(json.dumps(given))
    return path


def write_tables(folder: Path, count: int = 3) -> list[Path]:
    """Tables of growing height, each in a folder of its own, all by the same file name."""
    return [write_table(folder / f"table{k}" / "model.obj", 1.0 + k / 4) for k in range(count)]


def write_urdf_table(folder: Path, name: str = "table.urdf", mesh: str = "meshes/crumb.obj") -> Path:
    """A URDF table of boxes and one mesh file, with labels beside it."""
    (folder / mesh).parent.mkdir(parents=True, exist_ok=True)
    (folder / mesh).write_text(obj({"crumb": ((0, 0, 0), (0.1, 0.1, 0.1))}))
    shapes = {
        "top": ('<box size="2 1 0.1"/>', "1 0.5 1.05"),
        "left": ('<box size="0.1 1 1"/>', "0.05 0.5 0.5"),
        "right": ('<box size="0.1 1 1"/>', "1.95 0.5 0.5"),
        "crumb": (f'<mesh filename="{mesh}"/>', "5 5 5"),
    }
    collisions = "\n".join(
        f'    <collision name="{key}"><origin xyz="{at}"/><geometry>{shape}</geometry></collision>'
        for key, (shape, at) in shapes.items()
    )
    path = folder / name
    path.write_text(f'<robot name="table">\n  <link name="body">\n{collisions}\n  </link>\n</robot>\n')
    given = {"hulls": {f"body/{key}": label_of(key) for key in shapes}}
    path.with_suffix(".labels.json").write_text(json.dumps(given))
    return path


def tree(folder: Path) -> dict[str, bytes]:
    """Every file below a folder by its path, for comparing outputs byte by byte."""
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}
