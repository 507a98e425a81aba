"""VLM Blender: a model writes a Blender script, from the demonstrations that MeshForge learned from."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from benchmark.baselines import prompts
from benchmark.baselines.blender.edit import ran
from benchmark.baselines.blender.process import Blender
from benchmark.baselines.refinement import Trial, find_code
from benchmark.baselines.replay import Replay
from benchmark.tasks import Task
from meshforge.labels.vlm.question import Message, Part
from meshforge.language import show
from meshforge.symbolic import EPSILON, Hull, SymbolicMesh

NAME = "VLM Blender"
_ROOT = Path(__file__).resolve().parents[2]
_ACTIONS = "## Editing them", "## Orientation"
_NEAR, _LIKE = 0.01, 0.05  # of the mesh's diagonal, and of the volume: from there on a hull is another one
_FEW = 6
_TASK = """\
You write Blender scripts in Python that edit collision meshes: sets of convex hulls, each an object of its own.
Somebody shows on a few meshes of a family what is to be done; you write the one script that does this on every mesh of
the family, also on those that you are not shown, which have other numbers of hulls, other shapes, and some parts more
or fewer. Names of objects mean nothing on other meshes: decide by labels, positions, sizes and contacts.

The script runs in headless Blender {version}, on one mesh at a time:
- `bpy.context.scene.objects` holds one mesh object for each hull, named as below, its label as a custom property:
  `object["label"]`. Its origin is the middle of its box, unrotated; `object.matrix_world` takes its vertices to the
  coordinates below. There is nothing else in the scene.
- `templates` is a dictionary from the name of a template file to a list of `bpy.types.Mesh`, one for each of its hulls.
- Delete, change and make mesh objects; link what you make to the scene. When the script ends, every mesh object of the
  scene, with its modifiers, is a hull of the result.
- Every one of them has to be closed and convex: one that is not spoils the mesh. The hull of some points is made so:
  `bm = bmesh.new()`, `bm.verts.new(p)` for each point, `bmesh.ops.convex_hull(bm, input=bm.verts)`, remove the vertices
  that have no faces, `bm.to_mesh(mesh)`.
- An object that keeps its name counts as that hull; one that you make should have the property "label". One that is to
  be a native primitive instead of a hull mesh has to have that shape, along its own axes, and say so:
  `object["primitive"]` is "box", "cylinder", "capsule" or "sphere".
- Two hulls are in contact where they are at most {contact:g} times the diagonal of the whole mesh's box apart.
  `object["contacts"]` names the objects in contact with it at the beginning, with spaces between.
- There is no network, no file to read, no other program, and {seconds:g} seconds of time. Only bpy, bmesh, mathutils,
  numpy and the standard library are there.

Below is what the actions mean that the steps of the demonstrations are told by. Then come the demonstrations: of each
mesh the hulls with label, box and contacts, pictures, and the steps, in order.

Answer with the script in one block of code.

{actions}"""
_OPENING = """\
# The task

Labels: {labels}. {frame}

Templates:
{templates}
"""
_CLOSING = "Write the script."
_AGAIN = "Answer with the whole script again."


@dataclass(frozen=True, eq=False)
class BlenderModel:
    """The model's work on one task and some demonstrations; blender: what its scripts are tried in."""

    task: Task
    shown: Sequence[Replay]
    blender: Blender

    @property
    def opening(self) -> tuple[Message, ...]:
        """What the model is told first."""
        frame = self.task.program
        turned = f"Every mesh lies so: {show(frame.orient)}." if frame.orient else "Meshes lie as in their files."
        begun = _OPENING.format(
            labels=", ".join(frame.labels), frame=turned, templates=prompts.templates(self.task.templates)
        )
        told = _TASK.format(
            version=self.blender.fences.blender,
            contact=frame.contact or EPSILON,
            seconds=self.blender.limits.seconds,
            actions=actions(),
        )
        shown = prompts.describe_demonstrations(self.shown, frame)
        return Message("system", (told,)), Message("user", (begun, *shown, _CLOSING))

    def try_answer(self, answer: str) -> Trial:
        """An answer on the demonstrations."""
        script = find_code(answer)
        if not script:
            return Trial(None, 0, (f"There is no script in your answer. {_CLOSING}",))
        said, wrong = list[Part](), 0
        for one in self.shown:
            faults = tuple(self._faults(script, one))
            wrong += bool(faults)
            said += faults
        return Trial(script, wrong, ("The script does not do what was shown.", *said, _AGAIN) if wrong else ())

    def _faults(self, script: str, one: Replay) -> Iterator[Part]:
        """What a script does otherwise than was shown on a mesh, with a picture of what came out."""
        from meshforge.rendering import encode_png

        done = ran(self.blender, script, self.task, one.before)
        if done.mesh is None:
            yield f"{one.name}: it fails: {done.error}"
            return
        faults = differences(done.mesh, one.after)
        if faults:
            yield f"{one.name}: " + "; ".join(faults) + ". What came out, and what should have:"
            yield encode_png(prompts.draw_comparison(done.mesh, one.after, self.task.program))


@cache
def actions() -> str:
    """What the actions of the language mean, as the project itself documents it."""
    text = (_ROOT / "docs" / "language.md").read_text("utf-8")
    start, end = map(text.index, _ACTIONS)
    return text[start:end].strip()


def differences(got: SymbolicMesh, wanted: SymbolicMesh) -> list[str]:
    """How hulls differ, place, size and label, in words; nothing where they are the same but for rounding."""
    left, lacking = list(got.hulls), []
    reach = _NEAR * wanted.diagonal
    for hull in wanted.hulls:
        same = next((other for other in left if _same(hull, other, reach)), None)
        if same:
            left.remove(same)
        else:
            lacking.append(hull)
    rows = ((lacking, "there should be, and is not:"), (left, "there is, and should not be:"))
    return [f"{what} {_list(hulls)}" for hulls, what in rows if hulls]


def _same(one: Hull, other: Hull, reach: float) -> bool:
    a, b = one.aabb, other.aabb
    near = max(np.abs(a.min - b.min).max(), np.abs(a.max - b.max).max()) <= reach
    alike = one.label == other.label and bool(one.primitive) == bool(other.primitive)
    return bool(near) and alike and abs(one.volume - other.volume) <= _LIKE * one.volume


def _list(hulls: Sequence[Hull]) -> str:
    more = len(hulls) - _FEW
    return ", ".join(prompts.hull(one) for one in hulls[:_FEW]) + (f" and {more} more" if more > 0 else "")
