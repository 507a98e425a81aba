"""Hulls that span parts split, asset by asset, so far as that is sure enough; what is likely is kept for the status."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass

from meshforge import batch
from meshforge.common import MeshForgeError, UsageError, pluralize
from meshforge.engines import find_engine
from meshforge.formats import read
from meshforge.labels import HullSpan, SpanReport, find_spans, ignore_stage
from meshforge.project.preparation_plan import keep_split
from meshforge.project.prepare import PreparationResult, exchange_preparation
from meshforge.project.split_limits import describe_limits
from meshforge.store import SpanLine, SpansFile, Store, hull_digests
from meshforge.symbolic import Asset, Label

SURE_TO_SPAN = 0.9
"""The probability from which a hull is split unless another is asked for."""
LIKELY = 0.5
"""The probability from which a hull is named."""
_DIGITS = 3


def split_spanning(
    store: Store,
    assets: Iterable[str] | None = None,
    *,
    sure: float = SURE_TO_SPAN,
    dry_run: bool = False,
    engine: str | None = None,
    execution: batch.ExecutionOptions = batch.EXECUTION_DEFAULTS,
    stage: Callable[[int, str], AbstractContextManager[Callable[[], None]]] = ignore_stage,
    write_block: Callable[[str], AbstractContextManager[object]] = nullcontext,
) -> Iterator[PreparationResult]:
    """Split the hulls that span parts with a probability of at least `sure`, one step an asset, and label their parts.

    assets: which may be split, all when None; all of the project are compared. dry_run: nothing is written, and `notes`
    say what would be done, and which limits of an engine, by default of those that read the file, the hulls would
    exceed then. What `unprepare` takes back brings the hulls, their labels and selections back.
    Raises UsageError for a probability that is none and for an unknown engine, ProjectError where no hull has a label
    or no asset a surface.
    """
    if not 0 < sure <= 1:
        raise UsageError(f"--sure {sure:g}: a probability is needed, above 0 and at most 1")
    if engine is not None:
        find_engine(engine)
    ids = store.assets() if assets is None else tuple(dict.fromkeys(assets))
    for asset in ids:
        store.path(asset)
    seen = {asset: batch.record_digest(store.layout.preparation(asset)) for asset in ids}
    report = find_spans(store, execution, stage)
    if not dry_run:
        _keep_likely(store, report)
        keep_split(store, ids, sure)
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
                    store, asset, report, plan_divisions(report, asset, sure), seen[asset], dry_run, engine
                )
        except MeshForgeError as error:
            result = PreparationResult(asset, problems=(error.message,))
        yield result


def _split_one(
    store: Store,
    asset: str,
    report: SpanReport,
    plan: DivisionPlan,
    seen: str | None,
    dry_run: bool,
    engine: str | None,
) -> PreparationResult:
    """What becomes of one asset."""
    notes = [f"{name} stands for no surface: left as it is" for name in report.bare.get(asset, ())]
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
    notes = [*exchange_preparation(store, asset, after, seen, known), *notes]
    return PreparationResult(asset, after.steps[-1].replaced, tuple(notes))


@dataclass(frozen=True, eq=False, slots=True)
class DivisionPlan:
    """Which hulls of an asset are to be divided. divisions: these, with the labels of the parts of each; unsure: hulls
    that likely span parts, but not surely enough; whole: those that no plane divides."""

    sure: float
    divisions: tuple[batch.HullDivision, ...]
    labels: tuple[tuple[Label, ...], ...]
    unsure: tuple[HullSpan, ...]
    whole: tuple[HullSpan, ...]

    def divide(self, source: Asset, before: batch.Preparation) -> tuple[batch.Preparation, dict[str, Label]]:
        """A preparation with the step that divides them, and the label of each part by its name."""
        chances = {one.hull: round(one.chance, _DIGITS) for one in self.divisions}
        after = batch.divide_hulls(source, before, self.divisions, {"sure": self.sure, "chances": chances})
        rows = zip(after.steps[-1].replaced, self.labels, strict=True)
        return after, {name: one for entry, own in rows for name, one in zip(entry.made, own, strict=True)}


def plan_divisions(report: SpanReport, asset: str, sure: float) -> DivisionPlan:
    """How the hulls of an asset that span parts with a probability of at least `sure` are divided."""
    divisions, labels = list[batch.HullDivision](), list[tuple[Label, ...]]()
    unsure, whole = list[HullSpan](), list[HullSpan]()
    for span in report.spans_of(asset):
        if span.chance < sure:
            unsure += [span] if span.chance >= LIKELY else []
            continue
        parts = report.divide(asset, span.hull)
        if len(parts) < 2:
            whole.append(span)
            continue
        made = ", ".join(f"{label} ({share:.0%})" for _, label, share in parts)
        told = f"{span}: into {pluralize(len(parts), 'part')}, {made}"
        shapes = tuple(part.shape for part, _, _ in parts)
        divisions.append(batch.HullDivision(span.hull, span.chance, shapes, told))
        labels.append(tuple(Label(label, round(share, _DIGITS), "propagated") for _, label, share in parts))
    return DivisionPlan(sure, tuple(divisions), tuple(labels), tuple(unsure), tuple(whole))


def _keep_likely(store: Store, report: SpanReport) -> None:
    """Keep which hulls likely span parts, for the status."""
    found = dict[str, dict[str, SpanLine]]()
    for asset, mesh in report.meshes.items():
        digests = hull_digests(mesh)
        likely = [span for span in report.spans_of(asset) if span.chance >= LIKELY]
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
