"""The names of hulls that follow from those of nodes."""

from __future__ import annotations

from collections.abc import Sequence

from meshforge.asset import unique_names


def hull_names(sources: Sequence[tuple[str | None, str | None, int]]) -> list[tuple[str, ...]]:
    """The names of the pieces of collision sources; of each its body, its own name, and how many pieces it has.

    `body/name`, without body for None; `geomK` for the K-th source of a body where it has no name; `#k` for one of
    several pieces.
    """
    count: dict[str | None, int] = {}
    bases = []
    for body, name, _ in sources:
        base = name or f"geom{count.get(body, 0)}"
        bases.append(base if body is None else f"{body}/{base}")
        count[body] = count.get(body, 0) + 1
    each = [
        [base] if pieces == 1 else [f"{base}#{k}" for k in range(pieces)]
        for base, (_, _, pieces) in zip(unique_names(bases), sources, strict=True)
    ]
    unique = iter(unique_names(name for names in each for name in names))
    return [tuple(next(unique) for _ in names) for names in each]
