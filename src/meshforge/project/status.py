"""How far a project is: each asset, the program, what is stale, and the next sensible step."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from meshforge import signoff, symbolic
from meshforge.signoff import BAR
from meshforge.signoff.question import NOT_OF_FAMILY

SignOffState = Literal["signed off", "sure", "held", "void", "excluded", "unknown"]
"""Sure: sure enough to be signed off, once its output is up to date; void: signed off, but something changed since;
unknown: not reviewed as it is now."""
OutputState = Literal["none", "edited", "unchanged", "failed"]


@dataclass(frozen=True, slots=True)
class AssetStatus:
    """One asset. hulls: how many, None where it cannot be read; labelled: how many of them have a label.

    output: what the last `apply` made; stale: what changed since then (`asset`, `labels`, `program`, ...), or `output`
    where written files changed or are gone. error: why it cannot be read, or why it failed.
    doubtful: labelled hulls that are gone, or have another geometry than was labelled.
    prepared: what was done to it before the program; sources: pieces and bodies without hulls that can be decomposed.
    flags: edits by hand that were left out, demonstrated hulls that are no more; review, review_note: what a person
    said about the output as it is.
    names, labels: of the hulls, in the asset's order; geometry: the digest of names and shapes of all hulls, empty
    where it cannot be read. after, after_labels, output_digest: hulls of the output, the label of each where that is
    known, and its files; corrections: edits by hand, a number.
    sign_off: whether it is signed off; signed_by: by whom; void: what changed since it was; excluded: why it is given
    up; probability, doubts: of its edit, as of the last review where nothing changed since, else None; found_since:
    doubts that were found after it was signed off, which stays so until a person answers. spans: hulls that likely hold
    more than one part, by name, in words, as `prepare --split-spanning` found them, or as they look like one that a
    person split.
    """

    id: str
    hulls: int | None
    labelled: int = 0
    doubtful: tuple[str, ...] = ()
    demonstrated: bool = False
    output: OutputState = "none"
    stale: tuple[str, ...] = ()
    error: str | None = None
    flags: tuple[str, ...] = ()
    review: Literal["accepted", "wrong"] | None = None
    prepared: tuple[str, ...] = ()
    sources: int = 0
    names: tuple[str, ...] = ()
    labels: tuple[symbolic.Label | None, ...] = ()
    geometry: str = ""
    after: int | None = None
    after_labels: tuple[str | None, ...] = ()
    output_digest: str | None = None
    corrections: int = 0
    review_note: str | None = None
    sign_off: SignOffState = "unknown"
    signed_by: Literal["tool", "person"] | None = None
    void: tuple[str, ...] = ()
    excluded: signoff.ExclusionReason | None = None
    found_since: tuple[str, ...] = ()
    probability: float | None = None
    doubts: tuple[signoff.Doubt, ...] = ()
    spans: Mapping[str, str] = field(default_factory=dict)

    @property
    def is_done(self) -> bool:
        """Whether its output is there and up to date."""
        return self.output in ("edited", "unchanged") and not self.stale

    def confidence_to_json(self) -> dict[str, Any]:
        """How sure its edit is, as `status`, `apply` and `info` say it in JSON."""
        share = None if self.probability is None else round(self.probability, 4)
        return {"probability": share, "doubts": [doubt.to_json() for doubt in self.doubts]}


@dataclass(frozen=True, slots=True)
class Status:
    """A project. assets: all, or those that were asked for. rules: of the program, None where there is none.

    outdated: whether it was learned from other demonstrations, labels, replies or settings than there are now.
    problem: why the program cannot be applied at all.

    lost: ids that have labels, demonstrations or corrections, but no asset.
    question: the id of the one that was open when the program was learned.
    """

    name: str
    assets: tuple[AssetStatus, ...]
    vocabulary: tuple[str, ...]
    rules: int | None
    outdated: bool
    problem: str | None
    lost: tuple[str, ...]
    next: Advice
    question: str | None = None
    bar: float = BAR

    @property
    def open_assets(self) -> tuple[AssetStatus, ...]:
        """Those to be looked at: neither sure enough nor excluded, the least probable first."""
        some = [asset for asset in self.assets if asset.sign_off in ("held", "void", "unknown")]
        return tuple(
            sorted(some, key=lambda asset: (-1.0 if asset.probability is None else asset.probability, asset.id))
        )

    @property
    def is_signed_off(self) -> bool:
        """Whether every asset of the family is signed off, and there is one."""
        counted = [asset.sign_off == "signed off" for asset in self.assets if asset.excluded != NOT_OF_FAMILY]
        return bool(counted) and all(counted)

    @property
    def is_signed_off_but_unsolved(self) -> bool:
        """Whether every asset of the family is signed off or given up, and some are signed off."""
        states = {asset.sign_off for asset in self.assets if asset.excluded != NOT_OF_FAMILY}
        return "signed off" in states and states <= {"signed off", "excluded"}

    def count(self, holds: Callable[[AssetStatus], bool]) -> int:
        """How many assets a condition holds for."""
        return sum(map(holds, self.assets))

    def to_json(self) -> dict[str, Any]:
        """The status for scripts."""
        return {
            "name": self.name,
            "vocabulary": list(self.vocabulary),
            "rules": self.rules,
            "outdated": self.outdated,
            "question": self.question,
            "problem": self.problem,
            "signed_off": self.count(lambda asset: asset.sign_off == "signed off"),
            "assets": [_asset_json(asset) for asset in self.assets],
            "lost": list(self.lost),
            "next": {"say": self.next.say, "command": self.next.command},
        }


def _asset_json(asset: AssetStatus) -> dict[str, Any]:
    return {
        "asset": asset.id,
        "hulls": asset.hulls,
        "sources": asset.sources,
        "prepared": list(asset.prepared),
        "spans": list(asset.spans.values()),
        "labelled": asset.labelled,
        "doubtful": list(asset.doubtful),
        "demonstrated": asset.demonstrated,
        "output": asset.output,
        "stale": list(asset.stale),
        "error": asset.error,
        "flags": list(asset.flags),
        "review": asset.review,
        "sign_off": asset.sign_off,
        "signed_by": asset.signed_by,
        "void": list(asset.void),
        "excluded": asset.excluded,
        "found_since": list(asset.found_since),
        **asset.confidence_to_json(),
    }


@dataclass(frozen=True, slots=True)
class Advice:
    """What to do next; command: what to type, None where there is nothing to type."""

    say: str
    command: str | None = None
