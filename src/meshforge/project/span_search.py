"""Hulls of a project's assets that are to be split: found for the whole family together, or, of a large one, for each
asset by itself in a worker process, so that no process holds all of them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from meshforge import batch
from meshforge.common import ProjectError, describe_error, pluralize
from meshforge.formats import read
from meshforge.labels import NEW, HullSpan, ReferenceFamily, SpanReport, find_spans, read_reference_family
from meshforge.labels.family_comparison import Stage
from meshforge.labels.spans import pieces_file
from meshforge.store import SpanLine, Store, hull_digests
from meshforge.store.meshes import AssetFiles
from meshforge.symbolic import Asset, Label

LIKELY = 0.5
"""The probability from which a hull is named."""
MOST_TOGETHER = 300
"""Assets of a project that are compared all with all; of more, each with the labelled ones alone."""
_DIGITS = 3


@dataclass(frozen=True, eq=False, slots=True)
class DivisionPlan:
    """Which hulls of an asset are to be divided. divisions: these, with the labels of the parts of each; unsure: hulls
    that likely span parts, but not surely enough; whole: those that no plane divides."""

    sure: float
    divisions: tuple[batch.HullDivision, ...] = ()
    labels: tuple[tuple[Label, ...], ...] = ()
    unsure: tuple[HullSpan, ...] = ()
    whole: tuple[HullSpan, ...] = ()

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


def list_likely(report: SpanReport, asset: str) -> dict[str, SpanLine]:
    """The hulls of an asset that likely span parts, by name."""
    digests, likely = hull_digests(report.meshes[asset]), (s for s in report.spans_of(asset) if s.chance >= LIKELY)
    return {s.hull: SpanLine(geometry=digests[s.hull], chance=round(s.chance, _DIGITS), told=str(s)) for s in likely}


@dataclass(frozen=True, eq=False, slots=True)
class AssetSpans:
    """What was found of an asset. notes: what could not be looked at; likely: hulls that likely span parts, by name;
    seen: the digest of the preparation that it had."""

    plan: DivisionPlan
    notes: tuple[str, ...]
    likely: dict[str, SpanLine]
    seen: str | None


def search_spans(
    store: Store,
    assets: Sequence[str],
    sure: float,
    execution: batch.ExecutionOptions,
    stage: Stage,
) -> Iterator[tuple[str, AssetSpans | str]]:
    """What was found of each asset, or why it could not be looked at. Raises ProjectError where no hull has a label."""
    if len(store.assets()) <= MOST_TOGETHER:
        yield from _search_together(store, assets, sure, execution, stage)
        return
    family = read_reference_family(store, execution, stage)
    if family is None:
        remedy = "Label the hulls of one or two assets first: meshforge label, or the studio."
        problem = "no hull has a label, so nothing says what parts there are"
        raise ProjectError(problem, where=str(store.folder), remedy=remedy)
    rows = zip(assets, store.asset_files(assets), strict=True)
    work = [_Work(asset, files, pieces_file(store, asset)) for asset, files in rows]
    with stage(len(work), "looking for hulls that span parts") as advance:
        found = batch.execute(partial(_search_one, family, sure), work, replace(execution, progress=advance))
        for asset, one in zip(assets, found, strict=True):
            yield asset, one.why if isinstance(one, batch.WorkerFailure) else one


def _search_together(
    store: Store,
    assets: Iterable[str],
    sure: float,
    execution: batch.ExecutionOptions,
    stage: Stage,
) -> Iterator[tuple[str, AssetSpans | str]]:
    seen = {asset: batch.record_digest(store.layout.preparation(asset)) for asset in assets}
    report = find_spans(store, execution, stage)
    for asset, digest in seen.items():
        if asset in report.lost or asset not in report.meshes:
            yield asset, report.lost.get(asset, "it cannot be read")
        else:
            yield asset, _describe(report, asset, sure, digest)


def _describe(report: SpanReport, asset: str, sure: float, seen: str | None) -> AssetSpans:
    bare = tuple(f"{name} stands for no surface: left as it is" for name in report.bare.get(asset, ()))
    return AssetSpans(plan_divisions(report, asset, sure), bare, list_likely(report, asset), seen)


@dataclass(frozen=True, slots=True)
class _Work:
    """An asset to be looked at; pieces: the file of its fine pieces."""

    asset: str
    files: AssetFiles
    pieces: Path


def _search_one(family: ReferenceFamily, sure: float, work: _Work) -> AssetSpans | str:
    """What a worker finds of an asset, or why it failed."""
    try:
        seen = batch.record_digest(work.files.preparation)
        own = family.without(work.asset)
        report = own.find_spans(read(work.files.path), work.files.read_mesh(), work.pieces)
        return _describe(report, NEW, sure, seen)
    except Exception as error:  # one asset never stops the others
        return describe_error(error, str(work.files.path))
