"""Hulls that span parts split, asset by asset, so far as that is sure enough; what is likely is kept for the status and
for the questions of a review."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from meshforge import batch
from meshforge.common import MeshForgeError, UsageError
from meshforge.engines import find_engine
from meshforge.formats import read
from meshforge.labels.family_comparison import Stage, ignore_stage
from meshforge.project.preparation_plan import SPLIT_DEFAULTS, SplitSettings, keep_split, read_piece_engine
from meshforge.project.prepare import PreparationResult
from meshforge.project.span_search import AssetSpans, search_spans
from meshforge.project.span_splits import Split, keep_shapes, write_splits
from meshforge.project.split_limits import describe_limits
from meshforge.store import SpanLine, SpansFile, Store


def split_spanning(
    store: Store,
    assets: Iterable[str] | None = None,
    how: SplitSettings = SPLIT_DEFAULTS,
    *,
    dry_run: bool = False,
    engine: str | None = None,
    execution: batch.ExecutionOptions = batch.EXECUTION_DEFAULTS,
    stage: Stage = ignore_stage,
) -> Iterator[PreparationResult]:
    """Split hulls that span parts with a probability of at least `how.sure`, one step an asset, and label their parts.

    Hulls that a person said to be one part stay as they are, but where they are made anew with their body.
    assets: which may be split, all when None; all of the project are compared. dry_run: nothing is written but what was
    found, for the status and the review; `planned` is what would be done. `notes` say which limits of an engine, by
    default of those that read the file, the hulls exceed then. What `unprepare` takes back brings the hulls, their
    labels and selections back.
    Raises UsageError for a probability that is none and for an unknown engine, ProjectError where no hull has a label
    or no asset can be read.
    """
    ids = choose_assets(store, assets, how.sure)
    if engine is not None:
        find_engine(engine)
    likely = dict(store.last_spans().assets)
    try:
        for asset, found in search_spans(store, ids, how, execution, stage):
            if isinstance(found, str):
                yield PreparationResult(asset, problems=(found,))
                continue
            likely[asset] = _keep_shapes(store, asset, found.likely)
            try:
                result = _split_one(store, asset, found, dry_run, engine)
            except MeshForgeError as error:
                result = PreparationResult(asset, problems=(error.message,))
            yield result
    finally:
        _write_likely(store, likely)
    if not dry_run:
        keep_split(store, ids, how)


def choose_assets(store: Store, assets: Iterable[str] | None, sure: float) -> tuple[str, ...]:
    """The assets whose hulls may be split from a probability on, each once; all of a project when None.

    Raises UsageError for a probability that is none, ProjectError for an asset that the project does not have.
    """
    if not 0 < sure <= 1:
        raise UsageError(f"--min-confidence {sure:g}: a probability is needed, above 0 and at most 1")
    ids = store.assets() if assets is None else tuple(dict.fromkeys(assets))
    for asset in ids:
        store.path(asset)
    return ids


def _split_one(store: Store, asset: str, found: AssetSpans, dry_run: bool, engine: str | None) -> PreparationResult:
    plan, notes = found.plan, (*found.notes, *found.plan.notes)
    if not plan.splits:
        return PreparationResult(asset, notes=notes)
    source, before = read(store.path(asset)), store.preparation(asset)
    after, _ = plan.divide(source, before)
    limits = describe_limits(source, before, after, engine)
    if dry_run:
        return PreparationResult(asset, notes=(*notes, *limits), planned=after.steps[-1].replaced)
    result = write_splits(store, asset, plan.splits, plan.settings, found.seen)
    return replace(result, notes=(*result.notes, *notes, *limits))


def _keep_shapes(store: Store, asset: str, likely: Mapping[str, Split]) -> dict[str, SpanLine]:
    lines = {hull: one.span for hull, one in likely.items()}
    if lines:
        shapes = {hull: one.shapes for hull, one in likely.items() if one.shapes}
        keep_shapes(store.layout.span_parts(asset), lines, shapes)
    return lines


def _write_likely(store: Store, likely: Mapping[str, dict[str, SpanLine]]) -> None:
    known = {asset: lines for asset, lines in likely.items() if lines and asset in store.found.ids}
    store.write_spans(SpansFile(assets=known))


def list_spans(
    store: Store, *, execution: batch.ExecutionOptions = batch.EXECUTION_DEFAULTS, stage: Stage = ignore_stage
) -> tuple[PreparationResult, ...]:
    """Find anew which hulls span parts, for `spans`, the status and the review; of each asset why it could not be
    looked at, and what of it was not.

    Raises ProjectError as `split_spanning` does, StoppedError on a stop, with nothing written.
    """
    how = SplitSettings(pieces=read_piece_engine(store))
    rows = list(search_spans(store, store.assets(), how, execution, stage))
    batch.raise_if_stopped(execution.stop)
    found = {asset: one.likely for asset, one in rows if isinstance(one, AssetSpans)}
    _write_likely(store, {asset: _keep_shapes(store, asset, likely) for asset, likely in found.items()})
    return tuple(
        PreparationResult(asset, problems=(one,)) if isinstance(one, str) else PreparationResult(asset, notes=one.notes)
        for asset, one in rows
    )
