"""What is done to assets before the program: hulls decomposed, cut and rebuilt, with labels and selections that follow
them. Each change is an entry of the project's history."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from time import monotonic
from typing import Any, Self

from meshforge import batch
from meshforge.common import AssetError, MeshForgeError, ProjectError, describe_error, join_names, write_atomically
from meshforge.formats import DecomposeBy, read
from meshforge.geometry import CoacdSettings, DecomposeSettings, Shape, cache_folder
from meshforge.labels import HullSpan, NewHullLabels, label_new_hulls
from meshforge.project.demonstrations import find_unknown_hulls
from meshforge.project.hull_mapping import HullMapping, describe_replaced
from meshforge.project.preparation_plan import DecompositionPlan, keep_decomposed
from meshforge.store import History, Store
from meshforge.symbolic import Asset, Label, SymbolicMesh


@dataclass(frozen=True, slots=True)
class PreparationResult:
    """What became of one asset.

    made: the pieces that got hulls now; notes: what that means for labels and demonstrations, and what was given up;
    problems: why a piece, or the whole asset, could not be prepared; undone: what was taken back, in words; planned:
    what `made` would be, where nothing was to be written; found: the hulls that span parts, whose
    bodies are rebuilt.
    """

    asset: str
    made: tuple[batch.Replacement, ...] = ()
    notes: tuple[str, ...] = ()
    problems: tuple[str, ...] = ()
    undone: tuple[str, ...] = ()
    planned: tuple[batch.Replacement, ...] = ()
    found: tuple[HullSpan, ...] = ()

    @property
    def hulls(self) -> tuple[str, ...]:
        """The names of all hulls that were made."""
        return tuple(name for entry in self.made for name in entry.made)


def change_preparation(
    store: Store, asset: str, make: Callable[[Asset, batch.Preparation], batch.Preparation]
) -> PreparationResult:
    """Do one thing more to an asset. make: its preparation with that, of the asset as it was read and that before."""
    folder = store.layout.preparation(asset)
    with store.lock():
        History(store.folder).recover()
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


def exchange_preparation(
    store: Store, asset: str, after: batch.Preparation, seen: str | None, labels: Mapping[str, Label] | None = None
) -> list[str]:
    """Write a preparation in the place of the one of a known digest, so that it can be undone, and let labels and
    selections follow; notes on that.

    labels: of new hulls by name, as what made them knows them; where a person gave the hull that is split the same
    label, theirs is taken. Raises ProjectError, with nothing written, where there is another preparation now, or a file
    of the project cannot be read.
    """
    with store.lock():
        History(store.folder).recover()
        if batch.record_digest(store.layout.preparation(asset)) != seen:
            raise ProjectError("someone else has prepared it meanwhile", where=asset, remedy="Try again.")
        check_selections(store, asset)
        change = HullChange.read(store, asset, after)
        follow = label_new_hulls(store, asset, change.old, change.mesh, labels)
        others = change.mapping.list_writes(store, asset)
        done = str(after.steps[-1]) if after.steps else "preparation given up"
        change.write(f"{asset}: {done}", "prepare", follow, others)
        notes = list(follow.notes if follow else ())
        notes += [f"look at it: {one}" for one in describe_replaced(store, asset)] if others else []
        return [*notes, *change.describe_gone()]


def keep_preparation(
    store: Store,
    asset: str,
    after: batch.Preparation,
    seen: str | None,
    made: tuple[batch.Replacement, ...],
    labels: Mapping[str, Label] | None = None,
) -> PreparationResult:
    """Return what became of an asset by `exchange_preparation`, with what was made now, or why that is not possible."""
    try:
        return PreparationResult(asset, made, tuple(exchange_preparation(store, asset, after, seen, labels)))
    except MeshForgeError as error:
        return PreparationResult(asset, problems=(error.message,))


def check_selections(store: Store, asset: str) -> None:
    """Raise ProjectError, naming the file, where a demonstration, edits by hand or the events cannot be read."""
    store.steps(asset)
    store.manual_edits(asset)
    store.feedback()


@dataclass(frozen=True, eq=False, slots=True)
class HullChange:
    """The hulls of an asset before and after its preparation is exchanged. before, after: the preparations; old: the
    hulls by name; mesh: the new ones."""

    store: Store
    asset: str
    before: batch.Preparation
    after: batch.Preparation
    old: Mapping[str, Shape]
    mesh: SymbolicMesh

    @classmethod
    def read(cls, store: Store, asset: str, after: batch.Preparation) -> Self:
        """Raise AssetError where the asset cannot be read, or the preparation does not fit it."""
        source = read(store.path(asset))
        before = read_or_empty(store.layout.preparation(asset))
        mesh = SymbolicMesh.of(batch.apply_preparation(source, after))
        return cls(store, asset, before, after, _list_hulls(source, before), mesh)

    @property
    def mapping(self) -> HullMapping:
        """Which new hulls take the place of old ones."""
        return HullMapping.between(self.after, self.old, self.mesh.index)

    @property
    def mapping_back(self) -> HullMapping:
        """Which old hulls took the place of new ones."""
        return HullMapping.between(self.before, self.mesh.index, self.old)

    def write(
        self, title: str, kind: str, follow: NewHullLabels | None, others: Sequence[tuple[Path, bytes | None]]
    ) -> None:
        """Write the preparation, labels and other files as one change.

        Labels of the new hulls are written before these, the removal of old labels after them: what is read meanwhile
        has a label for each hull.
        """
        labels, folder = self.store.layout.labels(self.asset), self.store.layout.preparation(self.asset)
        writes = batch.list_preparation_writes(folder, self.after)
        if follow:
            between, final = follow.format(keep_old=True), follow.format(keep_old=False)
            writes = [(labels, between.encode() if between else None), *writes]
            writes += [(labels, final.encode() if final else None)]
        History(self.store.folder).write(title, edit_of(kind, self.asset), [*writes, *others])

    def describe_gone(self) -> list[str]:
        """Return a note on hulls that the demonstration names and that are no more."""
        gone = sorted({name for _, name in find_unknown_hulls(self.store.steps(self.asset), self.mesh.index)})
        note = f"the demonstration on it names {join_names(gone)}, which it has no more: demonstrate it anew"
        return [note] if gone else []


def edit_of(kind: str, asset: str) -> dict[str, str]:
    """Return what the history notes of a preparation, or of undoing one."""
    return {"kind": kind, "asset": asset}


def read_or_empty(folder: Path) -> batch.Preparation:
    """Return the preparation in a folder, an empty one where there is none or it is damaged."""
    try:
        return batch.read_preparation(folder) or batch.Preparation()
    except AssetError:
        return batch.Preparation()


def _list_hulls(source: Asset, before: batch.Preparation) -> dict[str, Shape]:
    """The hulls of an asset by name as they are prepared, those of an outdated preparation too.

    A hull that a step puts others in the place of is none of them, whether or not that step still fits the asset.
    """
    made = {name: before.hulls[known] for name, known in before.hull_digests.items()}
    there = made | {geom.name: geom.shape for geom in batch.replay_preparation(source, before).asset.geoms}
    replaced = {r.what for step in before.steps for r in step.replaced if r.kind == "hull"}  # authored ones too
    return {name: shape for name, shape in there.items() if name not in replaced}


@dataclass(frozen=True, slots=True)
class _DecomposeWork:
    """One asset to be decomposed; folder: of its preparation; options: those of `batch.decompose_asset`; pieces: the
    file that says how far it is."""

    path: Path
    folder: Path
    settings: DecomposeSettings
    options: Mapping[str, Any]
    pieces: Path | None

    def report(self, done: int, known: int) -> None:
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
    engine, options = (
        settings or CoacdSettings(),
        {"only": tuple(only), "again": again, "hollow": hollow, "by": by, "cache": cache_folder()},
    )
    work = [
        _DecomposeWork(store.path(a), store.layout.preparation(a), engine, options, pieces and pieces / str(number))
        for number, a in enumerate(ids)
    ]
    with store.lock():
        History(store.folder).recover()
    keep_decomposed(store, ids)
    results = batch.run_isolated(_decompose_one, work, execution)
    for asset, result in zip(ids, results, strict=True):
        if isinstance(result, batch.WorkerFailure | str):
            yield PreparationResult(asset, problems=(result if isinstance(result, str) else result.why,))
        else:
            with write_block(asset):
                kept = _write_result(store, asset, *result)
            yield kept


def try_decomposition(
    store: Store, asset: str, plan: DecompositionPlan, execution: batch.ExecutionOptions, pieces: Path
) -> tuple[batch.DecompositionResult, float]:
    """Return what `decompose` would make of one asset, with nothing written to the project; and the seconds that it
    took, or would take if the hulls were not known from before. pieces: as there.

    Raises AssetError where it cannot be read, MeshForgeError where its process died, StoppedError.
    """
    options = {"only": plan.only, "hollow": plan.hollow, "by": plan.by}
    with TemporaryDirectory(ignore_cleanup_errors=True) as new:  # else what is known from before would take no time
        folder, cache = store.layout.preparation(asset), {"cache": Path(new)}
        work = _DecomposeWork(store.path(asset), folder, plan.settings, options | cache, pieces / "0")
        begun = monotonic()
        (result,) = batch.run_isolated(_decompose_one, [work], execution)
        seconds = monotonic() - begun
        with suppress(OSError):  # a cache that cannot be written
            for path in Path(new).rglob("*.npz"):
                write_atomically(cache_folder() / path.relative_to(new), path.read_bytes())
    if isinstance(result, str):
        raise AssetError(result)
    if isinstance(result, batch.WorkerFailure):
        raise MeshForgeError(result.why, where=asset)
    return result[0], seconds


def count_copies(made: Iterable[batch.Replacement]) -> int:
    """Return how many pieces have the same geometry as another one, beside that one: they are decomposed once."""
    sources = [entry.source for entry in made]
    return len(sources) - len({*sources})


def _decompose_one(work: _DecomposeWork) -> tuple[batch.DecompositionResult, str | None] | str:
    try:
        seen = batch.record_digest(work.folder)
        before = batch.read_preparation(work.folder) or batch.Preparation()
        asset = read(work.path)
        return batch.decompose_asset(asset, before, work.settings, progress=work.report, **work.options), seen
    except Exception as error:  # one asset never stops the others
        return describe_error(error, str(work.path))


def count_pieces(folder: Path) -> tuple[int, int]:
    """Return how many pieces are done, of how many that are known, by the files of `decompose`."""
    rows = [path.read_text().split() for path in folder.iterdir() if path.name.isdecimal()]
    return sum(int(done) for done, _ in rows), sum(int(known) for _, known in rows)


def _write_result(store: Store, asset: str, result: batch.DecompositionResult, seen: str | None) -> PreparationResult:
    problems = tuple(f"{lost.what}: {lost.why}" for lost in result.failed)
    notes = [f"given up, since {lost.what} {lost.why}" for lost in result.dropped]
    notes += [result.missed] if result.missed else []
    kept = PreparationResult(asset)
    if result.made or result.dropped:
        kept = keep_preparation(store, asset, result.preparation, seen, result.made)
    return replace(kept, notes=() if kept.problems else (*notes, *kept.notes), problems=(*problems, *kept.problems))
