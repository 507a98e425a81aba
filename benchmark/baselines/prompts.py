"""What a model is shown of a task and of its demonstrations: words and pictures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from benchmark.baselines.replay import Replay
from meshforge.common import join_names, pluralize
from meshforge.geometry import Aabb
from meshforge.language import Program, Template
from meshforge.symbolic import Hull, SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image

    from meshforge.labels.vlm.question import Part

_PICTURES, _SIZE = 2, 768  # numbered ones of a mesh; [px]
_PAIR = (640, 560)
_FEW = 8  # made hulls that are told


def describe_demonstrations(shown: Sequence[Replay], frame: Program) -> Iterator[Part]:
    """All demonstrations, each with its hulls, its steps, and pictures before and after."""
    from meshforge.rendering import draw_labeling_pictures, encode_png

    for number, one in enumerate(shown, 1):
        yield f"## Demonstration {number}: {one.name}\n\n{describe_mesh(one.before)}\n"
        for shot in draw_labeling_pictures(one.before, most=_PICTURES, size=_SIZE):
            yield f"{one.name} before, {shot.name}; hull_07 has the number 7."
            yield encode_png(shot.marked)
        yield f"What was done on {one.name}, step by step:\n{steps(one)}"
        yield f"{one.name} before and after all steps, coloured by label:"
        yield encode_png(_pair(one.before, one.after, frame))


def describe_mesh(mesh: SymbolicMesh) -> str:
    """The symbolic mesh as text: a line a hull, with its label, its box, and what it touches."""
    lines = [f"{pluralize(len(mesh.hulls), 'hull')}: name, label, box, hulls in contact with it"]
    for place, one in enumerate(mesh.hulls):
        near = [mesh.hulls[other].name for other in sorted(mesh.neighbours(place))]
        lines.append(f"{hull(one)}; {', '.join(near) or 'none'}")
    return "\n".join(lines)


def steps(shown: Replay) -> str:
    """What a person did, step by step."""
    lines = []
    for step in shown.demo.steps:
        given = f" as {step.label}" if step.label else ""
        what = f"{step.rule}. {step.action}{given}"
        if not step.select:
            lines.append(f"{what}: on no hull of this mesh")
            continue
        made = [hull(shown.stages[step.rule].hull_of(name)) for name in shown.find_products(step.rule)]
        more = [f"and {len(made) - _FEW} more"] if len(made) > _FEW else []
        end = f"\n   made {'; '.join([*made[:_FEW], *more])}" if made else ""
        lines.append(f"{what}: on {', '.join(sorted(step.select))}{end}")
    return "\n".join(lines)


def templates(given: Mapping[str, Template]) -> str:
    """The template files, with what they hold."""
    rows = [
        f'"{name}": {pluralize(len(one.shapes), "hull")}, {_sides(one.aabb)} along X, Y, Z'
        for name, one in given.items()
    ]
    return "\n".join(rows) or "none"


def draw_comparison(got: SymbolicMesh, wanted: SymbolicMesh, frame: Program) -> Image:
    """What came out beside what was shown."""
    return _pair(got, wanted, frame, ("what came out", "as it was shown"))


def list_hulls(hulls: Sequence[Hull]) -> str:
    """Hulls by name and label."""
    return join_names([f"{one.name} ({one.label or 'no label'})" for one in hulls], most=12)


def _pair(
    first: SymbolicMesh, second: SymbolicMesh, frame: Program, titles: tuple[str, str] = ("before", "after")
) -> Image:
    from meshforge.rendering import make_contact_sheet, render
    from meshforge.rendering.comparison import joint_bounds

    box = joint_bounds(first, second)
    images = [
        render(mesh, color_by="label", size=_PAIR, bounds=box, vocabulary=frame.labels) for mesh in (first, second)
    ]
    return make_contact_sheet(images, 2, titles)


def hull(one: Hull) -> str:
    """A hull in words: its name, label and box, and what primitive it is, if one."""
    kind = f", native {one.shape.kind}" if one.primitive else ""
    return f"{one.name}, {one.label or 'no label'}{kind}, {_box(one.aabb)}"


def _box(box: Aabb) -> str:
    return "(" + ") to (".join(" ".join(f"{x:.4f}" for x in corner) for corner in (box.min, box.max)) + ")"


def _sides(box: Aabb) -> str:
    return " by ".join(f"{side:.4f}" for side in box.size)
