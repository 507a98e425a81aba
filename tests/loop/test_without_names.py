"""Families from a folder to signed off by commands, without a name being typed: chairs, and real cabinets."""

from __future__ import annotations

import json
import shutil
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from meshforge.formats import load
from meshforge.project import Project
from meshforge.signoff import THRESHOLD
from meshforge.symbolic import name_class
from tests.corpus_path import corpus
from tests.e2e.chair_family import write_chairs
from tests.unit.cli.in_process import Run

Meant = Mapping[str, tuple[frozenset[str], ...]]
"""What each rule is to take, by asset."""
MOST_REPLIES = 60


def reply_to(question: dict[str, Any], meant: Meant, project: Project) -> dict[str, Any]:
    """What a person says who sees which hulls each step should take."""
    choices = question["choices"]
    if question["kind"] in ("group", "repair"):
        true = {(one["asset"], one["hull"]): class_of(meant[one["asset"]], one["hull"]) for one in question["hulls"]}
        counts = Counter(label for label in true.values() if label in [choice["label"] for choice in choices])
        best = counts.most_common(1)[0][0] if counts else None
        odd = {f"{asset}#{hull}": label for (asset, hull), label in true.items() if label != best}
        return {"choice": best} | ({"exceptions": odd} if odd else {})
    wanted = meant[question["asset"]]
    if question["kind"] == "result":
        program = project.program()
        assert program
        done = program.run(project.mesh(question["asset"])).trace
        wrong = {str(one.rule): sorted(own) for one, own in zip(done, wanted, strict=True) if own != {*one.selected}}
        return {"choice": "wrong", "selections": wrong} if wrong else {"choice": "right"}
    rule = wanted[question["rule"] - 1]
    ids = [choice["id"] for choice in choices if frozenset(choice["select"] or ()) == rule]
    return {"choice": ids[0] if ids else None}


def class_of(wanted: Sequence[frozenset[str]], hull: str) -> str:
    return name_class([rule for rule, taken in enumerate(wanted, 1) if hull in taken])


def sign_off(run: Run, folder: str, meant: Meant) -> int:
    """Reply until nothing is asked any more, and apply what is sure; how many replies that took."""
    done = run("review", folder, "--json")
    count = 0
    while question := done.json["question"]:
        count += 1
        assert count <= MOST_REPLIES, question
        said = reply_to(question, meant, Project.open(folder))
        Path("said.json").write_text(json.dumps([{"id": question["id"], **said}]))
        done = run("review", folder, "--json", "--answers", "said.json")
    assert done.code == 0 and done.json["needs_review"] == [], done.json
    assert run("apply", folder, "--min-confidence", str(THRESHOLD), "--workers", "1").code == 0
    assert run("status", folder, "--json", "--signed-off").json["signed_off"] == len(meant)
    return count


def kept_of(name: str) -> set[str]:
    """The hulls of a result, which lies where what it refers to can lie beside it."""
    return {hull.name for hull in load(next(Path("p/edited").rglob(name))).hulls}


def show(run: Run, folder: str, asset: str, wanted: Sequence[frozenset[str]], actions: Sequence[str]) -> None:
    steps = [f"{','.join(sorted(own)) or 'nothing'} => {done}" for own, done in zip(wanted, actions, strict=True)]
    assert run("demonstrate", folder, asset, *steps).code == 0


@pytest.mark.slow
def test_chairs_lose_their_slats_and_get_whole_legs(run: Run) -> None:
    truth, _ = write_chairs(Path("chairs"))
    meant = {
        asset: tuple(frozenset(hull for hull, part in its.items() if part == wanted) for wanted in ("slat", "leg"))
        for asset, its in truth.items()
    }
    assert run("new", "p", "chairs/*.obj").code == 0
    assert "demonstrate p chair_" in run("status", "p").out
    show(run, "p", "chair_0.obj", meant["chair_0.obj"], ("Delete", "Each(Merge)"))
    learned = run("synthesize", "p")
    assert learned.code == 0 and "Is(part_a) => Delete" in learned.out
    print(f"\nchairs: {sign_off(run, 'p', meant)} replies")
    for asset, (slats, legs) in meant.items():
        assert len(kept_of(asset)) == len(truth[asset]) - len(slats) - len(legs) + 4, asset


@pytest.mark.slow
def test_real_cabinets_lose_their_level_boards(run: Run) -> None:
    source = corpus("doors_cabinets", "clvrai-furniture")
    shutil.copytree(source, "cabinets")
    meshes = {file.name: load(file) for file in sorted(Path("cabinets/objects").glob("*.xml"))}
    meant = {
        name: (frozenset(h.name for h in mesh.hulls if int(np.argmin(np.ptp(h.vertices, axis=0))) == 2),)
        for name, mesh in meshes.items()
    }
    assert run("new", "p", "cabinets/objects/*.xml").code == 0
    show(run, "p", "cabinet_akurum_0019.xml", meant["cabinet_akurum_0019.xml"], ("Delete",))
    assert run("synthesize", "p").code == 0
    print(f"\ncabinets: {sign_off(run, 'p', meant)} replies")
    for name, (level,) in meant.items():
        assert kept_of(name) == meshes[name].index.keys() - level, name
