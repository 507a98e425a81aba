"""Hulls of a project's assets that are to be split: found for the whole family together, or, of a large one, for each
asset by itself in a worker process, so that no process holds all of them."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import starmap
from pathlib import Path
from types import MappingProxyType
from typing import Any

from meshforge import batch
from meshforge.batch.preparation.decompose import matches_only
from meshforge.batch.preparation.record import PreparationStep
from meshforge.common import ProjectError, describe_error, join_names
from meshforge.formats import read
from meshforge.label_model import WHOLE
from meshforge.labels import NEW, HullSpan, LabelledPart, ReferenceFamily, SpanReport, find_spans, read_reference_family
from meshforge.labels.family_comparison import Stage
from meshforge.project.preparation_plan import SplitSettings
from meshforge.project.span_splits import LIKELY, Split, make_splits
from meshforge.store import SpanLine, SpanPart, Store, hull_digests
from meshforge.store.meshes import AssetFiles
from meshforge.symbolic import Asset, Label

MOST_TOGETHER = 300
"""Assets of a project that are compared all with all; of more, each with the labelled ones alone."""
MADE_ANEW = "made anew with its body"
"""Why a hull of one part is replaced where its body is rebuilt."""
_DIGITS = 3
_TOLD = 3  # hulls that a note names


@dataclass(frozen=True, eq=False, slots=True)
class SplitPlan:
    """Which hulls of an asset are to be split.

    splits: what is made of hulls; spanning: hulls that surely span parts; unsure: those that likely do, but not surely
    enough; whole: sure ones of which nothing can be made; single: those that a person said to be one part; rebuilt: the
    bodies of which all hulls are made anew.
    """

    how: SplitSettings
    splits: tuple[Split, ...] = ()
    spanning: tuple[HullSpan, ...] = ()
    unsure: tuple[HullSpan, ...] = ()
    whole: tuple[HullSpan, ...] = ()
    single: tuple[HullSpan, ...] = ()
    rebuilt: tuple[str, ...] = ()

    @property
    def notes(self) -> list[str]:
        """On hulls that stay as they are."""
        cannot = "no surface to rebuild it by" if self.how.rebuild else "no plane divides it"
        return [
            *(f"{span}: left as it is, since a person said that it is one part" for span in self.single),
            *self._tell_unsure(),
            *(f"{span}: {cannot}; split it by hand: meshforge split" for span in self.whole),
        ]

    def _tell_unsure(self) -> list[str]:
        if not self.unsure:
            return []
        more = len(self.unsure) - _TOLD
        named = "; ".join(map(str, self.unsure[:_TOLD])) + (f"; and {more} more" if more > 0 else "")
        return [f"below {self.how.sure:.0%}, left for meshforge review to ask about: {named}"]

    def chance_of(self, hull: str) -> float | None:
        """The probability for which a hull is split; None where it is only made anew with its body."""
        return next((span.chance for span in self.spanning if span.hull == hull), None)

    def divide(self, source: Asset, before: batch.Preparation) -> tuple[batch.Preparation, dict[str, Label]]:
        """A preparation with the step that splits them, and the label of each part by its name."""
        return make_splits(source, before, self.splits, self.settings)

    @property
    def settings(self) -> dict[str, Any]:
        """Of the step, besides the probabilities."""
        rebuilt = {"rebuilt": list(self.rebuilt)} if self.rebuilt else {}
        only = {"only": list(self.how.only)} if self.how.only else {}
        return {"sure": self.how.sure, "pieces": self.how.pieces, **rebuilt, **only}


def list_likely(
    report: SpanReport, asset: str, least: float = LIKELY, without: Collection[str] = ()
) -> dict[str, Split]:
    """The hulls of an asset that span parts with a probability of at least `least`, by name, and their parts; no parts
    where no plane divides a hull. One that only reaches into a part which another hull stands for is not among them.

    without: hulls that are not looked at.
    """
    digests, found = hull_digests(report.meshes[asset]), dict[str, Split]()
    for span in report.spans_of(asset):
        if span.chance < least or span.hull in without:
            continue
        parts = report.divide(asset, span.hull)
        if len(parts) == 1 and parts[0][2] >= WHOLE:
            continue
        one = make_split(span, digests[span.hull], parts if len(parts) > 1 else [])
        found[span.hull] = replace(one, span=one.span.model_copy(update={"pieces": report.engine}))
    return found


def make_split(span: HullSpan, geometry: str, parts: Sequence[LabelledPart], with_body: bool = False) -> Split:
    """A hull with the parts that take its place. geometry: its digest; with_body: whether it spans no parts itself."""
    rows = tuple(SpanPart(label=label, share=round(share, _DIGITS)) for _, label, share in parts)
    told = f"{span.hull}, {MADE_ANEW}" if with_body else str(span)
    line = SpanLine(geometry=geometry, chance=round(span.chance, _DIGITS), told=told, parts=rows)
    return Split(span.hull, line, tuple(part.shape for part, _, _ in parts), with_body)


def plan_splits(
    report: SpanReport, asset: str, how: SplitSettings, single: Mapping[str, str] = MappingProxyType({})
) -> SplitPlan:
    """How the hulls of an asset that span parts with a probability of at least `how.sure` are split.

    single: the digests of the hulls that a person said to be one part, by name.
    """
    return _plan_likely(report, asset, how, single, list_likely(report, asset, min(how.sure, LIKELY)))


def _plan_likely(
    report: SpanReport, asset: str, how: SplitSettings, single: Mapping[str, str], likely: Mapping[str, Split]
) -> SplitPlan:
    spans = [span for span in report.spans_of(asset) if span.hull in likely and _matches(report, asset, span.hull, how)]
    left = tuple(span for span in spans if single.get(span.hull) == likely[span.hull].span.geometry)
    asked = [span for span in spans if span not in left]
    sure = tuple(span for span in asked if span.chance >= how.sure)
    plan = SplitPlan(how, (), sure, tuple(span for span in asked if span not in sure), (), left)
    if how.rebuild:
        return _rebuild(report, asset, plan)
    splits = tuple(likely[span.hull] for span in sure if likely[span.hull].shapes)
    return replace(plan, splits=splits, whole=tuple(span for span in sure if not likely[span.hull].shapes))


def _matches(report: SpanReport, asset: str, hull: str, how: SplitSettings) -> bool:
    return any(matches_only(name, how.only) for name in (hull, report.meshes[asset].hull_of(hull).body))


def _rebuild(report: SpanReport, asset: str, plan: SplitPlan) -> SplitPlan:
    """The plan with all hulls made anew, part by part, of each body of which a hull surely spans parts."""
    mesh = report.meshes[asset]
    digests, spans = hull_digests(mesh), {span.hull: span for span in report.spans_of(asset)}
    bodies = dict.fromkeys(mesh.hull_of(span.hull).body for span in plan.spanning)
    named = {span.hull for span in plan.spanning}
    made = {body: rows for body in bodies if (rows := report.rebuild(asset, body))}
    splits = list[Split]()
    for rows in made.values():
        for hull, parts in rows.items():
            splits.append(make_split(spans[hull], digests[hull], parts, with_body=hull not in named))

    def leave(spans: Iterable[HullSpan]) -> tuple[HullSpan, ...]:
        return tuple(span for span in spans if mesh.hull_of(span.hull).body not in made)

    return replace(
        plan,
        splits=tuple(splits),
        unsure=leave(plan.unsure),
        whole=leave(plan.spanning),
        single=leave(plan.single),
        rebuilt=tuple(made),
    )


@dataclass(frozen=True, eq=False, slots=True)
class AssetSpans:
    """What was found of an asset. notes: what could not be looked at; likely: hulls that likely span parts, by name;
    seen: the digest of the preparation that it had."""

    plan: SplitPlan
    notes: tuple[str, ...]
    likely: Mapping[str, Split]
    seen: str | None


def search_spans(
    store: Store, assets: Sequence[str], how: SplitSettings, execution: batch.ExecutionOptions, stage: Stage
) -> Iterator[tuple[str, AssetSpans | str]]:
    """What was found of each asset, or why it could not be looked at. Raises ProjectError where no hull has a label."""
    if len(store.assets()) <= MOST_TOGETHER:
        yield from _search_together(store, assets, how, execution, stage)
        return
    family = read_reference_family(store, execution, stage, how.pieces)
    if family is None:
        remedy = "Label the hulls of one or two assets first: meshforge label, or the studio."
        problem = "no hull has a label, so nothing says what parts there are"
        raise ProjectError(problem, where=str(store.folder), remedy=remedy)
    rows = zip(assets, store.asset_files(assets), strict=True)
    work = list(starmap(_Work, rows))
    with stage(len(work), "looking for hulls that span parts") as advance:
        single = store.single_parts().assets
        found = batch.execute(partial(_search_one, family, how, single), work, replace(execution, progress=advance))
        for asset, one in zip(assets, found, strict=True):
            yield asset, one.why if isinstance(one, batch.WorkerFailure) else one


def _search_together(
    store: Store, assets: Iterable[str], how: SplitSettings, execution: batch.ExecutionOptions, stage: Stage
) -> Iterator[tuple[str, AssetSpans | str]]:
    seen = {asset: _Steps.of(store.layout.preparation(asset)) for asset in assets}
    report, single = find_spans(store, execution, stage, how.pieces), store.single_parts().assets
    for asset, own in seen.items():
        if asset in report.lost or asset not in report.meshes:
            yield asset, report.lost.get(asset, "it cannot be read")
        else:
            yield asset, _describe(report, asset, how, single.get(asset, {}), own)


def _describe(
    report: SpanReport, asset: str, how: SplitSettings, single: Mapping[str, str], seen: _Steps
) -> AssetSpans:
    bare = (f"{name} stands for no surface: left as it is" for name in report.bare.get(asset, ()))
    matches = not how.only or any(_matches(report, asset, hull.name, how) for hull in report.meshes[asset].hulls)
    missed = [] if matches else [f"no hull or body matches {join_names(how.only)}"]
    notes = (*report.notes.get(asset, ()), *bare, *missed)
    found = list_likely(report, asset, min(how.sure, LIKELY), seen.list_parts(how))
    likely = {hull: one for hull, one in found.items() if one.span.chance >= LIKELY}
    return AssetSpans(_plan_likely(report, asset, how, single, found), notes, likely, seen.digest)


@dataclass(frozen=True, slots=True)
class _Steps:
    """The preparation of an asset when it was looked at: its digest, None for none, and its steps."""

    digest: str | None
    steps: tuple[PreparationStep, ...]

    @staticmethod
    def of(folder: Path) -> _Steps:
        digest = batch.record_digest(folder)
        return _Steps(digest, batch.read_steps(folder) or ())

    def list_parts(self, how: SplitSettings) -> frozenset[str]:
        """The hulls that such a split made already: it would not make better ones of them."""
        steps = (step for step in self.steps if step.do == "divide" and ("rebuilt" in step.settings or not how.rebuild))
        return frozenset(name for step in steps for entry in step.replaced for name in entry.made)


@dataclass(frozen=True, slots=True)
class _Work:
    """An asset to be looked at."""

    asset: str
    files: AssetFiles


def _search_one(
    family: ReferenceFamily, how: SplitSettings, single: Mapping[str, Mapping[str, str]], work: _Work
) -> AssetSpans | str:
    try:
        seen = _Steps.of(work.files.preparation)
        own = family.without(work.asset)
        report = own.find_spans(read(work.files.path), work.files.read_mesh())
        return _describe(report, NEW, how, single.get(work.asset, {}), seen)
    except Exception as error:  # one asset never stops the others
        return describe_error(error, str(work.files.path))
