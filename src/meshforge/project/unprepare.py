"""Undoes what was done to an asset before the program, by the history of the project."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

from meshforge import batch
from meshforge.common import MeshForgeError, ProjectError, file_digest, quote_path, relative_name
from meshforge.labels import label_new_hulls
from meshforge.project.prepare import HullChange, PreparationResult, check_selections, edit_of, read_or_empty
from meshforge.store import ConflictError, FileConflict, History, HistoryEntry, Store
from meshforge.symbolic import Label, parse_labels_text

_FINISHED = "what a process had left half done, since it was killed, was taken back"


def unprepare(store: Store, asset: str, *, everything: bool = False) -> PreparationResult:
    """Undo the last thing that was done to an asset before the program, or everything.

    What a process that was killed had left half done is the last thing. Everything also of an asset that is gone or
    cannot be read; files that something else changed since stay as they are then. Labels that were changed since follow
    the hulls. Raises ProjectError where nothing was done, ConflictError where something else changed a file since that
    names hulls.
    """
    folder = store.layout.preparation(asset)
    if asset not in store.layout.preparation.ids:
        store.path(asset)
    with store.lock():
        history = History(store.folder)
        half = history.recover()
        is_finished = half and half.entry.edit == edit_of("unprepare" if half.is_done else "prepare", asset)
        if is_finished and not (everything and batch.record_digest(folder)):
            return PreparationResult(asset, undone=(_FINISHED,))
        if batch.record_digest(folder) is None:
            raise ProjectError("nothing was done to it that could be taken back", where=asset)
        check_selections(store, asset)
        before = read_or_empty(folder) if everything else batch.read_preparation(folder) or batch.Preparation()
        snapshot = _find_snapshot(store, asset, history, before, everything)
        if snapshot.conflicts and not everything:
            again = f"meshforge prepare {quote_path(store.folder)} {asset} --remove"
            remedy = f"Undo that first. Or undo all that was done to it, which leaves such files as they are: {again}"
            raise ConflictError("; ".join(map(str, snapshot.conflicts)), where=asset, remedy=remedy)
        notes = _restore(store, asset, history, snapshot)
    undone = tuple(map(str, before.steps[len(snapshot.preparation.steps) :]))
    return PreparationResult(asset, undone=undone or ("what was kept, which was damaged",), notes=notes)


@dataclass(frozen=True, eq=False, slots=True)
class _Snapshot:
    """What was there before something was done to an asset. preparation: what was done until then; files: the contents
    of files that nothing else changed since, None for no file; conflicts: other files that name hulls; labels: the
    contents of the labels file before and after it, where something else changed it since."""

    preparation: batch.Preparation
    files: Mapping[Path, bytes | None] = field(default_factory=dict)
    conflicts: tuple[FileConflict, ...] = ()
    labels: tuple[bytes, bytes] | None = None


def _find_snapshot(
    store: Store, asset: str, history: History, before: batch.Preparation, everything: bool
) -> _Snapshot:
    """What the history keeps of before the last thing that was done, or before everything; only the preparation where
    it keeps nothing, as in the copy of a project."""
    shorter = before.with_only(() if everything else before.steps[:-1])
    entries = _list_entries(store, asset, history, everything)
    try:
        return _read_snapshot(store, asset, history, entries, everything) if entries else _Snapshot(shorter)
    except MeshForgeError:  # the history was damaged from outside
        return _Snapshot(shorter)


def _list_entries(store: Store, asset: str, history: History, everything: bool) -> list[HistoryEntry]:
    """The entries that led to the preparation as it is, the last one first: one, or all of them; none where the history
    does not have them."""
    path, found = store.layout.preparation(asset) / batch.RECORD_FILE, list[HistoryEntry]()
    name, digest = relative_name(path, store.folder), file_digest(path) if path.is_file() else None
    for entry in reversed(history.entries):
        if digest and entry.edit.get("kind") != "unprepare" and entry.after.get(name) == digest:
            found.append(entry)
            digest = entry.before[name]
            if not everything:
                return found
    return [] if digest else found


def _read_snapshot(
    store: Store, asset: str, history: History, entries: Sequence[HistoryEntry], everything: bool
) -> _Snapshot:
    """What was there before some entries, the last one first. Raises MeshForgeError where the history was damaged."""
    layout = store.layout
    state, changed = history.find_before(entries)
    files = history.read_contents(state)
    conflicts, labels = list[FileConflict](), None
    for one in changed:
        path, own = store.folder / one.name, [entry for entry in entries if one.name in entry.after]
        before, after = own[-1].before[one.name], own[0].after[one.name]
        were, became = (history.read_contents({one.name: digest})[path] or b"" for digest in (before, after))
        if path == layout.labels(asset):
            labels = were, became
        elif not path.is_relative_to(layout.preparation(asset)):
            conflicts.append(one)
    preparation = batch.Preparation() if everything else _read_preparation(layout.preparation(asset), files)
    return _Snapshot(preparation, files, tuple(conflicts), labels)


def _read_preparation(folder: Path, files: Mapping[Path, bytes | None]) -> batch.Preparation:
    now = {path: path.read_bytes() for path in folder.iterdir() if path.is_file()}
    with TemporaryDirectory() as draft:
        for path, content in {**now, **files}.items():
            if path.parent == folder and content is not None:
                (Path(draft) / path.name).write_bytes(content)
        return batch.read_preparation(Path(draft)) or batch.Preparation()


def _restore(store: Store, asset: str, history: History, snapshot: _Snapshot) -> tuple[str, ...]:
    layout, title = store.layout, f"preparation of {asset} undone"
    notes = [f"{one}, and stays as it is" for one in snapshot.conflicts]
    try:
        change = HullChange.read(store, asset, snapshot.preparation)
    except MeshForgeError as error:
        if snapshot.preparation.steps:
            raise
        writes = batch.list_preparation_writes(layout.preparation(asset), batch.Preparation())
        history.write(title, edit_of("unprepare", asset), [*writes, *snapshot.files.items()])
        stay = layout.labels(asset) not in snapshot.files and layout.labels(asset).exists()
        return (*notes, *([f"its labels stay as they are: {error.problem}"] if stay else []))
    known, reasons = _find_labels(change, snapshot.labels)
    follow = label_new_hulls(store, asset, change.old, change.mesh, known)
    change.write(title, "unprepare", follow, tuple(snapshot.files.items()))
    return (*notes, *(follow.notes if follow else ()), *reasons, *change.describe_gone())


def _find_labels(change: HullChange, labels: tuple[bytes, bytes] | None) -> tuple[dict[str, Label | None], list[str]]:
    """The labels of hulls before they were split, unless those of their parts were changed since; notes on these."""
    if labels is None:
        return {}, []
    were, became = (parse_labels_text(text.decode("utf-8", "replace")).labels for text in labels)
    now, known, notes = change.store.labels(change.asset).labels, dict[str, Label | None](), list[str]()
    for hull, parts in change.mapping_back.parts.items():
        if all(now.get(part) == became.get(part) for part in parts):
            known[hull] = were.get(hull)
        else:
            notes.append(f"{hull} gets its label from its parts, which were labelled since it was split")
    return known, notes
