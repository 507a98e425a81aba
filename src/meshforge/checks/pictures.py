"""Pictures of what was measured."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from meshforge.checks.clearance import Clearance
from meshforge.checks.examination import Examination
from meshforge.checks.fit import fit_pictures
from meshforge.symbolic import SymbolicMesh
from meshforge.views import volumes

if TYPE_CHECKING:
    from PIL.Image import Image

COLORS = {"closed": "#D64545", "opened": "#3B7DD8"}


def pictures(
    mesh: SymbolicMesh, found: Examination, size: tuple[int, int] = (640, 480)
) -> Iterator[tuple[str, str, Image]]:
    """A name for a file, a line of text and a picture each: heat maps of the fit, and what was closed and opened."""
    maps = fit_pictures(mesh, found.fit, size=size) if found.fit else None
    if maps and found.fit:
        yield "fit-out", f"hulls stick out by {found.fit.out:.3g} m at most", maps[0]
        yield "fit-bare", f"visual mesh, {found.fit.bare:.3g} m off all hulls at most", maps[1]
    for name, part in (("clearance", found.clearance), ("clearance-of-edit", found.changed)):
        if part and part.regions:
            yield (
                name,
                f"{part.reference}: {part.closed:.3g} l closed, {part.opened:.3g} l opened",
                _space(mesh, part, size),
            )


def _space(mesh: SymbolicMesh, found: Clearance, size: tuple[int, int]) -> Image:
    marked = [(region.kind, COLORS[region.kind], region.surface) for region in found.regions]
    return volumes(mesh, marked, size=size, title=f"space about the {found.reference}")
