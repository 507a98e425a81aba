"""Scripts in real Blender: what they make of a mesh, and that those that misbehave harm nobody and count as failures.

Skipped where there is no Blender: see `benchmark.baselines.blender.apart.found`.
"""

import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from benchmark.assets import samples
from benchmark.baselines.blender.apart import find_python
from benchmark.baselines.blender.process import Blender, Limits
from benchmark.baselines.blender.scene import mesh_of, scene_of
from meshforge.common import UsageError
from meshforge.geometry import digest
from meshforge.symbolic import SymbolicMesh

PYTHON = find_python()
needs_blender = pytest.mark.skipif(PYTHON is None, reason="no Python with bpy: set BENCH_BLENDER")
MESH = samples("cup")[3].mesh
SCENE = scene_of(MESH, {})
QUICK = Limits(seconds=3.0, memory=2 << 30, file=1 << 20)


@pytest.fixture(scope="module")
def blender() -> Iterator[Blender]:
    assert PYTHON
    with Blender(PYTHON, QUICK) as one:
        yield one


def made(blender: Blender, script: str, before: SymbolicMesh = MESH) -> SymbolicMesh:
    answer = blender.run(script, scene_of(before, {}))
    assert "error" not in answer, answer["error"]
    return mesh_of(answer["objects"], before)[0]


def complaint(blender: Blender, script: str) -> str:
    answer = blender.run(script, SCENE)
    assert "objects" not in answer
    return str(answer["error"])


@needs_blender
def test_what_a_script_deletes_moves_labels_and_makes_comes_back(blender: Blender) -> None:
    first, second, third, *rest = (hull.name for hull in MESH.hulls)
    script = f"""
objects = bpy.data.objects
objects.remove(objects[{first!r}])
objects[{second!r}].location.z += 0.5
objects[{third!r}]["label"] = "spout"
bpy.ops.mesh.primitive_cube_add(size=0.2, location=(1, 2, 3), rotation=(0.1, 0.2, 0.3))
bpy.context.object.name, bpy.context.object["label"] = "box", "lid"
bpy.ops.object.light_add()
"""
    answer = blender.run(script, SCENE)
    back, named = mesh_of(answer["objects"], MESH)
    assert {hull.name for hull in back.hulls} == {second, third, *rest, "box"}
    assert named == {third, "box"}
    lifted = MESH.hull_of(second).aabb.min + np.array([0, 0, 0.5])
    assert np.allclose(back.hull_of(second).aabb.min, lifted, atol=1e-6)
    assert back.hull_of(second).label == MESH.hull_of(second).label
    assert (back.hull_of(third).label, back.hull_of("box").label) == ("spout", "lid")
    assert digest(back.hull_of(third).shape) == digest(MESH.hull_of(third).shape)
    assert back.hull_of("box").volume == pytest.approx(0.008, rel=1e-5)
    assert back.hull_of("box").shape.kind == "polytope"
    assert all(back.hull_of(name) is MESH.hull_of(name) for name in rest)


@needs_blender
@pytest.mark.parametrize(
    ("script", "why"),
    [
        ("for", "SyntaxError"),
        ("bpy.data.objects['none']", "line 1"),
        ("def f():\n    raise KeyError('x')\nf()", 'File "script.py", line 3, in <module>'),
        ("import sys\nsys.exit('no')", "the script ends itself: no"),
        ("while True: pass", "it took longer than 3 seconds"),
        ("a = []\nwhile True: a.append(bytes(1 << 28))", "MemoryError"),
        ("f = open('big', 'wb')\nfor _ in range(9): f.write(bytes(1 << 20))", "File too large"),
        ("import os\nos._exit(0)", "Blender broke down under it"),
        ("import faulthandler\nfaulthandler._read_null()", "Blender broke down under it"),
        ("import os\nos.abort()", "Blender broke down under it"),
        ("import os\nos.fork()", "other processes may not be used"),
        ("import subprocess\nsubprocess.run(['ls'])", "other processes may not be used"),
        ("import os\nos.kill(os.getppid(), 9)", "other processes may not be used"),
        ("import ctypes\nctypes.string_at(0)", "calling into the system"),
        ("open('/etc/passwd').read()", "files outside of the working folder"),
        ("open('/proc/self/environ').read()", "files outside of the working folder"),
        ("bpy.ops.wm.open_mainfile(filepath='/etc/passwd')", "RuntimeError"),
        ("import socket\nsocket.create_connection(('127.0.0.1', 80))", "the network may not be used"),
        ("import urllib.request\nurllib.request.urlopen('http://example.org')", "the network may not be used"),
        ("x = [\n" * 400, "SyntaxError"),
        ("import os\nopen(os.getcwd() + '/none')", "No such file or directory: '.../none'"),
        ("bpy.context.scene.collection.objects.link(1)", "TypeError"),
    ],
)
def test_a_script_that_misbehaves_is_stopped_and_the_next_runs(blender: Blender, script: str, why: str) -> None:
    assert why in complaint(blender, script)
    assert complaint(blender, script) == complaint(blender, script)
    assert len(made(blender, "pass").hulls) == len(MESH.hulls)


@needs_blender
@pytest.mark.parametrize(
    "script",
    [
        "open({path!r}, 'w')",
        "import os\nos.mkdir({path!r})",
        "import os\nos.rename('/etc/hostname', {path!r})",
        "bpy.ops.wm.save_as_mainfile(filepath={path!r})",
        "bpy.ops.wm.obj_export(filepath={path!r})",
        "import os\nos.symlink('/etc', 'etc')\nopen('etc/x', 'w')",
        "import os\nos.chdir('/')\nopen({path!r}.lstrip('/'), 'w')",
    ],
)
def test_nothing_is_written_outside_of_a_folder_that_goes_then(blender: Blender, tmp_path: Path, script: str) -> None:
    path = tmp_path / "written"
    blender.run(script.format(path=str(path)), SCENE)
    assert list(tmp_path.iterdir()) == []
    assert made(blender, "open('own', 'w').write('x')\nopen('own').read()").hulls


@needs_blender
def test_no_key_and_nothing_of_ours_is_in_the_environment(blender: Blender, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("OPENAI_API_KEY", "sk-secret")
    assert PYTHON
    with Blender(PYTHON, QUICK) as one:
        told = complaint(one, "import os\nraise ValueError(dict(os.environ))")
        assert "PATH" in told
        assert "sk-secret" not in told
        assert not {name for name in os.environ if name.endswith("KEY") and name in told}


def test_a_python_without_blender_and_none_at_all_are_one_message(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"there is no program here(.|\n)*install --group blender"):
        Blender(tmp_path / "python").run("pass", SCENE)
    empty = tmp_path / "empty"
    empty.write_text("#!/bin/sh\necho no Blender here >&2\nexit 1\n", "utf-8")
    empty.chmod(0o755)
    with pytest.raises(UsageError, match="Blender does not start: no Blender here"):
        Blender(empty).run("pass", SCENE)


@needs_blender
def test_who_writes_where_results_are_written_is_found_out_and_spoils_nothing_for_the_next(blender: Blender) -> None:
    forging = """
import os
for number in range(3, 20):
    try:
        os.write(number, b'{"number": 0, "objects": []}\\n' * 2)
    except OSError:
        pass
"""
    assert "only results are written" in complaint(blender, forging) or "broke down" in complaint(blender, forging)
    assert len(made(blender, "pass").hulls) == len(MESH.hulls)
