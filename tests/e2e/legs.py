"""Small tables of a top on four equal legs, which nothing but a person can tell apart."""

from __future__ import annotations

from pathlib import Path

from meshforge.project import Project
from tests.unit.batch.families import obj

LEGS = ("leg_a", "leg_b", "leg_c", "leg_d")
HULLS = ("top", *LEGS)
WORDS = ("top", "first", "second", "third", "fourth")
LABELS = dict(zip(HULLS, WORDS, strict=True))


def four_legged(folder: Path, count: int = 4, words: tuple[str, ...] = WORDS) -> Project:
    """A project of such tables of different heights, none of which is labelled."""
    (folder / "assets").mkdir(parents=True)
    corners = ((0.0, 0.0), (1.9, 0.0), (1.9, 1.9), (0.0, 1.9))
    for k in range(count):
        height = 1.0 + 0.2 * k
        legs = {name: ((x, y, 0.0), (x + 0.1, y + 0.1, height)) for name, (x, y) in zip(LEGS, corners, strict=True)}
        boxes = {"top": ((0.0, 0.0, height), (2.0, 2.0, height + 0.1)), **legs}
        (folder / "assets" / f"t{k}.obj").write_text(obj(boxes), encoding="utf-8")
    return Project.create(folder / "project", [folder / "assets" / "*.obj"], name="tables", vocabulary=words)
