"""Keeping what pages are shown in step with the files of a project, whoever changes them."""

from __future__ import annotations

import logging
from collections.abc import Iterable
from typing import TYPE_CHECKING

from meshforge.errors import MeshForgeError
from meshforge.project import Project, Review
from meshforge.studio.showing.programs import program_view
from meshforge.studio.showing.project import vocabulary_view
from meshforge.studio.state.changes import LEARNED, PROGRAM, changes_of
from meshforge.studio.state.watch import differing, look, looked
from meshforge.studio.wire.lesson import ProgramView

if TYPE_CHECKING:
    from meshforge.studio.state.desk import Desk

_LOG = logging.getLogger(__name__)


class Following:
    """Looks anew at what depends on files that changed. All is called by who has the desk for himself."""

    def __init__(self, desk: Desk) -> None:
        self._desk = desk
        self._stamps = look(desk.project)
        self._reviews = desk.project.reviews()

    def update(self, names: Iterable[str]) -> None:
        """Files are other now; names: paths from the project's folder."""
        desk, names = self._desk, frozenset(names)
        self._note_stamps(names)
        changes = changes_of(desk.project, names)
        if changes.settings:
            self.reopen()
        other = self.show_program() if changes.settings or changes.program else False
        if changes.learning:  # before the rest, as it takes longest
            desk.learning.restart()
        desk.pages.announce_assets(sorted(changes.assets), bool(changes.shapes))
        desk.refresh_queue.add(changes.assets, later=changes.settings)
        if changes.reviews:
            desk.refresh_queue.add(self._update_reviews())
        if other and not changes.learning:
            desk.learning.measure_reach()

    def show_program(self) -> bool:
        """Show the accepted program; whether it is another one, so that outputs may be stale."""
        desk = self._desk
        self._note_stamps((PROGRAM, LEARNED))
        other = desk.pages.set_program(_program(desk.project, desk.pages.program))
        if other:
            desk.refresh_queue.add([card.asset for card in desk.pages.cards if card.output != "none"], later=True)
            desk.pages.announce_assets(desk.project.layout.ids_with("demonstrations"), shapes=False)
        return other

    def reopen(self) -> None:
        """Look for assets that came or went; the vocabulary is shown at once, as keys have a meaning by it."""
        desk = self._desk
        desk.project = desk.project.with_assets(Project.open(desk.project.folder).found)
        desk.pages.set_vocabulary(vocabulary_view(desk.project.settings.vocabulary, desk.pages.cards))
        desk.refresh_queue.add(desk.pages.set_assets(desk.project.assets()), later=True)

    def poll(self) -> None:
        """See whether others changed something. Never raises: what cannot be read is told, and looked at again."""
        desk = self._desk
        now = look(desk.project)
        other = differing(self._stamps, now)
        self._stamps = now
        try:
            if any((desk.project.folder / name).is_dir() for name in other):
                self.reopen()
            if other:
                self.update(other)
        except MeshForgeError as error:
            desk.pages.set_problem(error.message)
        except Exception:  # the next look may succeed; the watch itself must go on
            _LOG.debug("looking at what others changed failed", exc_info=True)

    def _note_stamps(self, names: Iterable[str]) -> None:
        names = frozenset(names)
        kept = {name: at for name, at in self._stamps.items() if name not in names}
        self._stamps = kept | looked(self._desk.project.folder, names)

    def _update_reviews(self) -> list[str]:
        """The assets of which something else is said now."""
        before: dict[str, Review] = self._reviews
        self._reviews = now = self._desk.project.reviews()
        return [asset for asset in before | now if before.get(asset) != now.get(asset)]


def _program(project: Project, before: ProgramView) -> ProgramView:
    try:
        return program_view(project)
    except MeshForgeError as error:  # what it was learned from cannot be read
        return before.model_copy(update={"error": error.message})
