"""VLM Blender on loopback, in real Blender: what is fed back, and how it ends. Skipped where there is no Blender."""

import json
from collections.abc import Iterator

import pytest

from benchmark.baselines.blender.apart import find_python
from benchmark.baselines.blender.process import Blender, Limits
from benchmark.baselines.blender_model import BlenderModel, differences
from benchmark.baselines.refinement import refine
from benchmark.baselines.replay import Replay, replay_demonstrations
from benchmark.baselines.verdicts import judge_script
from benchmark.study import TRUE, Bench, Session, open_bench
from tests.unit.benchmark.blender_script import SHELLS
from tests.unit.benchmark.model_asking import asking, block, by_turn, key

__all__ = ["key"]
pytestmark = pytest.mark.usefixtures("key")
PYTHON = find_python()
needs_blender = pytest.mark.skipif(PYTHON is None, reason="no Python with bpy: set BENCH_BLENDER")
NAME = "cup-easy"
ROOM = 500


@pytest.fixture(scope="module")
def bench() -> Bench:
    return open_bench(NAME, "medium")


@pytest.fixture(scope="module")
def taught(bench: Bench) -> Session:
    return Session(NAME, TRUE.name, 100, "medium", shown=list(bench.samples)[:2])


@pytest.fixture(scope="module")
def shown(bench: Bench, taught: Session) -> list[Replay]:
    return replay_demonstrations(bench, taught)


@pytest.fixture(scope="module")
def work(bench: Bench, shown: list[Replay]) -> Iterator[BlenderModel]:
    assert PYTHON
    with Blender(PYTHON, Limits(seconds=5.0)) as blender:
        yield BlenderModel(bench.task, shown, blender)


def test_meshes_that_are_the_same_do_not_differ_and_others_do_in_words(shown: list[Replay]) -> None:
    before, after = shown[0].before, shown[0].after
    assert differences(before, before) == differences(after, after) == []
    lacking, left = differences(before, after)
    walls = [hull.name for hull in before.hulls if hull.label == "wall"]
    assert lacking.startswith("there should be, and is not: ")
    assert left.startswith(f"there is, and should not be: {walls[0]}, wall, (")
    without = after.with_hulls(after.hulls[1:])
    (one,) = differences(without, after)
    assert one.startswith(f"there should be, and is not: {after.hulls[0].name}, ")


@needs_blender
def test_a_script_that_is_wrong_at_first_is_told_why_and_ends_right(
    bench: Bench, taught: Session, shown: list[Replay], work: BlenderModel
) -> None:
    open_shell = SHELLS.replace("for part in parts:", "for part in parts[1:]:")
    torus = "bpy.ops.mesh.primitive_torus_add()"
    answers = [block("objects = nowhere"), block(torus), block(open_shell), block(SHELLS)]
    with asking(by_turn(*answers)) as (server, client):
        written = refine(client, work.opening, work.try_answer, ROOM)
    assert (written.fits, written.wrong, written.text) == (True, [2, 2, 2, 0], SHELLS.strip())
    first, *again = server.answered
    assert "headless Blender 5" in first.text
    assert "0.002 times the diagonal" in first.text
    said = [list(asked.parts[len(before.parts) :]) for asked, before in zip(again, server.answered, strict=False)]
    names = [one.name for one in shown]
    failed, illegal, lacking = ["\n".join(p for p in parts if isinstance(p, str)) for parts in said]
    assert all(f"{name}: it fails: Traceback" in failed for name in names)
    assert "NameError: name 'nowhere' is not defined" in failed
    assert all(f"{name}: it fails: no legal hulls: Torus: not convex" in illegal for name in names)
    assert all(f"{name}: there should be, and is not: " in lacking for name in names)
    assert [len(asked.pictures) - len(first.pictures) for asked in again] == [0, 0, 2]
    judged = Session.of_json(
        json.loads(json.dumps(judge_script(NAME, TRUE.name, 100, taught.shown, written.text, str(PYTHON))))
    )
    program = {n for n in bench.samples if bench.failure(n, bench.truth.edit(bench.task.program, n))} - set(
        taught.shown
    )
    assert judged.failures.keys() == program
    assert judged.judged == len(bench.samples) - 2


@needs_blender
def test_scripts_that_never_end_fail_everywhere(bench: Bench, taught: Session, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Blender.__init__, "__defaults__", (Limits(seconds=1.0),))
    judged = Session.of_json(judge_script(NAME, TRUE.name, 100, taught.shown, "while True: pass", str(PYTHON)))
    reasons = list(judged.failures.values())
    assert len(reasons) == judged.judged
    assert reasons[:3] == ["it took longer than 1 seconds"] * 3
    assert set(reasons[3:]) == {"not tried: 3 meshes in a row took too long or broke Blender"}
