"""Assets before and after a run, as the report shows them."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from meshforge.batch import Lost, Outcome, Reader, ReportAsset
    from meshforge.checks import Examination, Measures
    from meshforge.language import Program
    from meshforge.symbolic import SymbolicMesh


def compared(
    outcomes: Sequence[Outcome],
    program: Program,
    readers: Sequence[Reader],
    demonstrated: Collection[str] = (),
    measures: Measures | None = None,
) -> Iterator[ReportAsset]:
    """Each asset before and after, standing upright where the program orients it; readers: of the assets before.

    measures: what is measured of it after; such assets are shown as they lie, for what they show was not turned.
    """
    from meshforge.batch import PATIENCE, Failed, ReportAsset, Spread, read_again, status
    from meshforge.formats import load
    from meshforge.language import RuleTrace, stage

    made = [None if isinstance(outcome, Failed) else partial(load, outcome.out) for outcome in outcomes]
    meshes = read_again([*readers, *made])
    pairs = list(zip(outcomes, meshes[: len(made)], meshes[len(made) :], strict=True))
    todo = [(after, measures, before) for _, before, after in pairs if before and after] if measures else []
    found = Spread(timeout=PATIENCE).run(_examined, todo)
    for outcome, was, now in pairs:
        name, is_shown = outcome.asset, outcome.asset in demonstrated
        if isinstance(outcome, Failed) or was is None or now is None:
            error = outcome.error if isinstance(outcome, Failed) else "it cannot be read any more"
            yield ReportAsset(name, was, status="failed", error=error, demonstrated=is_shown)
            continue
        checked, notes = None, outcome.notes
        if measures:
            checked, problem = _checked(next(found))
            notes = (*notes, *problem)
        else:
            was, pose = stage(was, program.orient, program.contact)
            now = replace(now, hulls=tuple(hull.move(pose) for hull in now.hulls))
        trace = tuple(RuleTrace(line.rule, line.selected, line.made, line.note) for line in outcome.rules)
        yield ReportAsset(name, was, now, trace, status(outcome), None, is_shown, notes, checked)


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
