"""Assets before and after a run, as the report shows them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from meshforge.batch import Lost, Outcome, ReportAsset
    from meshforge.checks import Examination, Measures
    from meshforge.language import Program
    from meshforge.symbolic import SymbolicMesh

_PATIENCE = 300.0  # seconds for the checks of an asset


def compared(
    outcomes: Sequence[Outcome],
    program: Program,
    mesh: Callable[[str], SymbolicMesh],
    demonstrated: Collection[str] = (),
    measures: Measures | None = None,
) -> Iterator[ReportAsset]:
    """Each asset before and after, standing upright where the program orients it; mesh: gives one by its id.

    measures: what is measured of it after; such assets are shown as they lie, for what they show was not turned.
    """
    from meshforge.batch import Failed, ReportAsset, Spread, status
    from meshforge.formats import load
    from meshforge.language import RuleTrace, stage

    before = {outcome.asset: _read(mesh, outcome.asset) for outcome in outcomes}
    after = {o.asset: load(o.out) for o in outcomes if not isinstance(o, Failed) and before[o.asset]}
    todo = [(after[name], measures, before[name]) for name in after] if measures else []
    found = Spread(timeout=_PATIENCE).over(_examined, todo)
    for outcome in outcomes:
        name, is_shown, was = outcome.asset, outcome.asset in demonstrated, before[outcome.asset]
        if isinstance(outcome, Failed) or was is None:
            error = outcome.error if isinstance(outcome, Failed) else "it cannot be read any more"
            yield ReportAsset(name, was, status="failed", error=error, demonstrated=is_shown)
            continue
        now, checked, notes = after[name], None, outcome.notes
        if measures:
            checked, problem = _checked(next(found))
            notes = (*notes, *problem)
        else:
            was, pose = stage(was, program.orient, program.contact)
            now = replace(now, hulls=tuple(hull.moved(pose) for hull in now.hulls))
        trace = tuple(RuleTrace(line.rule, line.selected, line.made, line.note) for line in outcome.rules)
        yield ReportAsset(name, was, now, trace, status(outcome), None, is_shown, notes, checked)


def _read(mesh: Callable[[str], SymbolicMesh], asset: str) -> SymbolicMesh | None:
    """An asset; None where it cannot be read: its error is in the outcome."""
    from meshforge.errors import MeshForgeError

    try:
        return mesh(asset)
    except MeshForgeError:
        return None


def _checked(found: Examination | Lost) -> tuple[Examination | None, tuple[str, ...]]:
    """What was measured, or why it was not."""
    from meshforge.batch import Lost

    if isinstance(found, Lost):
        return None, (f"the checks did not come to an end: {found.why}",)
    return found, ()


def _examined(work: tuple[SymbolicMesh, Measures, SymbolicMesh | None]) -> Examination:
    """In a process of its own, since MuJoCo may crash."""
    from meshforge.checks import examine_mesh

    return examine_mesh(*work)
