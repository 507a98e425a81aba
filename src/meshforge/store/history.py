"""Records changes of a project's files, undoes and redoes them. A kill at any moment leaves the state before or after,
never one between, once the history is used again: a change is noted before it begins, and an entry when it is done."""

import hashlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from threading import RLock
from typing import Any, Literal, NamedTuple, Self, assert_never

from meshforge.batch import hold_lock
from meshforge.common import MeshForgeError, ProjectError, relative_name
from meshforge.store.history_entries import (
    BlobStore,
    EntryFiles,
    FileState,
    HistoryEntry,
    PendingEntry,
    Snapshots,
    count_group,
    diff_states,
)
from meshforge.store.layout import Layout, identify_file

_RECORDED: ContextVar[frozenset[Path]] = ContextVar("recorded", default=frozenset())
"""The folders of projects of which a change is being recorded here: what is changed meanwhile is part of it."""


class NotHereError(ProjectError):
    """There is no such thing in the project."""


class ConflictError(ProjectError):
    """Something else changed first: another page, a command in a terminal or an editor. Nothing was written."""


@dataclass(frozen=True, slots=True)
class HistoryState:
    """The titles of what can be undone and redone next, None for nothing, and how much can be."""

    undo: str | None
    redo: str | None
    undoable: int
    redoable: int


@dataclass(frozen=True, slots=True)
class HistoryAct:
    """What is undone at once. title, at: of the last of its changes, and when it was, as ISO 8601; changes: how many it
    has; done: how many changes of the project are done after it."""

    title: str
    at: str
    changes: int
    done: int


@dataclass(frozen=True, slots=True)
class FileConflict:
    """A file that is not as a change left it. by: the title of the later entry that changed it, where one did."""

    name: str
    by: str | None

    def __str__(self) -> str:
        return f"{self.name} was changed since, by {f'“{self.by}”' if self.by else 'something else'}"


class Recovery(NamedTuple):
    """A change that a kill had cut short; is_done: whether it is made now, or was taken back."""

    entry: HistoryEntry
    is_done: bool


