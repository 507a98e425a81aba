"""A project of racks that lie differently in their files, so that a rule which asks for the highest boards fails."""

import json
from pathlib import Path

from meshforge.language import Delete
from meshforge.project import Project
from meshforge.synthesis import Step
from tests.synthesis_boxes import rack, turned
from tests.unit.batch.families import obj


def racks_on_their_side(folder: Path) -> Project:
    """Six racks, every third on its side, with the topmost boards of one deleted."""
    (folder / "racks").mkdir()
    for k in range(6):
        mesh = turned(rack(0.02 * k, 1 + k % 3), "YZX" if k % 3 == 2 else "XYZ")
        boxes = {hull.name: (tuple(hull.aabb.min), tuple(hull.aabb.max)) for hull in mesh.hulls}
        (folder / f"racks/rack{k}.obj").write_text(obj(boxes))
        labels = {"vocabulary": ["panel", "leg"], "hulls": {hull.name: hull.label for hull in mesh.hulls}}
        (folder / f"racks/rack{k}.labels.json").write_text(json.dumps(labels))
    project = Project.create(folder / "project", [folder / "racks"])
    project.label("file")
    project.demonstrate("rack1.obj", [Step(1, {"top_0", "top_1"}, Delete())])
    return project
