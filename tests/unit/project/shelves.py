"""A family of little racks about which two demonstrations leave something open, and one with a wrong label."""

import json
from pathlib import Path

from meshforge.language import Delete
from meshforge.project import Project
from meshforge.synthesis import Step
from tests.unit.batch.families import Corner, obj

WORDS = ("board", "leg", "knob")
PLAIN, OTHER, SHELVED = "rack0.obj", "rack1.obj", "rack2.obj"


def boxes(number: int) -> dict[str, tuple[Corner, Corner]]:
    """A board on two legs; in the third and the fourth rack there is a shelf between them. A knob on the left leg."""
    height = 1.0 + number / 8
    found: dict[str, tuple[Corner, Corner]] = {
        "top": ((0, 0, height), (2, 1, height + 0.1)),
        "left": ((0, 0, 0), (0.1, 1, height)),
        "right": ((1.9, 0, 0), (2, 1, height)),
        "knob": ((-0.1, 0.4, height / 2), (0, 0.6, height / 2 + 0.2)),
    }
    return found | {"shelf": ((0.1, 0, height / 4), (1.9, 1, height / 4 + 0.1))} if number in (2, 3) else found


def label_of(name: str) -> str:
    return {"top": "board", "shelf": "board", "knob": "knob"}.get(name, "leg")


def racks(folder: Path, count: int = 7, **wrong: str) -> Project:
    """A labelled project; wrong: labels of hulls of the first rack that a machine got wrong."""
    (folder / "assets").mkdir(parents=True)
    for number in range(count):
        path, given = folder / "assets" / f"rack{number}.obj", boxes(number)
        path.write_text(obj(given))
        labels = {name: label_of(name) for name in given} | (wrong if number == 0 else {})
        rows = {name: {"label": label, "source": "vlm", "confidence": 0.75} for name, label in labels.items()}
        path.with_suffix(".labels.json").write_text(json.dumps({"vocabulary": WORDS, "hulls": rows}))
    project = Project.create(folder / "racks", [folder / "assets"])
    project.label("file")
    return project


def ambiguous(folder: Path) -> Project:
    """Demonstrated on racks without a shelf: is it all boards that are deleted, or the highest?

    Only two of thirty have a shelf, so that a wrong program would likely not be seen.
    """
    project = racks(folder, 30)
    for asset in (PLAIN, OTHER):
        project.demonstrate(asset, [Step(1, {"top"}, Delete())])
    return project


def mislabelled(folder: Path) -> Project:
    """Demonstrated on three racks; the knob of the first one is labelled as a leg."""
    project = racks(folder, knob="leg")
    for asset in (PLAIN, OTHER, SHELVED):
        project.demonstrate(asset, [Step(1, {"knob"}, Delete())])
    return project
