"""Labels survive a kill at any moment: what a person said before stays, and no file is left that cannot be read. Labels
by worker processes: one asset that cannot be read costs one asset, a kill costs nothing that was done."""

import json
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from time import sleep
from typing import IO

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.batch import IN_PROCESS, ExecutionOptions
from meshforge.batch.workers import MIB
from meshforge.common import file_state
from meshforge.labels import LabelOutcome
from meshforge.project import Project
from meshforge.symbolic import HUMAN_SOURCES
from tests.examples import examples
from tests.unit.batch.families import label_of, table_boxes, tree, write_table
from tests.unit.deaths import deaths, needs_fork
from tests.unit.labels.test_label_by_propagation import family

HULLS = tuple(table_boxes())
Act = tuple[str, str, str, str]
ACTS = st.tuples(
    st.sampled_from(["user", "user", "vlm", "name", "propagate"]),
    st.sampled_from(["t0.obj", "t1.obj", "t2.obj"]),
    st.sampled_from(HULLS),
    st.sampled_from(["top", "leg", "misc"]),
)
ROUNDS = st.lists(st.tuples(st.lists(ACTS, max_size=4), ACTS, st.floats(0.0, 0.5)), min_size=1, max_size=3)
"""In each, some acts that are done, and one in the midst of which, after some seconds, the process is killed."""


class Labeller:
    """The process, and what was asked of it."""

    def __init__(self, folder: Path) -> None:
        command = [sys.executable, "-m", "tests.unit.labels.labelling_process", str(folder)]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        assert self._out.readline() == "ready\n"

    @property
    def _out(self) -> IO[str]:
        assert self._process.stdout
        return self._process.stdout

    def ask(self, act: Act) -> None:
        assert self._process.stdin
        print(json.dumps(act), file=self._process.stdin, flush=True)

    def done(self) -> None:
        assert self._out.readline() == "done\n"

    def kill(self) -> None:
        self._process.kill()
        with self._process:
            pass


def said_by_people(folder: Path) -> dict[tuple[str, str], str]:
    project = Project.open(folder)
    return {
        (asset, name): label.name
        for asset in project.assets()
        for name, label in project.labels(asset).labels.items()
        if label.source in HUMAN_SOURCES
    }


@pytest.mark.slow
@examples(6)
@given(rounds=ROUNDS)
def test_what_a_person_said_outlives_every_kill(
    tmp_path_factory: pytest.TempPathFactory, rounds: list[tuple[list[Act], Act, float]]
) -> None:
    folder = tmp_path_factory.mktemp("family")
    family(folder).set_labels("t0.obj", {"top": "top"})
    said = {("t0.obj", "top"): "top"}
    for acts, last, seconds in rounds:
        labeller = Labeller(folder / "p")
        for source, asset, hull, label in acts:
            labeller.ask((source, asset, hull, label))
            labeller.done()
            said |= {(asset, hull): label} if source == "user" else {}
        labeller.ask(last)
        sleep(seconds)
        labeller.kill()
        source, asset, hull, label = last
        found = said_by_people(folder / "p")
        also = said | {(asset, hull): label} if source == "user" else said
        assert found in (said, also)
        said = found
    Project.open(folder / "p").label("propagate")
    assert said_by_people(folder / "p") == said


NAMES = tuple(table_boxes())
WAYS: dict[str, Callable[[Project, ExecutionOptions], tuple[LabelOutcome, ...]]] = {
    "names": lambda project, spread: project.label("names", execution=spread).outcomes,
    "file": lambda project, spread: project.label("file", execution=spread).outcomes,
    "all": lambda project, spread: project.label(execution=spread).outcomes,
    "propagate": lambda project, spread: project.label("propagate", execution=spread).outcomes,
}


def begun(folder: Path, count: int = 4) -> Project:
    """Tables, one of which a person labelled, and one that has a labels file."""
    project = family(folder, count)
    project.set_labels("t0.obj", {name: label_of(name) for name in NAMES})
    write_table(folder / "assets/t1.obj", height=1.1)
    return project


@pytest.mark.slow
@pytest.mark.parametrize("way", WAYS)
def test_labels_are_the_same_whatever_the_number_of_workers(tmp_path: Path, way: str) -> None:
    project, found = begun(tmp_path), []
    before = tree(project.folder / "labels")
    for workers in (0, 1, 3):
        found.append((WAYS[way](project, ExecutionOptions(workers)), tree(project.folder / "labels")))
        assert found[-1][1] != before
        shutil.rmtree(project.folder)
        begun(tmp_path)
    assert found[0] == found[1] == found[2]


