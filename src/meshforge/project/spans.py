"""Hulls that span parts split, asset by asset, so far as that is sure enough; what is likely is kept for the status."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, nullcontext

from meshforge import batch
from meshforge.common import MeshForgeError, UsageError
from meshforge.engines import find_engine
from meshforge.formats import read
from meshforge.labels import SpanReport, find_spans
from meshforge.labels.family_comparison import Stage, ignore_stage
from meshforge.project.preparation_plan import keep_split
from meshforge.project.prepare import PreparationResult, exchange_preparation
from meshforge.project.span_search import AssetSpans, list_likely, search_spans
from meshforge.project.split_limits import describe_limits
from meshforge.store import SpansFile, Store

SURE_TO_SPAN = 0.9
"""The probability from which a hull is split unless another is asked for."""


def split_spanning(
    store: Store,
    assets: Iterable[str] | None = None,
    *,
    sure: float = SURE_TO_SPAN,
    dry_run: bool = False,
    engine: str | None = None,
    execution: batch.ExecutionOptions = batch.EXECUTION_DEFAULTS,
    stage: Stage = ignore_stage,
    write_block: Callable[[str], AbstractContextManager[object]] = nullcontext,
) -> Iterator[PreparationResult]:
    """Split the hulls that span parts with a probability of at least `sure`, one step an asset, and label their parts.

    assets: which may be split, all when None; all of the project are compared. dry_run: nothing is written, and `notes`
    say what would be done, and which limits of an engine, by default of those that read the file, the hulls would
    exceed then. What `unprepare` takes back brings the hulls, their labels and selections back.
    Raises UsageError for a probability that is none and for an unknown engine, ProjectError where no hull has a label
    or no asset can be read.
    """
    if not 0 < sure <= 1:
        raise UsageError(f"--sure {sure:g}: a probability is needed, above 0 and at most 1")
    if engine is not None:
        find_engine(engine)
    ids = store.assets() if assets is None else tuple(dict.fromkeys(assets))
    for asset in ids:
        store.path(asset)
    likely = dict(store.spans().assets)
    for asset, found in search_spans(store, ids, sure, execution, stage):
        if isinstance(found, str):
            yield PreparationResult(asset, problems=(found,))
            continue
        likely[asset] = found.likely
        try:
            with nullcontext() if dry_run else write_block(asset):
                result = _split_one(store, asset, found, dry_run, engine)
        except MeshForgeError as error:
            result = PreparationResult(asset, problems=(error.message,))
        yield result
    if not dry_run:
        known = {asset: lines for asset, lines in likely.items() if lines and asset in store.found.ids}
        store.write_spans(SpansFile(assets=known))
        keep_split(store, ids, sure)


def _split_one(store: Store, asset: str, found: AssetSpans, dry_run: bool, engine: str | None) -> PreparationResult:
    """What becomes of one asset."""
    plan, notes = found.plan, [*found.notes]
    notes += [f"{span}: left as it is, below {plan.sure:.0%}" for span in plan.unsure]
    notes += [f"{span}: no plane divides it; split it by hand: meshforge split" for span in plan.whole]
    if not plan.divisions:
        return PreparationResult(asset, notes=tuple(notes))
    source, before = read(store.path(asset)), store.preparation(asset)
    after, labels = plan.divide(source, before)
    notes += describe_limits(source, before, after, engine)
    if dry_run:
        return PreparationResult(asset, notes=(*(f"would split {one.told}" for one in plan.divisions), *notes))
    known = {name: label for name, label in labels.items() if label.name in store.vocabulary}
    notes = [*exchange_preparation(store, asset, after, found.seen, known), *notes]
    return PreparationResult(asset, after.steps[-1].replaced, tuple(notes))


def list_spans(
    store: Store,
    *,
    execution: batch.ExecutionOptions = batch.EXECUTION_DEFAULTS,
    stage: Stage = ignore_stage,
) -> SpanReport:
    """Which hulls span parts, found anew and kept for the status. Raises ProjectError as `split_spanning` does."""
    report = find_spans(store, execution, stage)
    likely = {asset: list_likely(report, asset) for asset in report.meshes}
    store.write_spans(SpansFile(assets={asset: lines for asset, lines in likely.items() if lines}))
    return report
