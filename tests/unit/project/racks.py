"""A project of racks whose legs are merged: on one of them, which nobody demonstrated, a person called the rail between
the legs a leg, so that they become one solid block."""

import json
from pathlib import Path

from meshforge.batch import IN_PROCESS
from meshforge.language import Each, Merge
from meshforge.project import Project
from meshforge.synthesis import Step
from tests.unit.batch.families import label_of, obj, table_boxes

LEGS = {"left_low", "left_high", "right_low", "right_high"}
PLAIN, BLOCK = [f"rack{k}/model.obj" for k in range(5)], "rack5/model.obj"


def shown_racks(folder: Path) -> Project:
    """The project, with two racks demonstrated; nothing is learned or written yet."""
    for k, asset in enumerate([*PLAIN, BLOCK]):
        boxes = table_boxes(1 + k / 8)
        boxes["rail"] = ((0.1, 0, 0), (1.9, 1, 0.1))
        del boxes["crumb"]
        path = folder / "assets" / asset
        path.parent.mkdir(parents=True)
        path.write_text(obj(boxes))
        labels = {name: "rail" if name == "rail" else label_of(name) for name in boxes}
        given = {"vocabulary": ["top", "leg", "rail"], "hulls": labels}
        path.with_suffix(".labels.json").write_text(json.dumps(given))
    project = Project.create(folder / "racks", [folder / "assets"])
    project.label("file")
    project.set_labels(BLOCK, {"rail": "leg"})
    for asset in PLAIN[:2]:
        project.demonstrate(asset, [Step(1, LEGS, Each(Merge()))])
    return project


def find_right(project: Project, asset: str) -> None:
    """Learn, write a result, and find it right."""
    project.synthesize()
    list(project.apply([asset], execution=IN_PROCESS))
    project.set_verdict(asset, "accepted")
