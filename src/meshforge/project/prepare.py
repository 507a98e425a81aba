"""What is done to assets before the program: hulls decomposed, cut and rebuilt, with labels that follow them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from itertools import takewhile
from pathlib import Path
from typing import Any

from meshforge import batch
from meshforge.common import AssetError, MeshForgeError, ProjectError, describe_error, join_names, write_atomically
from meshforge.formats import DecomposeBy, read
from meshforge.geometry import CoacdSettings, DecomposeSettings, Shape, cache_folder, digest
from meshforge.labels import label_new_hulls
from meshforge.project import preparation_journal as journal
from meshforge.project import selections
from meshforge.project.demonstrations import find_unknown_hulls
from meshforge.project.preparation_plan import keep_decomposed
from meshforge.store import Store, hull_digests
from meshforge.symbolic import Asset, Label, SymbolicMesh

_FINISHED = "what a process had left half done, since it was killed, was taken back"


@dataclass(frozen=True, slots=True)
class PreparationResult:
    """What became of one asset.

    made: the pieces that got hulls now; notes: what that means for labels and demonstrations, and what was given up;
    problems: why a piece, or the whole asset, could not be prepared; undone: what was taken back, in words; planned:
    what `made` would be, where nothing was to be written.
    """

    asset: str
    made: tuple[batch.Replacement, ...] = ()
    notes: tuple[str, ...] = ()
    problems: tuple[str, ...] = ()
    undone: tuple[str, ...] = ()
    planned: tuple[batch.Replacement, ...] = ()

    @property
    def hulls(self) -> tuple[str, ...]:
        """The names of all hulls that were made."""
        return tuple(name for entry in self.made for name in entry.made)


def change_preparation(
    store: Store, asset: str, make: Callable[[Asset, batch.Preparation], batch.Preparation]
) -> PreparationResult:
    """Do one thing more to an asset. make: its preparation with that, of the asset as it was read and that before."""
    folder = store.layout.preparation(asset)
    seen = batch.record_digest(folder)
    before = batch.read_preparation(folder) or batch.Preparation()
    after = make(read(store.path(asset)), before)
    if after is before:
        return PreparationResult(asset, notes=("this was done already",))
    notes = exchange_preparation(store, asset, after, seen)
    added = after.steps[len(before.steps) :]
    return PreparationResult(asset, tuple(entry for step in added for entry in step.replaced), tuple(notes))


def cut(store: Store, asset: str, hull: str, at: Sequence[float], across: Sequence[float]) -> PreparationResult:
    """Cut a hull along the plane through `at` (3,) [m] across `across` (3,), in the frame that the asset comes in.

    Raises GeometryError: no such hull, or a plane that misses it.
    """
    return change_preparation(store, asset, lambda source, before: batch.cut_hull(source, before, hull, at, across))


def unprepare(store: Store, asset: str, *, everything: bool = False) -> PreparationResult:
    """Take back the last thing that was done to an asset before the program, or everything.

    Where a process was killed in doing or undoing something, the last thing is what it left half done. Everything also
    of an asset that is gone or cannot be read. Raises ProjectError where nothing was done.
    """
    if asset not in store.layout.ids_with_preparation():
        store.path(asset)
    folder = store.layout.preparation(asset)
    if _finish_undo(store, asset) and not (everything and batch.record_digest(folder)):
        return PreparationResult(asset, undone=(_FINISHED,))
    seen = batch.record_digest(folder)
    if seen is None:
        raise ProjectError("nothing was done to it that could be taken back", where=asset)
    before = _read_or_empty(folder) if everything else batch.read_preparation(folder) or batch.Preparation()
    left = 0 if everything else len(before.steps) - 1
    notes = exchange_preparation(store, asset, before.with_only(before.steps[:left]), seen)
    undone = tuple(map(str, before.steps[left:])) or ("what was kept, which was damaged",)
    return PreparationResult(asset, undone=undone, notes=tuple(notes))


def _finish_undo(store: Store, asset: str) -> bool:
    """Take back what was half done to an asset when a process was killed; whether something was."""
    folder = store.layout.preparation(asset)
    with store.lock():
        try:
            before = batch.read_preparation(folder) or batch.Preparation()
        except AssetError:  # only undoing everything helps
            return False
        if all(step.place < len(before.steps) for step in journal.read_journal(store, asset)):
            return False
        selections.check_selections(store, asset)
        if before.steps:
            batch.write_preparation(folder, before)
        else:
            batch.remove_preparation(folder)
        return journal.finish_undo(store, asset, len(before.steps))


def _read_or_empty(folder: Path) -> batch.Preparation:
    try:
        return batch.read_preparation(folder) or batch.Preparation()
    except AssetError:
        return batch.Preparation()


def exchange_preparation(
    store: Store, asset: str, after: batch.Preparation, seen: str | None, labels: Mapping[str, Label] | None = None
) -> list[str]:
    """Write a preparation in the place of the one of a known digest. Raises ProjectError where that is another now.

    labels: of new hulls by name, as what made them knows them; where a person gave the hull that they replace the
    same label, theirs is taken.
    """
    with store.lock():
        if batch.record_digest(store.layout.preparation(asset)) != seen:
            raise ProjectError("someone else has prepared it meanwhile", where=asset, remedy="Try again.")
        return _exchange(store, asset, after, labels or {})


def _hulls_before(source: Asset, folder: Path) -> dict[str, Shape]:
    """The hulls of an asset by name as they are prepared, those of an outdated preparation too.

    A hull that a step puts others in the place of is none of them, whether or not that step still fits the asset.
    """
    before = _read_or_empty(folder)
    made = {name: before.hulls[known] for name, known in before.hull_digests.items()}
    there = made | {geom.name: geom.shape for geom in batch.replay_preparation(source, before).asset.geoms}
    return {name: shape for name, shape in there.items() if name not in before.hulls_replaced}


def _exchange(store: Store, asset: str, after: batch.Preparation, labels: Mapping[str, Label]) -> list[str]:
    """Write a preparation, under the lock that the caller holds, and let labels and selections follow; notes on that.

    What selections and labels were is written first. Labels of the new hulls are written before these, selections and
    the removal of old labels after them: killed in between, labels of hulls that are not there are left, which is
    harmless, and selections of such hulls, which the status names; an undo is finished the next time.

    Raises ProjectError where a file of the project cannot be read; then nothing is written.
    """
    selections.check_selections(store, asset)
    folder = store.layout.preparation(asset)
    before = _read_or_empty(folder).steps
    notes = [_FINISHED] if journal.finish_undo(store, asset, len(before)) else []
    try:
        source = read(store.path(asset))
    except MeshForgeError as error:
        if after.steps:
            raise
        return [*notes, *_remove_unread(store, asset, error)]
    common = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(before, after.steps, strict=False)))
    is_undo = common == len(after.steps)
    change = journal.JournalChange.at(store, asset, common)
    mesh, old = SymbolicMesh.of(batch.apply_preparation(source, after)), _hulls_before(source, folder)
    were = journal.read_labels_text(store, asset)
    restored = journal.restore_labels_text(were, change.undone) if is_undo else None
    known, doubts = journal.find_labels_before(store, asset, change.undone, mesh) if is_undo else ({}, [])
    known |= labels
    follow = label_new_hulls(store, asset, old, mesh, known)
    between = journal.LabelsText(follow.format(keep_old=True)) if follow else were
    final = restored or (journal.LabelsText(follow.format(keep_old=False)) if follow else were)
    if not is_undo:
        digests = {name: digest(shape) for name, shape in old.items()}, hull_digests(mesh)
        successors = selections.Successors.between(after, *digests)
        step = journal.describe_step(store, asset, common, successors, (were, between, final))
        change = replace(change, step=step)
    change.write_before(between if restored else None)
    if follow:
        store.write_labels_files({asset: between.text})
    if after.steps:
        batch.write_preparation(folder, after)
    else:
        batch.remove_preparation(folder)
    change.exchange_selections()
    if follow or restored:
        store.write_labels_files({asset: final.text})
    change.write_after()
    notes += [*(follow.notes if follow else ()), *doubts]
    if change.step:
        notes += [f"look at it: {one}" for one in journal.describe_carried(store, asset, len(after.steps))]
    gone = sorted({name for _, name in find_unknown_hulls(store.steps(asset), mesh.index)})
    if gone:
        notes.append(f"the demonstration on it names {join_names(gone)}, which it has no more: demonstrate it anew")
    return notes


def _remove_unread(store: Store, asset: str, error: MeshForgeError) -> list[str]:
    """Remove what was done to an asset that cannot be read; a note where its labels stay."""
    batch.remove_preparation(store.layout.preparation(asset))
    labels = store.label_bytes(asset)
    journal.finish_undo(store, asset, 0)
    stay = labels and store.label_bytes(asset) == labels
    return [f"its labels stay as they are: {error.problem}"] if stay else []


@dataclass(frozen=True, slots=True)
class _DecomposeWork:
    """One asset to be decomposed; folder: of its preparation; options: those of `batch.decompose_asset`; pieces: the
    file that says how far it is."""

    path: Path
    folder: Path
    settings: DecomposeSettings
    options: Mapping[str, Any]
    pieces: Path | None

    def tell(self, done: int, known: int) -> None:
        """Write how many pieces are done, of how many."""
        if self.pieces:
            write_atomically(self.pieces, f"{done} {known}")


def decompose(
    store: Store,
    assets: Iterable[str] | None = None,
    settings: DecomposeSettings | None = None,
    *,
    only: Sequence[str] = (),
    again: bool = False,
    hollow: bool = False,
    by: DecomposeBy = "whole",
    execution: batch.ExecutionOptions = batch.EXECUTION_DEFAULTS,
    write_block: Callable[[str], AbstractContextManager[object]] = nullcontext,
    pieces: Path | None = None,
) -> Iterator[PreparationResult]:
    """Make hulls of what has none: non-convex pieces, and what bodies without collision geometry show.

    It is done in worker processes. assets: all when None; settings: CoACD's defaults when None; only: names of pieces
    and bodies, or patterns; again: also what is decomposed already; hollow: shells of one sheet are not filled;
    by: `parts` decomposes each group, node and material by itself, so that no hull crosses from one to another;
    write_block: the block in which an asset's files are written; pieces: a folder of files that say meanwhile how far
    each asset is, for `count_pieces`. Each is kept as soon as it is done, and what is done
    stays done when the caller stops in the midst.
    """
    ids = store.assets() if assets is None else tuple(dict.fromkeys(assets))
    engine, options = settings or CoacdSettings(), {"only": tuple(only), "again": again, "hollow": hollow, "by": by}
    work = [
        _DecomposeWork(store.path(a), store.layout.preparation(a), engine, options, pieces and pieces / str(number))
        for number, a in enumerate(ids)
    ]
    keep_decomposed(store, ids)
    results = batch.run_isolated(_decompose_one, work, execution)
    for asset, result in zip(ids, results, strict=True):
        if isinstance(result, batch.WorkerFailure | str):
            yield PreparationResult(asset, problems=(result if isinstance(result, str) else result.why,))
        else:
            with write_block(asset):
                kept = _write_result(store, asset, *result)
            yield kept


def _decompose_one(work: _DecomposeWork) -> tuple[batch.DecompositionResult, str | None] | str:
    """What a worker makes of an asset and the digest of the preparation it saw, or why it failed."""
    try:
        seen = batch.record_digest(work.folder)
        before = batch.read_preparation(work.folder) or batch.Preparation()
        asset = read(work.path)
        options = {**work.options, "cache": cache_folder(), "progress": work.tell}
        return batch.decompose_asset(asset, before, work.settings, **options), seen
    except Exception as error:  # one asset never stops the others
        return describe_error(error, str(work.path))


def count_pieces(folder: Path) -> tuple[int, int]:
    """How many pieces are done, of how many that are known, by the files of `decompose`."""
    rows = [path.read_text().split() for path in folder.iterdir() if path.name.isdecimal()]
    return sum(int(done) for done, _ in rows), sum(int(known) for _, known in rows)


def _write_result(store: Store, asset: str, result: batch.DecompositionResult, seen: str | None) -> PreparationResult:
    problems = [f"{lost.what}: {lost.why}" for lost in result.failed]
    notes = [f"given up, since {lost.what} {lost.why}" for lost in result.dropped]
    notes += [result.missed] if result.missed else []
    try:
        if result.made or result.dropped:
            notes += exchange_preparation(store, asset, result.preparation, seen)
    except MeshForgeError as error:
        return PreparationResult(asset, problems=(*problems, error.message))
    return PreparationResult(asset, result.made, tuple(notes), tuple(problems))
