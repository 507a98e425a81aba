"""What a script makes of a mesh of a task, as programs' edits are judged."""

from __future__ import annotations

from benchmark.baselines.blender.process import Blender
from benchmark.baselines.blender.scene import mesh_of, scene_of
from benchmark.baselines.blender.shapes import Illegal
from benchmark.tasks import EditResult, Task
from meshforge.common import MeshForgeError
from meshforge.geometry import Pose
from meshforge.language import from_canonical_frame, to_canonical_frame
from meshforge.symbolic import SymbolicMesh


def edit_task(blender: Blender, script: str, task: Task, mesh: SymbolicMesh) -> EditResult:
    """A script's edit of a mesh as it lies in its file; the script meets it as rules do, turned by the landmarks.

    What comes back counts only if every object is a legal hull.
    """
    staged, pose = _orient(task, mesh)
    done = ran(blender, script, task, staged)
    return done if done.mesh is None else EditResult(from_canonical_frame(mesh, done.mesh, pose), named=done.named)


def ran(blender: Blender, script: str, task: Task, staged: SymbolicMesh) -> EditResult:
    """A script's edit of a mesh in the frame of the rules."""
    answer = blender.run(script, scene_of(staged, task.templates))
    if "objects" not in answer:
        return EditResult(None, error=answer["error"])
    try:
        mesh, named = mesh_of(answer["objects"], staged)
    except Illegal as error:
        return EditResult(None, error=f"no legal hulls: {error}")
    return EditResult(mesh, named=named)


def _orient(task: Task, mesh: SymbolicMesh) -> tuple[SymbolicMesh, Pose]:
    """The mesh in the frame of the rules; where its landmarks are missing, as it lies."""
    try:
        return to_canonical_frame(mesh, task.program.orient, task.program.contact)
    except MeshForgeError:
        return to_canonical_frame(mesh, None, task.program.contact)
