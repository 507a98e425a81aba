"""The assets that came to a project after the others were prepared, as the page names them."""

from __future__ import annotations

from collections.abc import Iterable

from meshforge.common import FileState, MeshForgeError, file_state
from meshforge.project import Project, list_new
from meshforge.studio.wire.family import Card, NewAssetsView

_Basis = tuple[FileState | None, tuple[str, ...], tuple[tuple[str, tuple[str, ...]], ...]]


class NewAssetsQuery:
    """Which assets a run prepares first. All preparations are read for that, so it is asked again only where the
    project's file about it, its assets, or what was done to one of them is another."""

    def __init__(self) -> None:
        self._basis: _Basis | None = None
        self._found: tuple[NewAssetsView | None, str | None] = None, None

    def find(self, project: Project, cards: Iterable[Card]) -> tuple[NewAssetsView | None, str | None]:
        """The new assets, None where there are none; and why they are not known, where a file is damaged."""
        done = tuple((card.asset, card.prepared) for card in cards if card.prepared)
        basis = file_state(project.layout.preparation_plan), project.assets(), done
        if basis != self._basis:
            self._basis, self._found = basis, _find(project)
        return self._found


def _find(project: Project) -> tuple[NewAssetsView | None, str | None]:
    try:
        new, unclear = list_new(project)
    except MeshForgeError as error:
        return None, error.message
    if not new and not unclear:
        return None, None
    plans = [one.plan.rebuild for one in new if one.plan.rebuild]
    ids = tuple(one.id for one in new)
    if not plans:
        return NewAssetsView(ids=ids, unclear=unclear), None
    least = plans[0].min_confidence
    return NewAssetsView(ids=ids, rebuilt=len(plans), min_confidence=least, unclear=unclear), None
