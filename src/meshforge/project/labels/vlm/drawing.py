"""Pictures of assets for a model, and the questions about them, made in worker processes."""

from __future__ import annotations

from collections.abc import Generator, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING

from meshforge.batch import Lost, Spread
from meshforge.errors import told
from meshforge.project.labels.labelling import digests
from meshforge.project.reading import Place, places
from meshforge.symbolic import GIVEN_SOURCES

if TYPE_CHECKING:
    from meshforge.perception.vlm import Look, Manner
    from meshforge.project.project import Project


@dataclass(frozen=True, slots=True)
class Drawn:
    """What is asked about an asset. hulls: digests by name, in order; wanted: the hulls whose labels may change.

    error: why it cannot be read or drawn.
    """

    hulls: Mapping[str, str] = field(default_factory=dict)
    wanted: tuple[str, ...] = ()
    looks: tuple[Look, ...] = ()
    error: str | None = None


def drawn(project: Project, manner: Manner, spread: Spread) -> Generator[tuple[str, Drawn], None, None]:
    """All assets of a project, in their order, as soon as they are drawn; some are drawn ahead of the others."""
    assets = project.assets()
    items = list(zip(assets, places(project, assets), strict=True))
    work = spread.run(partial(_drawn, manner), items)
    try:
        for asset, found in zip(assets, work, strict=True):
            yield asset, Drawn(error=f"{project.path(asset)}: {found.why}") if isinstance(found, Lost) else found
    finally:
        work.close()


def _drawn(manner: Manner, item: tuple[str, Place]) -> Drawn:
    from meshforge.perception.vlm import looks

    asset, place = item
    try:
        mesh = place.read_mesh()
        wanted = tuple(hull.name for hull in mesh.hulls if hull.source not in GIVEN_SOURCES)
        return Drawn(digests(mesh), wanted, tuple(looks(mesh, wanted, manner, asset)))
    except Exception as error:  # one asset that cannot be drawn must not cost the others their labels
        return Drawn(error=told(error, asset))
