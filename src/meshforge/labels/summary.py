"""Labels put together for people: those that would be given, to be looked at before they are taken; and how far a
project is labelled, counted by source and confidence, planned in words, and drawn on contact sheets."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge import rendering
from meshforge.batch import AssetJob, ExecutionOptions, WorkerFailure, describe_jobs, run_isolated
from meshforge.common import AssetError, MeshForgeError
from meshforge.store import AssetFiles, Store, iterate_asset_index
from meshforge.symbolic import HUMAN_SOURCES, LABEL_SOURCES, Label, match_labels

if TYPE_CHECKING:
    from PIL.Image import Image


@dataclass(frozen=True, slots=True)
class LabelEvidence:
    """The label of one hull, None for one that is left without, and what says so: of what kind, and its name.

    kind: `hull`, `body` or another one of names, with ` by pattern` or ` nearly` behind it, or the kind of a file.
    """

    asset: str
    label: Label | None
    kind: str
    name: str


@dataclass(frozen=True, slots=True)
class Proposal:
    """Hulls that would get the same label, None for none, for the like reason.

    names: those that say so, the most frequent first; hulls, assets: how many there are, and in how many assets;
    low, high: how sure the label is.
    """

    label: str | None
    kind: str
    names: tuple[str, ...]
    hulls: int
    assets: int
    low: float
    high: float

    @property
    def is_unsure(self) -> bool:
        return self.label is not None and self.low < rendering.UNSURE


@dataclass(frozen=True, slots=True)
class Proposals:
    """What would be taken, and what would be left without a label; problems: a sentence on each thing left out.

    labelled: hulls whose label stays.
    """

    rows: tuple[Proposal, ...]
    left: tuple[Proposal, ...]
    labelled: int = 0
    problems: tuple[str, ...] = ()


def group_evidence(
    found: Iterable[LabelEvidence], vocabulary: Sequence[str], labelled: int, problems: Iterable[str]
) -> Proposals:
    """Return all evidence, put together by label, kind and whether it is sure; in the order of the vocabulary."""
    groups: dict[tuple[str | None, str, bool], list[LabelEvidence]] = {}
    for one in found:
        unsure = one.label is not None and one.label.confidence < rendering.UNSURE
        groups.setdefault((one.label.name if one.label else None, one.kind, unsure), []).append(one)
    rows = [_summarize_group(key[0], key[1], group) for key, group in groups.items()]
    order = {label: k for k, label in enumerate(vocabulary)}
    rows.sort(key=lambda row: (order.get(row.label or "", len(order)), row.is_unsure, -row.hulls, row.kind))
    return Proposals(
        tuple(row for row in rows if row.label is not None),
        tuple(row for row in rows if row.label is None),
        labelled,
        tuple(problems),
    )


def _summarize_group(label: str | None, kind: str, group: Sequence[LabelEvidence]) -> Proposal:
    names = Counter(one.name for one in group)
    sure = [one.label.confidence for one in group if one.label] or [0.0]
    ordered = sorted(names, key=lambda name: (-names[name], name))
    return Proposal(label, kind, tuple(ordered), len(group), len({one.asset for one in group}), min(sure), max(sure))


SURE = 0.9
"""Labels as certain as this are sure; those below `UNSURE` are not."""

PER_SHEET = 24
_COLUMNS = 6
_CELL = 320, 240
_TIMEOUT = 120.0


@dataclass(frozen=True, slots=True)
class SourceTally:
    """The labels of one source: how many are sure, likely and unsure."""

    source: str
    sure: int = 0
    likely: int = 0
    unsure: int = 0


@dataclass(frozen=True, slots=True)
class Tally:
    """All hulls of the assets that can be read. shares: of the sources that have labels here, in their order.

    doubtful: the assets with hulls that have no label or an unsure one, and how many, most first; unreadable: those
    that cannot be read, or whose labels cannot, and why.
    """

    hulls: int
    unlabelled: int
    shares: tuple[SourceTally, ...]
    doubtful: tuple[tuple[str, int], ...]
    unreadable: tuple[tuple[str, str], ...] = ()


def tally_labels(store: Store, progress: Callable[[], None] | None = None) -> Tally:
    """Count hulls by the source and confidence of their labels, as far as assets and their labels can be read."""
    counts = {source: [0, 0, 0] for source in LABEL_SOURCES}
    hulls = unlabelled = 0
    doubtful: dict[str, int] = {}
    unreadable: dict[str, str] = {}
    for asset, facts in iterate_asset_index(store.found, store.layout, progress=progress):
        if facts.error:
            unreadable[asset] = facts.error
            continue
        try:
            labels = match_labels(store.labels(asset), facts.hulls).labels.values()
        except MeshForgeError as error:
            unreadable[asset] = error.message
            continue
        levels = [(label.confidence < SURE) + (label.confidence < rendering.UNSURE) for label in labels]
        for label, level in zip(labels, levels, strict=True):
            counts[label.source][level] += 1
        hulls += len(facts.hulls)
        unlabelled += len(facts.hulls) - len(labels)
        doubtful[asset] = len(facts.hulls) - len(labels) + levels.count(2)
    shares = tuple(SourceTally(source, *levels) for source, levels in counts.items() if any(levels))
    order = sorted((asset for asset, count in doubtful.items() if count), key=lambda asset: -doubtful[asset])
    return Tally(
        hulls, unlabelled, shares, tuple((asset, doubtful[asset]) for asset in order), tuple(unreadable.items())
    )


def describe_label_plan(store: Store) -> str:
    """Return a sentence on how many assets there are of what, how many have labels, and how many of these a
    person's."""
    layout, found = store.layout, store.found
    places = {asset: layout.labels(asset) for asset in found.ids}
    jobs = [
        AssetJob(asset, path, found.base_of(path), places[asset] if places[asset].exists() else None)
        for asset, path in found.ids.items()
    ]
    by_people = sum(_has_human_label(store, job.id) for job in jobs if job.labels)
    return f"{describe_jobs(jobs)}, {by_people:,} of them by a person"


