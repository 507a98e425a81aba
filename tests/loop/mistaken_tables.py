"""A family of bundled tables with labels that a machine got wrong, and what a person replies to a review of it."""

from __future__ import annotations

import shutil
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from meshforge.formats import load
from meshforge.language import Program
from meshforge.project import Project
from meshforge.samples import TABLES

SHOWN = ("table_03.obj", "table_08.obj")
OTHERS = ("table_01.obj", "table_02.obj", "table_09.obj", "table_14.obj")
MISTAKEN = {"table_02.obj": {"convex_08": "misc"}, "table_14.obj": {"convex_22": "drawer"}}
"""Labels that a machine got wrong."""
MEANT = Program.read(TABLES / "tables.mf")


def create_project(folder: Path, shown: Sequence[str] = SHOWN) -> Project:
    """A project of some tables, labelled as a model would, and demonstrated on two of them, or on others."""
    (folder / "assets").mkdir()
    for name in (*SHOWN, *OTHERS):
        shutil.copyfile(TABLES / name, folder / "assets" / name)
    project = Project.create(
        folder / "tables", [folder / "assets"], vocabulary=MEANT.labels, orient="+Z: Is(leg) -> Is(panel)"
    )
    for name in (*SHOWN, *OTHERS):
        labels: dict[str, str | None] = {hull.name: hull.label for hull in load(TABLES / name).hulls}
        project.set_labels(name, labels | MISTAKEN.get(name, {}), source="vlm", confidence=0.8)
    (project.folder / "demonstrations").mkdir()
    for name in shown:
        shutil.copyfile(TABLES / "demonstrations" / f"{name}.json", project.folder / "demonstrations" / f"{name}.json")
    shutil.copytree(TABLES / "templates", project.folder / "templates")
    return project


def label_of(asset: str, hull: str) -> str:
    return str(load(TABLES / asset).hull_of(hull).label)


def reply_to(question: dict[str, Any], project: Project) -> dict[str, Any]:
    """What a person says who knows every label and what each rule means; of a wrong result its right labels."""
    kind, choices = question["kind"], question["choices"]
    if kind in ("group", "repair"):
        true = {(one["asset"], one["hull"]): label_of(one["asset"], one["hull"]) for one in question["hulls"]}
        labels = [choice["label"] for choice in choices]
        counts = Counter(label for label in true.values() if label in labels)
        best = counts.most_common(1)[0][0] if counts else None
        odd = {f"{asset}#{hull}": label for (asset, hull), label in true.items() if label != best}
        said: dict[str, Any] = {"choice": best}
        return said | ({"exceptions": odd} if odd else {})
    if kind == "result":
        asset = question["asset"]
        right = MEANT.run(load(TABLES / asset), project.templates(MEANT.templates)).mesh
        program = project.program()
        assert program
        made = program.run(project.mesh(asset), project.templates(program.templates)).mesh
        if made.index.keys() == right.index.keys():
            return {"choice": "right"}
        hulls = project.mesh(asset).hulls
        wrong = {h.name: label_of(asset, h.name) for h in hulls if h.label != label_of(asset, h.name)}
        assert wrong, f"the program is wrong on {asset}, not its labels"
        return {"choice": "wrong", "labels": wrong}
    assert kind in ("candidate", "label", "selection")
    trace = MEANT.run(load(TABLES / question["asset"]), project.templates(MEANT.templates)).trace
    wanted = set(trace[question["rule"] - 1].selected)
    ids = [choice["id"] for choice in choices if set(choice["select"] or ()) == wanted]
    assert ids or kind != "selection", "a person selects what is meant, or did so by mistake"
    return {"choice": ids[0] if ids else None}
