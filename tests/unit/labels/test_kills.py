"""Labels survive a kill at any moment: what a person said before stays, and no file is left that cannot be read."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from time import sleep
from typing import IO

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.project import Project
from meshforge.symbolic import HUMAN_SOURCES
from tests.examples import examples
from tests.unit.batch.families import table_boxes
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