def _has_human_label(store: Store, asset: str) -> bool:
    try:
        return any(label.source in HUMAN_SOURCES for label in store.labels(asset).labels.values())
    except AssetError:  # reported when its turn comes
        return False


def write_contact_sheets(
    store: Store, folder: Path, assets: Sequence[str], progress: Callable[[], None] | None = None
) -> tuple[Path, ...]:
    """Write contact sheets of some assets, `labels-001.png` and so on, in which hulls have their labels' colours.

    Earlier sheets are replaced; what cannot be drawn is left out. Raises UsageError where one cannot be written.
    """
    vocabulary = store.vocabulary
    draw = partial(_draw, vocabulary)
    images = run_isolated(draw, store.asset_files(assets), ExecutionOptions(timeout=_TIMEOUT, progress=progress))
    drawn = zip(assets, images, strict=True)
    cells = ((asset, image) for asset, image in drawn if image and not isinstance(image, WorkerFailure))
    written = list[Path]()
    while batch := tuple(islice(cells, PER_SHEET)):
        written.append(folder / f"labels-{len(written) + 1:03d}.png")
        _write_sheet(written[-1], batch, vocabulary)
    for old in folder.glob("labels-[0-9][0-9][0-9]*.png"):
        if old not in written:
            old.unlink()
    return tuple(written)


def _draw(vocabulary: tuple[str, ...], place: AssetFiles) -> Image | None:
    try:
        mesh = place.read_mesh()
    except MeshForgeError:
        return None
    return rendering.render(mesh, color_by="label", size=_CELL, legend=False, vocabulary=vocabulary)


def _write_sheet(path: Path, batch: Sequence[tuple[str, Image]], vocabulary: Sequence[str]) -> None:
    images = [image for _, image in batch]
    colors = rendering.label_colors(vocabulary) | {"no label": rendering.UNLABELLED}
    rendering.write_png(path, rendering.make_contact_sheet(images, _COLUMNS, [asset for asset, _ in batch], colors))
