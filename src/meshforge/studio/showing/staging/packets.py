"""Packets of edited assets: all hulls there are then, with the shapes that the asset as it comes has not."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from meshforge.checks import Finding, check
from meshforge.geometry import digest
from meshforge.studio.showing.shapes import contact_names, hull_rows, hull_views, shapes_packet
from meshforge.studio.wire.asset import EditedHeader, FindingView, TraceLine
from meshforge.symbolic import Hull, SymbolicMesh


@dataclass(frozen=True, eq=False, slots=True)
class Told:
    """What is told of an edit besides its hulls; the fields are those of `EditedHeader`."""

    note: str | None = None
    trace: tuple[TraceLine, ...] = ()
    findings: tuple[FindingView, ...] = ()
    flags: tuple[str, ...] = ()


def edited_packet(
    source: SymbolicMesh, before: SymbolicMesh, after: SymbolicMesh, told: Told, seen: SymbolicMesh | None = None
) -> bytes:
    """The packet of an edited asset. source: the asset as it comes; before, after: the edit, in the same frame.

    seen: `after` in the canonical frame, where that is at hand: what is in contact there is known already.
    """
    rows = hull_rows(hull for hull in after.hulls if not _known(source, hull))
    header = EditedHeader(
        rows=tuple(row for row, _ in rows),
        hulls=hull_views(after),
        made=_missing(after, before),
        removed=_missing(before, after),
        note=told.note,
        trace=told.trace,
        findings=told.findings,
        flags=told.flags,
        volume=(_volume(before), _volume(after)),
        contacts=contact_names(seen or after),
    )
    return shapes_packet(header, rows)


def findings_of_made(before: SymbolicMesh, after: SymbolicMesh) -> tuple[FindingView, ...]:
    """What the check of legality says about the hulls that an edit made."""
    made = replace(after, hulls=tuple(hull for hull in after.hulls if hull.name not in before.index))
    return finding_views(found for found in check(made) if found.rule != "opaque")


def finding_views(findings: Iterable[Finding]) -> tuple[FindingView, ...]:
    """Findings, one for each hull that they name."""
    return tuple(
        FindingView(severity=found.severity, text=f"{found.message}. {found.remedy}", hull=hull)
        for found in findings
        for hull in found.hulls or (None,)
    )


def _known(source: SymbolicMesh, hull: Hull) -> bool:
    """Whether the asset has a hull of that name and shape."""
    if hull.name not in source.index:
        return False
    mine = source.hull_of(hull.name).shape
    return mine is hull.shape or digest(mine) == digest(hull.shape)


def _missing(mesh: SymbolicMesh, other: SymbolicMesh) -> tuple[str, ...]:
    """The names of hulls that another mesh has not."""
    return tuple(hull.name for hull in mesh.hulls if hull.name not in other.index)


def _volume(mesh: SymbolicMesh) -> float:
    return sum(hull.volume for hull in mesh.hulls)
