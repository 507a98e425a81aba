"""What is done to assets before the program: hulls decomposed, cut and split, with labels that follow them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from itertools import takewhile
from pathlib import Path
from typing import Any

from meshforge import batch
from meshforge.common import AssetError, MeshForgeError, ProjectError, describe_error, join_names
from meshforge.formats import DecomposeBy, read
from meshforge.geometry import CoacdSettings, DecomposeSettings, Shape, cache_folder, digest
from meshforge.labels import label_new_hulls
from meshforge.project import selections
from meshforge.project.demonstrations import find_unknown_hulls
from meshforge.store import Store, hull_digests
from meshforge.symbolic import Asset, Label, SymbolicMesh, parse_labels_text


@dataclass(frozen=True, slots=True)
class PreparationResult:
    """What became of one asset.

    made: the pieces that got hulls now; notes: what that means for labels and demonstrations, and what was given up;
    problems: why a piece, or the whole asset, could not be prepared; undone: what was taken back, in words.
    """

    asset: str
    made: tuple[batch.Replacement, ...] = ()
    notes: tuple[str, ...] = ()
    problems: tuple[str, ...] = ()
    undone: tuple[str, ...] = ()

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
    notes = exchange_preparation(store, asset, after, seen)
    added = after.steps[len(before.steps) :]
    return PreparationResult(asset, tuple(entry for step in added for entry in step.replaced), tuple(notes))


def cut(store: Store, asset: str, hull: str, at: Sequence[float], across: Sequence[float]) -> PreparationResult:
    """Cut a hull along the plane through `at` (3,) [m] across `across` (3,), in the frame that the asset comes in.

    Raises GeometryError: no such hull, or a plane that misses it.
    """
    return change_preparation(store, asset, lambda source, before: batch.cut_hull(source, before, hull, at, across))


def split(
    store: Store, asset: str, hull: str, settings: DecomposeSettings | None = None, *, hollow: bool = False
) -> PreparationResult:
    """Split a hull by a decomposition of what its body shows, or of the opaque piece that it was made of.

    Raises GeometryError: no such hull, nothing to decompose, or nothing that divides it.
    """

    def make(source: Asset, before: batch.Preparation) -> batch.Preparation:
        engine = settings or CoacdSettings()
        return batch.split_hull(source, before, hull, engine, hollow=hollow, cache=cache_folder())

    return change_preparation(store, asset, make)


def unprepare(store: Store, asset: str, *, everything: bool = False) -> PreparationResult:
    """Take back the last thing that was done to an asset before the program, or everything.

    Everything also of an asset that is gone or cannot be read. Raises ProjectError where nothing was done.
    """
    if asset not in store.layout.ids_with_preparation():
        store.path(asset)
    folder = store.layout.preparation(asset)
    seen = batch.record_digest(folder)
    if seen is None:
        raise ProjectError("nothing was done to it that could be taken back", where=asset)
    before = _read_or_empty(folder) if everything else batch.read_preparation(folder) or batch.Preparation()
    left = 0 if everything else len(before.steps) - 1
    notes = exchange_preparation(store, asset, before.with_only(before.steps[:left]), seen)
    undone = tuple(map(str, before.steps[left:])) or ("what was kept, which was damaged",)
    return PreparationResult(asset, undone=undone, notes=tuple(notes))


def _read_or_empty(folder: Path) -> batch.Preparation:
    """The preparation in a folder, an empty one where there is none or a damaged one."""
    try:
        return batch.read_preparation(folder) or batch.Preparation()
    except AssetError:
        return batch.Preparation()


def exchange_preparation(
    store: Store, asset: str, after: batch.Preparation, seen: str | None, labels: Mapping[str, Label] | None = None
) -> list[str]:
    """Write a preparation in the place of the one of a known digest. Raises ProjectError where that is another now.

    labels: of new hulls by name, as what made them knows them; they are marked as propagated, but where a person gave
    the hull that is split the same label.
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
    harmless, and selections of such hulls, which the status names.
    """
    folder = store.layout.preparation(asset)
    try:
        source = read(store.path(asset))
    except MeshForgeError as error:
        if after.steps:
            raise
        batch.remove_preparation(folder)
        selections.write_journal(store, asset, ())
        return [f"its labels stay as they are: {error.problem}"] if store.layout.labels(asset).exists() else []
    before = _read_or_empty(folder).steps
    common = sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(before, after.steps, strict=False)))
    journal = selections.read_journal(store, asset).steps
    undone = [step for step in reversed(journal) if step.place >= common]
    kept = [step for step in journal if step.place < common]
    mesh, old = SymbolicMesh.of(batch.apply_preparation(source, after)), _hulls_before(source, folder)
    label_bytes = store.label_bytes(asset).decode("utf-8") or None
    known, notes = _find_labels_before(store, asset, undone, mesh) if common == len(after.steps) else ({}, [])
    known |= {name: replace(label, source="propagated") for name, label in labels.items()}
    follow = label_new_hulls(store, asset, old, mesh, known)
    restored = _restore_label_text(label_bytes, undone)
    final = (
        restored if restored is not _CHANGED and common == len(after.steps) else follow.text if follow else label_bytes
    )
    if common < len(after.steps):
        was = {name: digest(shape) for name, shape in old.items()}
        successors = selections.Successors.between(after, was, hull_digests(mesh))
        changes = selections.carry_selections(store, asset, successors) if successors.parts else ()
        if changes or (successors.parts and final != label_bytes):
            kept.append(
                selections.StepSelections(
                    place=common,
                    parts=dict(successors.parts),
                    digests=dict(successors.digests),
                    changes=changes,
                    labels_before=label_bytes,
                    labels_after=final,
                )
            )
            selections.write_journal(store, asset, [*journal, kept[-1]])
    if follow:
        follow.write(keep_old=True)
    if after.steps:
        batch.write_preparation(folder, after)
    else:
        batch.remove_preparation(folder)
    for step in undone:
        selections.restore_selections(store, asset, step)
    for step in kept:
        if step not in journal:
            selections.apply_changes(store, asset, step)
            notes += [f"look at it: {one}" for one in selections.describe_carried(store, asset)]
    if follow:
        store.write_labels_files({asset: final})
    selections.write_journal(store, asset, kept)
    gone = sorted({name for _, name in find_unknown_hulls(store.steps(asset), mesh.index)})
    notes = [*(follow.notes if follow else ()), *notes]
    if gone:
        notes.append(f"the demonstration on it names {join_names(gone)}, which it has no more: demonstrate it anew")
    return notes


_CHANGED = "changed since"


def _restore_label_text(text: str | None, undone: Sequence[selections.StepSelections]) -> str | None:
    """The text of a labels file before steps, the last one first; `_CHANGED` where it is another since."""
    for step in undone:
        if text != step.labels_after:
            return _CHANGED
        text = step.labels_before
    return text if undone else _CHANGED


def _find_labels_before(
    store: Store, asset: str, undone: Sequence[selections.StepSelections], mesh: SymbolicMesh
) -> tuple[dict[str, Label | None], list[str]]:
    """The labels that hulls had before they were split, unless those of their parts were changed since; notes on
    these."""
    now: dict[str, Label | None] = dict(store.labels(asset).labels)
    notes, found = list[str](), dict[str, Label | None]()
    for step in undone:
        were, became = (parse_labels_text(text).labels for text in (step.labels_before, step.labels_after))
        for hull, parts in step.parts.items():
            if all(now.get(part) == became.get(part) for part in parts):
                now[hull] = found[hull] = were.get(hull)
            else:
                now[hull] = None
                notes.append(f"{hull} gets its label from its parts, which were labelled since it was split")
    return {name: label for name, label in found.items() if name in mesh.index}, notes


@dataclass(frozen=True, slots=True)
class _DecomposeWork:
    """One asset to be decomposed; folder: of its preparation; options: those of `batch.decompose_asset`."""

    path: Path
    folder: Path
    settings: DecomposeSettings
    options: Mapping[str, Any]


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
) -> Iterator[PreparationResult]:
    """Make hulls of what has none: non-convex pieces, and what bodies without collision geometry show.

    It is done in worker processes. assets: all when None; settings: CoACD's defaults when None; only: names of pieces
    and bodies, or patterns; again: also what is decomposed already; hollow: shells of one sheet are not filled;
    by: `parts` decomposes each group, node and material by itself, so that no hull crosses from one to another;
    write_block: the block in which an asset's files are written. Each is kept as soon as it is done, and what is done
    stays done when the caller stops in the midst.
    """
    ids = store.assets() if assets is None else tuple(dict.fromkeys(assets))
    engine, options = settings or CoacdSettings(), {"only": tuple(only), "again": again, "hollow": hollow, "by": by}
    work = [_DecomposeWork(store.path(asset), store.layout.preparation(asset), engine, options) for asset in ids]
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
        return batch.decompose_asset(asset, before, work.settings, **work.options, cache=cache_folder()), seen
    except Exception as error:  # one asset never stops the others
        return describe_error(error, str(work.path))


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