class History:
    """The history of a project, in its folder. derived: gives the names of files, as in `Layout`, that follow from
    others: undo and redo overwrite them even if they have changed since."""

    def __init__(self, folder: Path, derived: Callable[[], frozenset[str]] = frozenset) -> None:
        layout = Layout(folder)
        self._folder, self._lock_file = folder, layout.lock
        self._mutex = RLock()
        self._files = EntryFiles(layout.history)
        self._derived = derived
        self._snapshots = Snapshots(folder, BlobStore(layout.history / "blobs"))

    @classmethod
    def open(cls, folder: Path, derived: Callable[[], frozenset[str]] = frozenset) -> Self:
        """Return the history of a project, with what a kill left under way brought to an end, and without contents that
        no entry mentions."""
        history = cls(folder, derived)
        with history._lock():
            history.recover()
            wanted = {digest for entry in history._files.entries for digest in entry.digests}
            history._snapshots.blobs.prune(wanted)
        return history

    def _lock(self) -> AbstractContextManager[None]:
        return hold_lock(self._lock_file, str(self._folder), again=True)

    @property
    def state(self) -> HistoryState:
        """What can be undone and redone next."""
        with self._mutex:
            at, entries = self._files.position, self._files.entries
            return HistoryState(
                undo=entries[at - 1].title if at else None,
                redo=entries[at].title if at < len(entries) else None,
                undoable=at,
                redoable=len(entries) - at,
            )

    @property
    def entries(self) -> tuple[HistoryEntry, ...]:
        """The changes that were made and not undone, the first one first."""
        with self._mutex:
            return tuple(self._files.entries[: self._files.position])

    def list_acts(self, most: int) -> tuple[HistoryAct, ...]:
        """Return the acts around the present state, those undone too, the first one first: so many on each side."""
        with self._mutex:
            entries, at, acts = self._files.entries, self._files.position, list[HistoryAct]()
            done = 0
            while done < len(entries):
                changes = count_group(entries, done, 1)
                done += changes
                acts.append(HistoryAct(entries[done - 1].title, entries[done - 1].at, changes, done))
        here = sum(act.done <= at for act in acts)
        return tuple(acts[max(0, here - most) : here + most])

    @property
    def interrupted(self) -> tuple[str, ...]:
        """The paths that a change under way may write: of one that a kill cut short, or that a process makes now."""
        pending = self._files.read_pending()
        return pending.touches if pending else ()

    def refresh(self) -> bool:
        """See whether another process, as `meshforge label`, made changes; whether it did."""
        with self._mutex:
            return self._files.refresh()

    def path_of(self, digest: str) -> Path:
        """Return a file with the content of that digest. There is none where the history was damaged from outside."""
        return self._snapshots.blobs.path_of(digest)

    def read_contents(self, state: FileState) -> dict[Path, bytes | None]:
        """Return the contents of files in a state, by path; None for no file. Raises ProjectError where one is lost."""
        places = {self._folder / name: digest for name, digest in state.items()}
        return {
            path: None if digest is None else self._snapshots.blobs.read(digest, path)
            for path, digest in places.items()
        }

    @contextmanager
    def record(
        self,
        title: str,
        edit: dict[str, Any],
        paths: Iterable[Path],
        *,
        by: str | None = None,
        group: str | None = None,
        written: Mapping[str, tuple[str | None, ...]] | None = None,
    ) -> Iterator[int]:
        """Record a change of files and folders that is made within the block; an error in it takes the change back.

        Gives how many entries were done before. Within another such block it is part of that one's change.

        written: the digests of all that each file may contain meanwhile, where that is known: a kill takes the change
        back then, where without it what is done by then is an entry.
        """
        with self._mutex, self._lock():
            if self._folder in _RECORDED.get():
                yield self._files.position
                return
            self.recover()
            paths = tuple(paths)
            before = self._snapshots.take(paths)
            now = datetime.now(UTC).isoformat(timespec="seconds")
            entry = HistoryEntry(title=title, edit=edit, before=before, after={}, at=now, by=by, group=group)
            pending = PendingEntry(
                what="do" if written is None else "write",
                number=self._files.position + 1,
                entry=entry,
                touches=tuple(relative_name(path, self._folder) for path in paths),
                written=dict(written or {}),
            )
            self._files.begin(pending)
            token = _RECORDED.set(_RECORDED.get() | {self._folder})
            try:
                yield self._files.position
            except BaseException:
                self._roll_back(before, paths)
                raise
            finally:
                _RECORDED.reset(token)
            self._finish(pending)

    def write(self, title: str, edit: dict[str, Any], writes: Sequence[tuple[Path, bytes | None]]) -> None:
        """Write files, in this order, as one change; None removes one. A file may be written twice, so that what is
        read meanwhile fits together. What a kill cuts short is taken back when the history is used next."""
        written: dict[str, tuple[str | None, ...]] = {}
        for path, content in writes:
            name = relative_name(path, self._folder)
            digest = None if content is None else hashlib.blake2b(content, digest_size=16).hexdigest()
            written[name] = (*written.get(name, ()), digest)
        with self.record(title, edit, dict(writes), written=written):
            for path, content in writes:
                self._snapshots.write(path, content)

    def undo(self) -> tuple[HistoryEntry, ...]:
        """Put back what files were before the last change, or before all changes of its group.

        Raises ConflictError, nothing changed, where something else changed a file since.
        """
        return self._move("undo")

    def redo(self) -> tuple[HistoryEntry, ...]:
        """Put back what files were after the last change that was undone, or all of its group. Raises as `undo`."""
        return self._move("redo")

    def find_before(self, entries: Sequence[HistoryEntry]) -> tuple[FileState, tuple[FileConflict, ...]]:
        """Return what files were before some entries, the last one first: the state of those that are as these left
        them, and the others."""
        names = {name for entry in entries for name in entry.names}
        state, changed = self._snapshots.read_state(names), dict[str, FileConflict]()
        for entry in entries:
            for name, digest in entry.after.items():
                if name not in changed and state[name] != digest:
                    changed[name] = FileConflict(name, self._find_last_change(name, entry))
                state[name] = entry.before[name]
        return {name: state[name] for name in sorted(names - changed.keys())}, tuple(changed.values())

    def _find_last_change(self, name: str, entry: HistoryEntry) -> str | None:
        """The title of the last entry that changed a file, None where something else did so after it."""
        last = next((one for one in reversed(self.entries) if name in one.before), None)
        now = self._snapshots.read_state([name])[name]
        return last.title if last and last is not entry and last.after[name] == now else None

    def _move(self, what: Literal["undo", "redo"]) -> tuple[HistoryEntry, ...]:
        with self._mutex, self._lock():
            self.recover()
            entries, way = self._files.entries, -1 if what == "undo" else 1
            first = self._files.position + min(way, 0)
            if not 0 <= first < len(entries):
                return ()
            places = range(first, first + way * count_group(entries, first, way), way)
            for k in places:
                self._shift(PendingEntry(what=what, number=k + 1, entry=entries[k]))
            return tuple(entries[k] for k in places)

    def _shift(self, pending: PendingEntry) -> None:
        entry, undo = pending.entry, pending.what == "undo"
        wanted, other = (entry.before, entry.after) if undo else (entry.after, entry.before)
        now = self._snapshots.read_state(wanted)
        derived = self._derived()
        for name, digest in now.items():
            known = identify_file(name)
            if digest not in (wanted[name], other[name]) and not derived & {name, known[0].name if known else name}:
                raise ConflictError(
                    str(FileConflict(name, None)),
                    where=str(self._folder / name),
                    remedy=f"“{entry.title}” can no longer be {'undone' if undo else 'redone'}; nothing was changed.",
                )
        self._files.begin(pending)
        self._snapshots.restore(wanted, now)
        self._files.set_position(pending.number - 1 if undo else pending.number)
        self._files.end()

    def recover(self) -> Recovery | None:
        """Bring to an end what a kill left under way, under the lock that the caller holds; None where nothing was."""
        if self._folder in _RECORDED.get():
            return None
        self._files.refresh()
        pending = self._files.read_pending()
        if pending is None:
            return None
        is_done = pending.what != "write" or self._files.position >= pending.number
        match pending.what:
            case "do":
                self._finish(pending)
            case "write" if is_done:
                self._files.end()
            case "write":
                self._take_back(pending)
            case "undo" | "redo":
                try:
                    self._shift(pending)
                except MeshForgeError:  # something else changed the file meanwhile: its change stays
                    self._files.end()
            case other:
                assert_never(other)
        return Recovery(pending.entry, is_done)

    def _take_back(self, pending: PendingEntry) -> None:
        """Restore the files that are as the change wrote them; those that something else changed meanwhile stay."""
        now = self._snapshots.read_state(pending.written)
        own = [name for name, digests in pending.written.items() if now[name] in digests]
        self._snapshots.restore({name: pending.entry.before.get(name) for name in own}, now)
        self._files.end()

    def _finish(self, pending: PendingEntry) -> None:
        after = self._snapshots.take(self._folder / name for name in pending.touches)
        changed = diff_states(pending.entry.before, after)
        if changed[0]:
            entry = pending.entry.model_copy(update={"before": changed[0], "after": changed[1]})
            self._files.put(pending.number, entry)
            self._files.set_position(pending.number)
        self._files.end()

    def _roll_back(self, before: FileState, paths: Sequence[Path]) -> None:
        now = self._snapshots.take(paths)
        wanted, _ = diff_states(before, now)
        self._snapshots.restore(wanted, {name: now.get(name) for name in wanted})
        self._files.end()
