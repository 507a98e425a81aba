"""Labels that names, files or other assets would give, put together to be looked at before they are taken."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from meshforge.rendering import UNSURE
from meshforge.symbolic import Label


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
        return self.label is not None and self.low < UNSURE


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
    """All evidence, put together by label, kind and whether it is sure; in the order of the vocabulary."""
    groups: dict[tuple[str | None, str, bool], list[LabelEvidence]] = {}
    for one in found:
        unsure = one.label is not None and one.label.confidence < UNSURE
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
    sure = list(_confidences(group)) or [0.0]
    ordered = sorted(names, key=lambda name: (-names[name], name))
    return Proposal(label, kind, tuple(ordered), len(group), len({one.asset for one in group}), min(sure), max(sure))


def _confidences(group: Iterable[LabelEvidence]) -> Iterator[float]:
    return (one.label.confidence for one in group if one.label)
