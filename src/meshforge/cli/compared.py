"""Assets before and after a run, as the report shows them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from meshforge.batch import Outcome, ReportAsset
    from meshforge.language import Program
    from meshforge.symbolic import SymbolicMesh


def compared(
    outcomes: Sequence[Outcome],
    program: Program,
    mesh: Callable[[str], SymbolicMesh],
    demonstrated: Collection[str] = (),
) -> Iterator[ReportAsset]:
    """Each asset before and after, standing upright where the program orients it; mesh: gives one by its id."""
    from meshforge.batch import Failed, ReportAsset, status
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
        upright, pose = stage(before, program.orient, program.contact)
        after = load(outcome.out)
        standing = replace(after, hulls=tuple(hull.moved(pose) for hull in after.hulls))
        trace = tuple(RuleTrace(line.rule, line.selected, line.made, line.note) for line in outcome.rules)
        yield ReportAsset(name, upright, standing, trace, status(outcome), demonstrated=is_shown, notes=outcome.notes)
