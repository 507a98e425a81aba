"""Hulls that span parts split, asset by asset, so far as that is sure enough; what is likely is kept for the status and
for the questions of a review."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from functools import cache

from meshforge import batch
from meshforge.common import MeshForgeError, UsageError
from meshforge.geometry import HullPart, Polytope
from meshforge.labels import HullSpan, SpanReport, find_spans, ignore_stage
from meshforge.project.prepare import PreparationResult
from meshforge.project.span_splits import Split, keep_shapes, write_splits
from meshforge.store import SinglePartsFile, SpanLine, SpanPart, SpansFile, Store, hull_digests

SURE_TO_SPAN = 0.9
"""The probability from which a hull is split unless another is asked for."""
_LIKELY = 0.5  # from which a hull is named, and asked about
_DIGITS = 3

_Divide = Callable[[str, str], list[tuple[HullPart, str, float]]]
"""The parts of a hull of an asset, as `SpanReport.divide` gives them."""


def split_spanning(
    store: Store,
    assets: Iterable[str] | None = None,
    *,
    sure: float = SURE_TO_SPAN,
    dry_run: bool = False,
    execution: batch.ExecutionOptions = batch.EXECUTION_DEFAULTS,
    stage: Callable[[int, str], AbstractContextManager[Callable[[], None]]] = ignore_stage,
    write_block: Callable[[str], AbstractContextManager[object]] = nullcontext,
) -> Iterator[PreparationResult]:
    """Split the hulls that span parts with a probability of at least `sure`, one step an asset, and label their parts.

    Hulls that a person said to be one part stay as they are.
    assets: which may be split, all when None; all of the project are compared. dry_run: nothing is written but what was
    found, for the status and the review, and `notes` say what would be done. What `unprepare` takes back brings the
    hulls, their labels and selections back.
    Raises UsageError for a probability that is none, ProjectError where no hull has a label or no asset a surface.
    """
    if not 0 < sure <= 1:
        raise UsageError(f"--sure {sure:g}: a probability is needed, above 0 and at most 1")
    ids = store.assets() if assets is None else tuple(dict.fromkeys(assets))
    for asset in ids:
        store.path(asset)
    seen = {asset: batch.record_digest(store.layout.preparation(asset)) for asset in ids}
    report = find_spans(store, execution, stage)
    divide, single = cache(report.divide), store.single_parts()
    _keep_likely(store, report, divide)
    for asset in ids:
        if asset in report.lost:
            yield PreparationResult(asset, problems=(report.lost[asset],))
            continue
        if asset not in report.meshes:
            yield PreparationResult(asset, problems=("it cannot be read",))
            continue
        try:
            with nullcontext() if dry_run else write_block(asset):
                result = _split_one(
                    store, asset, _plan_splits(asset, report, divide, sure, single), seen[asset], dry_run
                )
        except MeshForgeError as error:
            result = PreparationResult(asset, problems=(error.message,))
        yield result


@dataclass(frozen=True, slots=True)
class _Plan:
    """What to do to an asset. notes: on hulls that stay as they are; sure: the probability that was asked for."""

    splits: tuple[Split, ...]
    notes: tuple[str, ...]
    sure: float


def _plan_splits(asset: str, report: SpanReport, divide: _Divide, sure: float, single: SinglePartsFile) -> _Plan:
    splits, notes = (
        list[Split](),
        [f"{name} stands for no surface: left as it is" for name in report.bare.get(asset, ())],
    )
    digests = hull_digests(report.meshes[asset])
    for span in report.spans_of(asset):
        if span.chance >= min(sure, _LIKELY) and single.holds(asset, span.hull, digests[span.hull]):
            notes.append(f"{span}: left as it is, since a person said that it is one part")
        elif span.chance < sure:
            notes += [f"{span}: left as it is, below {sure:.0%}"] if span.chance >= _LIKELY else []
        elif len(parts := divide(asset, span.hull)) < 2:
            notes.append(f"{span}: no plane divides it; split it by hand: meshforge split")
        else:
            splits.append(Split(span.hull, _to_line(span, digests[span.hull], parts), _shapes_of(parts)))
    return _Plan(tuple(splits), tuple(notes), sure)


def _split_one(store: Store, asset: str, plan: _Plan, seen: str | None, dry_run: bool) -> PreparationResult:
    """What becomes of one asset. seen: the digest of its preparation as it was looked at."""
    if not plan.splits or dry_run:
        return PreparationResult(asset, notes=(*(f"would split {one}" for one in plan.splits), *plan.notes))
    result = write_splits(store, asset, plan.splits, {"sure": plan.sure}, seen)
    return replace(result, notes=(*result.notes, *plan.notes))


def _keep_likely(store: Store, report: SpanReport, divide: _Divide) -> None:
    """Keep which hulls likely span parts, and which parts, for the status and the questions of a review."""
    found = dict[str, dict[str, SpanLine]]()
    for asset, mesh in report.meshes.items():
        likely = {span.hull: span for span in report.spans_of(asset) if span.chance >= _LIKELY}
        if not likely:
            continue
        digests, parts = hull_digests(mesh), {hull: divide(asset, hull) for hull in likely}
        found[asset] = {hull: _to_line(span, digests[hull], parts[hull]) for hull, span in likely.items()}
        path = store.layout.span_parts(asset)
        keep_shapes(path, found[asset], {hull: _shapes_of(own) for hull, own in parts.items() if len(own) > 1})
    store.write_spans(SpansFile(assets=found))


def _to_line(span: HullSpan, geometry: str, parts: Sequence[tuple[HullPart, str, float]]) -> SpanLine:
    """A hull as it is kept; with one part alone nothing divides it."""
    rows = (
        tuple(SpanPart(label=label, share=round(share, _DIGITS)) for _, label, share in parts) if len(parts) > 1 else ()
    )
    return SpanLine(geometry=geometry, chance=round(span.chance, _DIGITS), told=str(span), parts=rows)


def _shapes_of(parts: Sequence[tuple[HullPart, str, float]]) -> tuple[Polytope, ...]:
    return tuple(part.shape for part, _, _ in parts)


def list_spans(
    store: Store,
    *,
    execution: batch.ExecutionOptions = batch.EXECUTION_DEFAULTS,
    stage: Callable[[int, str], AbstractContextManager[Callable[[], None]]] = ignore_stage,
) -> SpanReport:
    """Which hulls span parts, found anew and kept for the status and the review.

    Raises ProjectError as `split_spanning` does, StoppedError on a stop, with nothing written.
    """
    report = find_spans(store, execution, stage)
    batch.raise_if_stopped(execution.stop)
    _keep_likely(store, report, report.divide)
    return report
