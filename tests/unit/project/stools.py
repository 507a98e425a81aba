"""Stools of a seat and four legs, each a solid of their visual mesh; hulls of parts, or one that spans two."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from meshforge.geometry import Box, Floats, Polytope, Pose, convex_hull
from meshforge.project import Project

PARTS = ("seat", "leg", "leg", "leg", "leg")


def boxes(width: float, height: float) -> list[Polytope]:
    """The parts: a seat, then the legs, which touch it from below."""
    seat = make_box((0, 0, height + 0.02), (width, width, 0.02))
    at = width - 0.04
    legs = [make_box((x, y, height / 2), (0.03, 0.03, height / 2)) for x in (-at, at) for y in (-at, at)]
    return [seat, *legs]


def make_box(middle: Sequence[float], half: Sequence[float]) -> Polytope:
    """An upright box; half: of its sizes [m]."""
    return Box(Pose(np.eye(3), np.array(middle, dtype=float)), np.array(half, dtype=float)).tessellate()


def coarse(parts: Sequence[Polytope]) -> list[Polytope]:
    """Hulls of which the first spans the seat and the first leg, and the others are legs."""
    both = convex_hull(np.concatenate([parts[0].vertices, parts[1].vertices]))
    return [both, *parts[2:]]


def create_stools(folder: Path, sizes: Mapping[str, tuple[float, float]], spanning: str) -> Project:
    """A project of stools, by name with their width and height [m], in `folder / "p"`: of those in `spanning` the first
    hull spans the seat and a leg, the others are labelled."""
    for name, size in sizes.items():
        parts = boxes(*size)
        write_stool(folder / "assets", name, parts, coarse(parts) if name in spanning else parts)
    project = Project.create(folder / "p", [folder / "assets/*.urdf"], vocabulary=("seat", "leg"))
    for asset in (f"{name}.urdf" for name in sizes if name not in spanning):
        project.set_labels(asset, dict(zip((hull.name for hull in project.mesh(asset).hulls), PARTS, strict=True)))
    return project


def write_stool(folder: Path, name: str, parts: Sequence[Polytope] | None, hulls: Sequence[Polytope]) -> Path:
    """A URDF of one link that shows the parts, or nothing, and collides by the hulls."""
    folder.mkdir(parents=True, exist_ok=True)
    rows = "".join(_collision(k, _write(folder, f"{name}_h{k}", [hull])) for k, hull in enumerate(hulls))
    seen = ""
    if parts:
        seen = f'<visual><geometry><mesh filename="{_write(folder, f"{name}_seen", parts)}"/></geometry></visual>'
    path = folder / f"{name}.urdf"
    path.write_text(f'<robot name="{name}"><link name="base">{seen}{rows}</link></robot>')
    return path


def write_bare_stool(folder: Path, name: str) -> Path:
    """A URDF of one link that shows a stool whose parts have names, and collides by nothing."""
    folder.mkdir(parents=True, exist_ok=True)
    lines, start = list[str](), 1
    for part, solid in zip(PARTS, boxes(0.2, 0.4), strict=True):
        lines += [f"o {part}", *_format_solid(solid, start)]
        start += len(solid.vertices)
    (folder / f"{name}_seen.obj").write_text("\n".join(lines) + "\n")
    path = folder / f"{name}.urdf"
    seen = f'<visual><geometry><mesh filename="{name}_seen.obj"/></geometry></visual>'
    path.write_text(f'<robot name="{name}"><link name="base">{seen}</link></robot>')
    return path


def _write(folder: Path, name: str, solids: Sequence[Polytope]) -> str:
    lines, start = list[str](), 1
    for solid in solids:
        lines += _format_solid(solid, start)
        start += len(solid.vertices)
    (folder / f"{name}.obj").write_text("\n".join(lines) + "\n")
    return f"{name}.obj"


def _format_solid(solid: Polytope, start: int) -> list[str]:
    """Lines of an OBJ; start: the number of its first vertex."""
    points = [f"v {_format(point)}" for point in solid.vertices]
    return points + [f"f {' '.join(str(k + start) for k in face)}" for face in solid.faces]


def _format(point: Floats) -> str:
    return " ".join(f"{x:.9g}" for x in point)


def _collision(k: int, file: str) -> str:
    return f'<collision name="h{k}"><geometry><mesh filename="{file}"/></geometry></collision>'
