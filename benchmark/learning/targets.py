"""What people want selected, family by family, as extractors that the learner does not see."""

from __future__ import annotations

from meshforge.language import Extractor, Program

_TEXTS: dict[str, tuple[str, ...]] = {
    "table": (
        "Is(misc)",
        "Is(leg)",
        "Is(handle)",
        "Geo(Is(panel), +Z)",
        "Geo(Is(leg), -Z)",
        "Attach(Is(handle), Is(drawer))",
        "Attach(Is(leg), Is(panel))",
        "Union(Is(leg), Is(pad))",
        "Union(Is(handle), Is(drawer))",
        "Diff(Is(panel), Geo(Is(panel), +Z))",
        "Diff(Is(drawer), Geo(Is(drawer), -Z))",
        "Diff(Is(leg), Attach(Is(leg), Is(panel)))",
        "Diff(Is(handle), Attach(Is(handle), Is(drawer)))",
        "Diff(Is(drawer), Attach(Is(drawer), Is(handle)))",
        "Intersect(Geo(Is(leg), -Z), Attach(Is(leg), Is(bar)))",
        "Diff(Attach(Is(drawer), Is(handle)), Geo(Is(drawer), -Z))",
        "Union(Geo(Is(leg), -Z), Is(pad))",
    ),
    "cabinet": (
        "Is(door)",
        "Is(shelf)",
        "Geo(Is(frame), +Z)",
        "Geo(Is(foot), -Z)",
        "Attach(Is(handle), Is(door))",
        "Attach(Is(handle), Is(drawer))",
        "Union(Is(door), Is(drawer))",
        "Union(Is(foot), Is(plate))",
        "Diff(Is(frame), Geo(Is(frame), -Z))",
        "Diff(Is(door), Attach(Is(door), Is(handle)))",
        "Diff(Is(frame), Attach(Is(frame), Is(foot)))",
        "Intersect(Attach(Is(frame), Is(shelf)), Geo(Is(frame), +Y))",
        "Diff(Attach(Is(frame), Is(door)), Geo(Is(frame), -Z))",
    ),
    "lamp": (
        "Is(base)",
        "Is(cord)",
        "Geo(Is(base), -Z)",
        "Geo(Is(pole), +Z)",
        "Attach(Is(pole), Is(base))",
        "Attach(Is(cord), Is(base))",
        "Union(Is(base), Is(pole))",
        "Union(Is(cord), Is(switch))",
        "Diff(Is(pole), Attach(Is(pole), Is(base)))",
        "Diff(Is(base), Attach(Is(base), Is(pole)))",
        "Diff(Is(shade), Geo(Is(shade), -Z))",
        "Intersect(Attach(Is(shade), Is(shade)), Geo(Is(shade), +Z))",
    ),
    "cup": (
        "Is(base)",
        "Is(handle)",
        "Geo(Is(wall), +Z)",
        "Geo(Is(base), -Z)",
        "Attach(Is(handle), Is(wall))",
        "Attach(Is(wall), Is(base))",
        "Union(Is(base), Is(saucer))",
        "Union(Is(lid), Is(misc))",
        "Diff(Is(handle), Attach(Is(handle), Is(wall)))",
        "Diff(Is(wall), Attach(Is(wall), Is(handle)))",
        "Diff(Is(wall), Geo(Is(wall), +Z))",
        "Diff(Attach(Is(wall), Is(base)), Attach(Is(wall), Is(handle)))",
    ),
}


def extractors_of(family: str) -> tuple[Extractor, ...]:
    """The extractors of a family, the smaller ones first."""
    return tuple(Program.parse(f"{text} => Delete").rules[0].extractor for text in _TEXTS[family])
