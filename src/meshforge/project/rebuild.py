"""Bodies with a hull that spans parts rebuilt: new hulls for all of the body, part by part."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import AbstractContextManager, nullcontext

from meshforge import batch
from meshforge.common import MeshForgeError, pluralize
from meshforge.formats import read
from meshforge.labels import HullSpan, SpanReport, find_spans
from meshforge.labels.family_comparison import Stage, ignore_stage
from meshforge.project.prepare import PreparationResult, exchange_preparation
from meshforge.project.span_search import make_split
from meshforge.project.span_splits import make_splits
from meshforge.project.spans import SURE_TO_SPAN, choose_assets
from meshforge.store import Store, hull_digests
from meshforge.symbolic import HUMAN_SOURCES, Label


def rebuild_spanning(
    store: Store,
    assets: Iterable[str] | None = None,
    *,
    sure: float = SURE_TO_SPAN,
    dry_run: bool = False,
    execution: batch.ExecutionOptions = batch.EXECUTION_DEFAULTS,
    stage: Stage = ignore_stage,
    write_block: Callable[[str], AbstractContextManager[object]] = nullcontext,
) -> Iterator[PreparationResult]:
    """Rebuild the bodies of which a hull spans parts with a probability of at least `sure`, one step an asset.

    All hulls of such a body that stand for its surface are replaced by hulls of one part each. Hulls that a person said
    to be one part do not count. assets: which may be rebuilt, all when None; all of the project are compared. dry_run:
    nothing is written, and `notes` say what would be done.
    Raises UsageError for a probability that is none, ProjectError where no hull has a label or no asset can be read.
    """
    ids = choose_assets(store, assets, sure)
    seen = {asset: batch.record_digest(store.layout.preparation(asset)) for asset in ids}
    report, single = find_spans(store, execution, stage), store.single_parts()
    for asset in ids:
        if asset in report.lost or asset not in report.meshes:
            yield PreparationResult(asset, problems=(report.lost.get(asset, "it cannot be read"),))
            continue
        digests = hull_digests(report.meshes[asset])
        spanning = [
            span
            for span in report.spans_of(asset)
            if span.chance >= sure and not single.holds(asset, span.hull, digests[span.hull])
        ]
        try:
            with nullcontext() if dry_run else write_block(asset):
                yield _rebuild_one(store, asset, report, spanning, {"sure": sure}, seen[asset], dry_run)
        except MeshForgeError as error:
            yield PreparationResult(asset, problems=(error.message,))


def _rebuild_one(
    store: Store,
    asset: str,
    report: SpanReport,
    spanning: list[HullSpan],
    settings: Mapping[str, float],
    seen: str | None,
    dry_run: bool,
) -> PreparationResult:
    """What becomes of one asset. spanning: the hulls for which it is rebuilt; settings: of the step."""
    mesh, rows = report.meshes[asset], {span.hull: span for span in report.spans_of(asset)}
    bodies = dict.fromkeys(mesh.hull_of(span.hull).body for span in spanning)
    made = [row for body in bodies for row in report.rebuild(asset, body).items()]
    notes = [f"{name} stands for no surface: left as it is" for name in report.bare.get(asset, ())]
    if not made:
        return PreparationResult(asset, notes=(*(f"{span}: no surface to rebuild it by" for span in spanning), *notes))
    count = sum(len(parts) for _, parts in made)
    told = f"{'; '.join(map(str, spanning))}: {pluralize(len(made), 'hull')} into {count}"
    digests, named = hull_digests(mesh), {span.hull for span in spanning}
    splits = [
        make_split(rows[hull], digests[hull], parts, None if hull in named else f"{hull}, made anew with its body")
        for hull, parts in made
    ]
    before = batch.read_preparation(store.layout.preparation(asset)) or batch.Preparation()
    more = {**settings, "rebuilt": list(bodies)}
    after, labels = make_splits(read(store.path(asset)), before, splits, more)
    entries = after.steps[-1].replaced
    if dry_run:
        return PreparationResult(asset, notes=tuple(notes), planned=entries)
    known = {
        name: labels[name]
        for entry in entries
        for name in entry.made
        if labels[name].name in store.vocabulary and not _is_told(mesh.hull_of(entry.what).annotation, labels[name])
    }
    changed = exchange_preparation(store, asset, after, seen, known)
    return PreparationResult(asset, entries, (*changed, f"{', '.join(bodies)} rebuilt: {told}", *notes))


def _is_told(known: Label | None, label: Label) -> bool:
    """Whether a person gave the old hull the same label, which the new ones take from it."""
    return known is not None and known.source in HUMAN_SOURCES and known.name == label.name
