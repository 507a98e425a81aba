"""One part of what is measured of an output: its figures and findings beside those of the asset."""

from __future__ import annotations

from collections.abc import Iterable

from meshforge.checks import ENGINES, Examination, Finding, Measures, check, examine_mesh
from meshforge.studio.checking.figures import clearance_figures, fit_figures, physics_figures
from meshforge.studio.checking.pair import Pair
from meshforge.studio.wire.checks import Checked, CheckFinding, Figure, Part
from meshforge.symbolic import SymbolicMesh

_OF = {"fit": ("fit-", "shape-"), "clearance": ("clearance-",), "physics": ("physics-",)}
MEASURES = {"fit": Measures(fit=True), "clearance": Measures(clearance=True), "physics": Measures(physics=True)}
"""What the costly parts measure; as `meshforge check` does with the option of that name."""


def measured(pair: Pair, part: Part) -> Checked:
    """What is measured of an output; the same as `meshforge check OUTPUT --against ASSET` tells."""
    match part:
        case "engines":
            return _limits(pair)
        case "fit":
            was, now = _both(pair, part)
            cell = now.fit.cell if now.fit and now.fit.hulls else None
            return _checked(part, was.findings, now, fit_figures(was, now), cell)
        case "clearance":
            was, now = _both(pair, part)
            space = now.clearance or now.changed
            return _checked(part, was.findings, now, clearance_figures(was, now), space.cell if space else None)
        case "physics":
            now = examine_mesh(pair.after, MEASURES[part], pair.before)
            earlier = now.earlier.findings if now.earlier else ()
            return _checked(part, earlier, now, physics_figures(now), None)


def _both(pair: Pair, part: Part) -> tuple[Examination, Examination]:
    return examine_mesh(pair.before, MEASURES[part]), examine_mesh(pair.after, MEASURES[part], pair.before)


def _checked(
    part: Part, before: Iterable[Finding], now: Examination, rows: Iterable[Figure], cell: float | None
) -> Checked:
    figures = tuple(rows)
    found = [f for f in now.findings if f.rule.startswith(_OF[part])]
    old = [f for f in before if f.rule.startswith(_OF[part])]
    by_edit = now.changed.findings if now.changed else ()
    return Checked(
        part=part,
        figures=figures,
        findings=tuple(_row(f, None, f in by_edit or not _known(f, old)) for f in found),
        gone=_gone(old, found),
        notes=(*now.notes, *_unsimulated(now)),
        cell=cell,
        pictured=cell is not None,
    )


def _limits(pair: Pair) -> Checked:
    """What is not legal, and what is beyond the limits of each engine."""
    rows = []
    for engine in (None, *ENGINES):
        known = _of_engine(pair.before, engine)
        rows += [_row(f, engine, not _known(f, known)) for f in _of_engine(pair.after, engine)]
    return Checked(part="engines", findings=tuple(rows))


def _of_engine(mesh: SymbolicMesh, engine: str | None) -> list[Finding]:
    """The limits that are not kept to; of no engine, what is not legal."""
    return [found for found in check(mesh, engine) if engine is None or found.rule.startswith(f"{engine}-")]


def _unsimulated(now: Examination) -> tuple[str, ...]:
    """Why there is no rest to tell of."""
    rows = (("", now.physics), ("before the edit ", now.earlier))
    return tuple(f"{when}{p.description}" for when, p in rows if p and p.rest is None)


def _row(found: Finding, engine: str | None, new: bool) -> CheckFinding:
    return CheckFinding(
        rule=found.rule,
        severity=found.severity,
        engine=engine,
        new=new,
        hulls=found.hulls,
        text=found.message,
        remedy=found.remedy,
    )


def _known(found: Finding, before: Iterable[Finding]) -> bool:
    """Whether the same was to be said of the same hulls before, or of more."""
    return any(old.rule == found.rule and set(found.hulls) <= set(old.hulls) for old in before)


def _gone(before: Iterable[Finding], now: Iterable[Finding]) -> int:
    """How many rules that did not hold before do so now."""
    return len({found.rule for found in before} - {found.rule for found in now})