@pytest.mark.parametrize("way", WAYS)
def test_an_asset_that_cannot_be_read_is_told_and_does_not_hide_the_others(tmp_path: Path, way: str) -> None:
    project = begun(tmp_path)
    for name in ("t2", "t3"):
        write_table(tmp_path / f"assets/{name}.obj", height=1.7)
    (tmp_path / "assets/t2.obj").write_text("nothing of use")
    reports = {report.asset: report for report in WAYS[way](project, IN_PROCESS)}
    assert "t2.obj" in reports["t2.obj"].problems[0]
    assert reports["t3.obj"].taken and not reports["t3.obj"].problems


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="only Linux bounds the memory of a process")
def test_an_asset_without_room_is_told_and_the_others_are_labelled(tmp_path: Path) -> None:
    project = begun(tmp_path, 3)
    monster = "".join(f"v {k} 0 0\n" for k in range(2_000_000)) + "f 1 2 3\n"
    (tmp_path / "assets/t0a.obj").write_text(monster)
    (tmp_path / "assets/t0a.labels.json").write_text('{"hulls": {"top": "top"}}')
    project = Project.open(project.folder)
    for way, others in (("names", ["t1.obj", "t2.obj"]), ("file", ["t1.obj"]), ("propagate", ["t2.obj"])):
        reports = {report.asset: report for report in WAYS[way](project, ExecutionOptions(1, memory=200 * MIB))}
        assert reports["t0a.obj"].problems[0].startswith(f"{tmp_path / 'assets/t0a.obj'}: there is not enough memory")
        assert all(reports[asset].taken and not reports[asset].problems for asset in others)


@pytest.mark.slow
def test_each_asset_is_told_in_order_when_its_labels_are_there(tmp_path: Path) -> None:
    project, told = begun(tmp_path), list[str]()

    def report(labelled: LabelOutcome) -> None:
        told.append(labelled.asset)
        there = [asset for asset in project.assets() if project.layout.labels(asset).exists()]
        assert there == sorted({"t0.obj", *told})

    project.label("names", execution=ExecutionOptions(2), report=report)
    assert told == list(project.assets())
    shutil.rmtree(project.folder)
    told.clear()
    begun(tmp_path).label("propagate", execution=ExecutionOptions(2), report=report)
    assert told == list(project.assets())


@needs_fork
@pytest.mark.parametrize("way", WAYS)
def test_whenever_it_is_killed_labels_are_whole_and_another_run_completes_them(tmp_path: Path, way: str) -> None:
    project = begun(tmp_path / "whole")
    before = tree(project.folder / "labels")
    WAYS[way](project, IN_PROCESS)
    whole = tree(project.folder / "labels")
    project, died = begun(tmp_path / "killed"), 0
    for _ in deaths(lambda: WAYS[way](project, IN_PROCESS)):
        died += 1
        left = {name: data for name, data in tree(project.folder / "labels").items() if not name.endswith(".tmp")}
        assert before.items() <= left.items() and left.items() <= whole.items()
    assert died >= len(whole) - len(before) > 0
    assert {name: data for name, data in tree(project.folder / "labels").items() if not name.endswith(".tmp")} == whole


def test_only_assets_that_changed_are_described_again(tmp_path: Path) -> None:
    project = begun(tmp_path)
    project.label("propagate")
    kept, labels = sorted((project.layout.sketches / "seen").iterdir()), tree(project.folder / "labels")
    assert [path.name for path in kept] == [f"{asset}.npz" for asset in project.assets()]
    times = [file_state(path) for path in kept]
    project.label("propagate")
    assert [file_state(path) for path in kept] == times
    kept[1].write_bytes(kept[1].read_bytes()[:200])
    kept[2].write_bytes(b"")
    project.label("propagate")
    now = [file_state(path) for path in kept]
    assert [a == b for a, b in zip(now, times, strict=True)] == [True, False, False, True]
    assert tree(project.folder / "labels") == labels
    write_table(tmp_path / "assets/t3.obj", height=2.0, labels=False)
    project.label("propagate")
    assert file_state(kept[0]) == times[0] and file_state(kept[3]) != times[3]
