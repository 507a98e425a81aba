"""Makes, undoes and redoes edits. A kill at any moment leaves the state before or after, never one between: an edit is
noted before it begins, becomes an entry when it is done, and is completed when the history is opened next."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from threading import RLock
from typing import Literal

from meshforge.batch import STATE
from meshforge.common import MeshForgeError, relative_name
from meshforge.project import Project
from meshforge.studio import history_store
from meshforge.studio.edits.base import Edit
from meshforge.studio.errors import ConflictError
from meshforge.studio.wire.family import HistoryView


class History:
    """The history of a project. derived: names of files that learning writes, too: undo and redo overwrite them even if
    they have changed since."""

    def __init__(self, project: Project, derived: Callable[[Project], frozenset[str]] = lambda _: frozenset()) -> None:
        folder = project.folder / STATE / "studio" / "history"
        self._mutex = RLock()
        self._files = history_store.EntryFiles(folder)
        self._derived = derived
        self._snapshots = history_store.Snapshots(project.folder, history_store.BlobStore(folder / "blobs"))
        with project.lock():
            self._recover(project)
            wanted = {digest for entry in self._files.entries for digest in entry.digests}
            self._snapshots.blobs.prune(wanted)

    @property
    def view(self) -> HistoryView:
        """What can be undone and redone next."""
        with self._mutex:
            at, entries = self._files.position, self._files.entries
            return HistoryView(
                undo=entries[at - 1].title if at else None,
                redo=entries[at].title if at < len(entries) else None,
                undoable=at,
                redoable=len(entries) - at,
            )

    @property
    def entries(self) -> tuple[history_store.HistoryEntry, ...]:
        """The edits that were made and not undone, the first one first."""
        with self._mutex:
            return tuple(self._files.entries[: self._files.position])

    def refresh(self) -> bool:
        """See whether another process, as `meshforge label`, made edits; whether it did."""
        with self._mutex:
            return self._files.refresh()

    def path_of(self, digest: str) -> Path:
        """A file with the content of that digest. There is none where the history was damaged from outside."""
        return self._snapshots.blobs.path_of(digest)

    @property
    def last_entry(self) -> history_store.HistoryEntry:
        """The edit that was made last."""
        with self._mutex:
            return self._files.entries[self._files.position - 1]

    def do(self, project: Project, edit: Edit, by: str | None = None) -> history_store.HistoryEntry | None:
        """Make an edit; it is on disk with its entry when this returns. None where it changed nothing."""
        with self._mutex, project.lock():
            with self.record(project, edit, by) as at:
                edit.apply(project)
            return self.last_entry if self._files.position > at else None

    @contextmanager
    def record(self, project: Project, edit: Edit, by: str | None = None, group: str | None = None) -> Iterator[int]:
        """Record an edit whose change is made within the block; an error in it takes the change back. Gives how many
        entries were done before."""
        with self._mutex, project.lock():
            self._recover(project)
            paths = edit.list_paths(project)
            before = self._snapshots.take(paths)
            now, data = datetime.now(UTC).isoformat(timespec="seconds"), edit.model_dump(mode="json")
            title = edit.describe(project)
            entry = history_store.HistoryEntry(
                title=title, edit=data, before=before, after={}, at=now, by=by, group=group
            )
            names = tuple(relative_name(path, project.folder) for path in paths)
            self._files.begin(
                history_store.PendingEntry(what="do", number=self._files.position + 1, entry=entry, touches=names)
            )
            try:
                yield self._files.position
            except BaseException:
                self._roll_back(before, paths)
                raise
            self._finish(project)

    def undo(self, project: Project) -> tuple[history_store.HistoryEntry, ...]:
        """Put back what files held before the last edit, or before all edits of its group.

        Raises ConflictError, nothing changed, where something else changed a file since.
        """
        return self._move(project, "undo")

    def redo(self, project: Project) -> tuple[history_store.HistoryEntry, ...]:
        """Put back what files held after the last edit that was undone, or after all of its group. Raises as `undo`."""
        return self._move(project, "redo")

    def _move(self, project: Project, what: Literal["undo", "redo"]) -> tuple[history_store.HistoryEntry, ...]:
        with self._mutex, project.lock():
            self._recover(project)
            entries, way = self._files.entries, -1 if what == "undo" else 1
            first = self._files.position + min(way, 0)
            if not 0 <= first < len(entries):
                return ()
            places = range(first, first + way * history_store.count_group(entries, first, way), way)
            for k in places:
                self._shift(project, history_store.PendingEntry(what=what, number=k + 1, entry=entries[k]))
            return tuple(entries[k] for k in places)

    def _shift(self, project: Project, pending: history_store.PendingEntry) -> None:
        entry, undo = pending.entry, pending.what == "undo"
        wanted, other = (entry.before, entry.after) if undo else (entry.after, entry.before)
        now = self._snapshots.read_state(wanted)
        derived = self._derived(project)
        for name, digest in now.items():
            if digest not in (wanted[name], other[name]) and name not in derived:
                raise ConflictError(
                    f"{name} was changed since, by something else",
                    where=str(project.folder / name),
                    remedy=f"“{entry.title}” can no longer be {'undone' if undo else 'redone'}; nothing was changed.",
                )
        self._files.begin(pending)
        self._snapshots.restore(wanted, now)
        self._files.set_position(pending.number - 1 if undo else pending.number)
        self._files.end()

    def _recover(self, project: Project) -> None:
        self._files.refresh()
        pending = self._files.read_pending()
        if pending is None:
            return
        if pending.what == "do":
            self._finish(project)
            return
        try:
            self._shift(project, pending)
        except MeshForgeError:  # something else changed the file meanwhile: its change stays
            self._files.end()

    def _finish(self, project: Project) -> None:
        pending = self._files.read_pending()
        if pending is None:
            return
        after = self._snapshots.take(project.folder / name for name in pending.touches)
        changed = history_store.diff_states(pending.entry.before, after)
        if changed[0]:
            entry = pending.entry.model_copy(update={"before": changed[0], "after": changed[1]})
            self._files.put(pending.number, entry)
            self._files.set_position(pending.number)
        self._files.end()

    def _roll_back(self, before: history_store.FileState, paths: Sequence[Path]) -> None:
        now = self._snapshots.take(paths)
        wanted, _ = history_store.diff_states(before, now)
        self._snapshots.restore(wanted, {name: now.get(name) for name in wanted})
        self._files.end()
