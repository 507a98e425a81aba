"""Hulls that span parts split, asset by asset, so far as that is sure enough; what is likely is kept for the status."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, nullcontext

from meshforge import batch
from meshforge.common import MeshForgeError, UsageError, pluralize
from meshforge.formats import read
from meshforge.labels import HullSpan, SpanReport, find_spans, ignore_stage
from meshforge.project.prepare import PreparationResult, exchange_preparation
from meshforge.store import SpanLine, SpansFile, Store, hull_digests
from meshforge.symbolic import Label

SURE_TO_SPAN = 0.9
"""The probability from which a hull is split unless another is asked for."""
_LIKELY = 0.5  # from which a hull is named
_DIGITS = 3


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

    assets: which may be split, all when None; all of the project are compared. dry_run: nothing is written, and `notes`
    say what would be done. What `unprepare` takes back brings the hulls, their labels and selections back.
    Raises UsageError for a probability that is none, ProjectError where no hull has a label or no asset can be read.
    """
    if not 0 < sure <= 1:
        raise UsageError(f"--sure {sure:g}: a probability is needed, above 0 and at most 1")
    ids = store.assets() if assets is None else tuple(dict.fromkeys(assets))
    for asset in ids:
        store.path(asset)
    seen = {asset: batch.record_digest(store.layout.preparation(asset)) for asset in ids}
    report = find_spans(store, execution, stage)
    if not dry_run:
        _keep_likely(store, report)
    for asset in ids:
        if asset in report.lost:
            yield PreparationResult(asset, problems=(report.lost[asset],))
            continue
        if asset not in report.meshes:
            yield PreparationResult(asset, problems=("it cannot be read",))
            continue
        try:
            with nullcontext() if dry_run else write_block(asset):
                result = _split_one(store, asset, report, sure, seen[asset], dry_run)
        except MeshForgeError as error:
            result = PreparationResult(asset, problems=(error.message,))
        yield result


def _split_one(
    store: Store, asset: str, report: SpanReport, sure: float, seen: str | None, dry_run: bool
) -> PreparationResult:
    """What becomes of one asset."""
    divisions, labels = list[batch.HullDivision](), list[list[Label]]()
    notes = [f"{name} stands for no surface: left as it is" for name in report.bare.get(asset, ())]
    for span in report.spans_of(asset):
        if span.chance < sure:
            notes += [f"{span}: left as it is, below {sure:.0%}"] if span.chance >= _LIKELY else []
            continue
        parts = report.divide(asset, span.hull)
        if len(parts) < 2:
            notes.append(f"{span}: no plane divides it; split it by hand: meshforge split")
            continue
        made = ", ".join(f"{label} ({share:.0%})" for _, label, share in parts)
        told = f"{span}: into {pluralize(len(parts), 'part')}, {made}"
        shapes = tuple(part.shape for part, _, _ in parts)
        divisions.append(batch.HullDivision(span.hull, span.chance, shapes, told))
        labels.append([Label(label, round(share, _DIGITS), "propagated") for _, label, share in parts])
    if not divisions or dry_run:
        return PreparationResult(asset, notes=(*(f"would split {one.told}" for one in divisions), *notes))
    return _write(store, asset, divisions, labels, sure, seen, notes)


def _write(
    store: Store,
    asset: str,
    divisions: list[batch.HullDivision],
    labels: list[list[Label]],
    sure: float,
    seen: str | None,
    notes: list[str],
) -> PreparationResult:
    folder = store.layout.preparation(asset)
    before = batch.read_preparation(folder) or batch.Preparation()
    chances = {one.hull: round(one.chance, _DIGITS) for one in divisions}
    source = read(store.path(asset))
    after = batch.divide_hulls(source, before, divisions, {"sure": sure, "chances": chances})
    entries = after.steps[-1].replaced
    known = {
        name: label
        for entry, own in zip(entries, labels, strict=True)
        for name, label in zip(entry.made, own, strict=True)
        if label.name in store.vocabulary
    }
    notes = [*exchange_preparation(store, asset, after, seen, known), *notes]
    return PreparationResult(asset, entries, tuple(notes))


def _keep_likely(store: Store, report: SpanReport) -> None:
    """Keep which hulls likely span parts, for the status."""
    found = dict[str, dict[str, SpanLine]]()
    for asset, mesh in report.meshes.items():
        digests = hull_digests(mesh)
        likely = [span for span in report.spans_of(asset) if span.chance >= _LIKELY]
        if likely:
            found[asset] = {span.hull: _to_line(span, digests[span.hull]) for span in likely}
    store.write_spans(SpansFile(assets=found))


def _to_line(span: HullSpan, geometry: str) -> SpanLine:
    return SpanLine(geometry=geometry, chance=round(span.chance, _DIGITS), told=str(span))


def list_spans(
    store: Store,
    *,
    execution: batch.ExecutionOptions = batch.EXECUTION_DEFAULTS,
    stage: Callable[[int, str], AbstractContextManager[Callable[[], None]]] = ignore_stage,
) -> SpanReport:
    """Which hulls span parts, found anew and kept for the status. Raises ProjectError as `split_spanning` does."""
    report = find_spans(store, execution, stage)
    _keep_likely(store, report)
    return report
