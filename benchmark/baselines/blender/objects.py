"""The objects of a scene, made in Blender, handed to a script, and read back. Runs in Blender's Python.

A scene is JSON: `hulls`, each with name, label, contacts (names), vertices, faces, and `templates`, by name a list of
meshes.
"""

from __future__ import annotations

import linecache
import os
import re
import traceback
from typing import Any

SCRIPT = "script.py"
_HOME = os.environ.get("HOME") or os.sep * 2  # the working folder, which has another name each time
_PROPERTIES = ("label", "primitive")
_LONG = 2000  # characters of a complaint


def edit_scene(script: str, scene: Any) -> dict[str, Any]:
    """What a script makes of a scene: `objects`, or `error` where it fails."""
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    templates = {name: [_mesh(bpy, name, **part) for part in parts] for name, parts in scene["templates"].items()}
    made = {row["name"]: _object(bpy, row) for row in scene["hulls"]}
    before = {name: _describe(one.data, one.matrix_world) for name, one in made.items()}
    del made
    error = _run(script, {"__name__": "__main__", "bpy": bpy, "templates": templates})
    if error:
        return {"error": error}
    try:
        return {"objects": list(_read_objects(bpy, before))}
    except Exception as problem:  # whatever a script did to the scene
        return {"error": f"the objects cannot be read when the script has ended: {_format_traceback(problem)}"}


def _run(script: str, names: dict[str, Any]) -> str | None:
    """Why a script fails, with the lines that led there; None where it does not."""
    linecache.cache[SCRIPT] = (len(script), None, script.splitlines(keepends=True), SCRIPT)
    try:
        exec(compile(script, SCRIPT, "exec"), names)
    except SystemExit as end:
        return f"the script ends itself: {end.code}" if end.code else None
    except BaseException as problem:
        return _format_traceback(problem)
    return None


def _format_traceback(problem: BaseException) -> str:
    """A traceback with the script's own lines only, the same each time."""
    told = traceback.TracebackException.from_exception(problem, capture_locals=False)
    told.stack = traceback.StackSummary.from_list([row for row in told.stack if row.filename == SCRIPT])
    text = "".join(told.format(chain=False)).strip()
    for odd in (re.escape(os.path.realpath(_HOME)), re.escape(_HOME), "0x[0-9a-fA-F]+"):
        text = re.sub(odd, "...", text)
    return text if len(text) <= _LONG else f"{text[: _LONG // 2]}\n...\n{text[-_LONG // 2 :]}"


def _object(bpy: Any, row: Any) -> Any:
    """A hull as an object at the middle of its box, so that its own coordinates are exact."""
    low, high = ([pick(axis) for axis in zip(*row["vertices"], strict=True)] for pick in (min, max))
    middle = [(a + b) / 2 for a, b in zip(low, high, strict=True)]
    vertices = [[x - m for x, m in zip(point, middle, strict=True)] for point in row["vertices"]]
    one = bpy.data.objects.new(row["name"], _mesh(bpy, row["name"], vertices, row["faces"]))
    one.location = middle
    if row["label"] is not None:
        one["label"] = row["label"]
    one["contacts"] = " ".join(row["contacts"])
    bpy.context.scene.collection.objects.link(one)
    bpy.context.view_layer.update()
    return one


def _mesh(bpy: Any, name: str, vertices: Any, faces: Any) -> Any:
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    mesh.update()
    return mesh


def _read_objects(bpy: Any, before: dict[str, Any]) -> Any:
    """The mesh objects of the scene, as they are with their modifiers, in their own coordinates."""
    if bpy.context.object and bpy.context.object.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    graph = bpy.context.evaluated_depsgraph_get()
    for one in sorted(bpy.context.scene.objects, key=lambda one: one.name):
        if one.type != "MESH":
            continue
        final = one.evaluated_get(graph)
        mesh = final.to_mesh()
        told = _describe(mesh, final.matrix_world)
        final.to_mesh_clear()
        said = {name: str(one[name]) for name in _PROPERTIES if one.get(name) is not None}
        same = told == before.get(one.name)
        yield {"name": one.name, "same": True, **said} if same else {"name": one.name, **told, **said}


def _describe(mesh: Any, matrix: Any) -> dict[str, Any]:
    mesh.calc_loop_triangles()
    return {
        "vertices": [list(vertex.co) for vertex in mesh.vertices],
        "faces": [list(triangle.vertices) for triangle in mesh.loop_triangles],
        "matrix": [list(row) for row in matrix],
    }
