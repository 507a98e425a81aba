"""Assets before and after a run, as the report shows them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from meshforge.batch import Outcome, ReportAsset
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
    from meshforge.batch import Failed, Lost, ReportAsset, isolated, status
    from meshforge.errors import MeshForgeError
    from meshforge.formats import load
    from meshforge.language import RuleTrace, stage

    for outcome in outcomes:
        name, is_shown = outcome.asset, outcome.asset in demonstrated
        try:
            before = mesh(name)
        except MeshForgeError:  # its error is in the outcome
            before = None
        if isinstance(outcome, Failed) or before is None:
            error = outcome.error if isinstance(outcome, Failed) else "it cannot be read any more"
            yield ReportAsset(name, before, status="failed", error=error, demonstrated=is_shown)
            continue
        after, checked, notes = load(outcome.out), None, outcome.notes
        if measures:
            (found,) = isolated(_examined, [(after, measures, before)], workers=1, timeout=_PATIENCE)
            checked = None if isinstance(found, Lost) else found
            notes = (*notes, f"the checks did not come to an end: {found.why}") if isinstance(found, Lost) else notes
        else:
            before, pose = stage(before, program.orient, program.contact)
            after = replace(after, hulls=tuple(hull.moved(pose) for hull in after.hulls))
        trace = tuple(RuleTrace(line.rule, line.selected, line.made, line.note) for line in outcome.rules)
        yield ReportAsset(name, before, after, trace, status(outcome), None, is_shown, notes, checked)


def _examined(work: tuple[SymbolicMesh, Measures, SymbolicMesh]) -> Examination:
    """In a process of its own, since MuJoCo may crash."""
    from meshforge.checks import examine_mesh

    return examine_mesh(*work)
