"""Kill -9 at random moments, of a batch, of labelling and of the studio."""

from __future__ import annotations

import shutil
import signal
import time
from pathlib import Path
from random import Random
from threading import Timer

import httpx

from meshforge.project import Project
from meshforge.symbolic import read_labels
from tests.e2e.studio import opened
from tests.faults.runs import (
    begun,
    ended,
    is_part_of,
    killed,
    outputs,
    stool_family,
    table_family,
    wait_for,
    wait_until,
)

_STOOLS, _TABLES = 60, 5
_WORDS = ("panel", "leg", "handle", "drawer", "misc")


class Applying:
    """`apply` killed: every output is as before, or new, or not there, and the same command completes the rest.

    Every other time there are outputs of another program already.
    """

    title = "`apply`, killed"

    def __init__(self, folder: Path) -> None:
        stool_family(folder, _STOOLS)
        (folder / "old.mf").write_text("Is(leg) => Delete\n")
        self._folder = folder
        for program, out in (("p.mf", "whole"), ("old.mf", "old")):
            assert ended(begun(["apply", program, "assets", "--out", out], folder))[0] == 0
        self._whole, self._old = outputs(folder / "whole"), outputs(folder / "old")

    def trial(self, draw: Random) -> str:
        out = self._folder / "out"
        shutil.rmtree(out, ignore_errors=True)
        if draw.random() < 0.5:
            shutil.copytree(self._folder / "old", out)
        process = begun(words := ["apply", "p.mf", "assets", "--out", "out"], self._folder)
        wait_for(process, out, draw.randrange(_STOOLS))
        was_running = killed(process, draw.uniform(0.0, 0.05), draw)
        left = outputs(out)
        assert all(data in (self._whole.get(name), self._old.get(name)) for name, data in left.items()), "a torn file"
        assert ended(begun(words, self._folder))[0] == 0
        assert outputs(out) == self._whole, "the second run leaves something else"
        is_begun = any(self._whole[name] == data for name, data in left.items())
        return "after it was done" if not was_running else "in the midst" if is_begun else "before the first output"


class _Labelling:
    """`label` killed: what a person said stays byte for byte, files are whole, and another run completes it.

    The moment is one at random, or a little after so many assets have their labels.
    """

    way: tuple[str, ...]

    def __init__(self, folder: Path) -> None:
        table_family(folder, _TABLES)
        self._folder = folder
        project = Project.create(folder / "p", [folder / "assets"], vocabulary=_WORDS)
        self._by_hand = project.assets()[:2]
        for asset in self._by_hand:
            true = read_labels((folder / "assets" / asset).with_suffix(".labels.json")).labels
            project.set_labels(asset, {name: label.name for name, label in true.items()})
        shutil.copytree(project.folder, folder / "begun")
        began = time.monotonic()
        assert ended(begun(["label", "p", "--with", *self.way], folder))[0] == 0
        self._longest = time.monotonic() - began
        self._before, self._whole = outputs(folder / "begun/labels"), outputs(folder / "p/labels")
        self._new = _written(folder / "p/labels", self._before)

    def trial(self, draw: Random) -> str:
        project = self._folder / "p"
        shutil.rmtree(project)
        shutil.copytree(self._folder / "begun", project)
        process = begun(words := ["label", "p", "--with", *self.way], self._folder)
        if count := draw.randrange(self._new):
            wait_until(process, lambda: _written(project / "labels", self._before) >= count)
        was_running = killed(process, draw.uniform(0.0, 0.05 if count else self._longest), draw)
        left = {name: data for name, data in outputs(project / "labels").items() if not name.endswith(".tmp")}
        assert is_part_of(left, self._whole), "a labels file is neither as before nor as it should be"
        assert self._before.items() <= left.items(), "what a person said is gone"
        assert ended(begun(words, self._folder))[0] == 0
        now = {name: data for name, data in outputs(project / "labels").items() if not name.endswith(".tmp")}
        assert now == self._whole, "the second run leaves other labels"
        return "after it was done" if not was_running else "in the midst" if left != self._before else "before a label"


def _written(labels: Path, before: dict[str, bytes]) -> int:
    """How many assets have labels that they had not."""
    files = labels.rglob("*.json")
    return sum(before.get(file.relative_to(labels).as_posix()) != file.read_bytes() for file in files)


class Propagating(_Labelling):
    """Labels of two assets carried to the others."""

    title, way = "`label --with propagate`, killed", ("propagate",)


class FromFiles(_Labelling):
    """Labels of the files beside the assets."""

    title, way = "`label --with file`, killed", ("file",)


class FromNames(_Labelling):
    """Labels that the names of hulls say."""

    title, way = "`label --with names`, killed", ("names", "--pattern", "convex_0*=panel")


class Studio:
    """The studio killed while somebody labels: what it said was done is on disk, and it opens again."""

    title = "`studio`, killed while labels are given"

    def __init__(self, folder: Path) -> None:
        table_family(folder, _TABLES)
        self._folder = folder
        Project.create(folder / "p", [folder / "assets"], vocabulary=_WORDS)

    def trial(self, draw: Random) -> str:
        project = Project.open(self._folder / "p")
        hulls = {asset: [hull.name for hull in project.mesh(asset).hulls] for asset in project.assets()}
        said = {(asset, name): label.name for asset in hulls for name, label in project.labels(asset).labels.items()}
        asked, told = dict(said), dict(said)
        with opened(self._folder, project.folder) as studio:
            studio.settled()
            killing = Timer(draw.uniform(0.0, 1.5), lambda: studio.process.send_signal(signal.SIGKILL))
            killing.start()
            try:
                while True:
                    asset = draw.choice(list(hulls))
                    name, label = draw.choice(hulls[asset]), draw.choice(_WORDS)
                    asked[asset, name] = label
                    answer = studio.post("/api/edit", {"kind": "label", "hulls": {asset: [name]}, "label": label})
                    assert answer.status_code == 200, answer.text
                    told[asset, name] = label
            except httpx.TransportError:
                pass
            killing.join()
            studio.process.wait(60)
        found = {(asset, name): label.name for asset in hulls for name, label in project.labels(asset).labels.items()}
        assert found in (told, asked), "something that was said to be done is not on disk"
        return "with one in the air" if asked != told else "between two"


KILLING = (Applying, Propagating, FromFiles, FromNames, Studio)
