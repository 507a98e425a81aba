"""How far a project is: each asset, the program, what is stale; and the next sensible step, as a sentence and a
command."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from meshforge.common import pluralize, quote_path
from meshforge.labels import label_command, label_file_beside
from meshforge.project.learn import ProgramState
from meshforge.signoff import BAR, Doubt
from meshforge.symbolic import Label

SignOffState = Literal["signed off", "sure", "held", "void", "set aside", "unknown"]
"""Sure: sure enough to be signed off, once its output is up to date; void: signed off, but something changed since;
unknown: not reviewed as it is now."""
OutputState = Literal["none", "edited", "unchanged", "failed"]


@dataclass(frozen=True, slots=True)
class AssetStatus:
    """One asset. hulls: how many, None where it cannot be read; labelled: how many of them have a label.

    output: what the last `apply` made; stale: what changed since then (`asset`, `labels`, `program`, ...), or `output`
    where written files are gone. error: why it cannot be read, or why it failed.
    doubtful: labelled hulls that are gone, or have another geometry than was labelled.
    prepared: what was done to it before the program; sources: pieces and bodies without hulls that can be decomposed.
    flags: edits by hand that were left out, demonstrated hulls that are no more; review, review_note: what a person
    said about the output as it is.
    names, labels: of the hulls, in the asset's order; geometry: the digest of names and shapes of all hulls, empty
    where it cannot be read. after, after_labels, output_digest: hulls of the output, the label of each where that is
    known, and its files; corrections: edits by hand, a number.
    sign_off: whether it is signed off; signed_by: by whom; void: what changed since it was; probability, doubts: of its
    edit, as of the last review where nothing changed since, else None.
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
    review: Literal["accepted", "flagged"] | None = None
    prepared: tuple[str, ...] = ()
    sources: int = 0
    names: tuple[str, ...] = ()
    labels: tuple[Label | None, ...] = ()
    geometry: str = ""
    after: int | None = None
    after_labels: tuple[str | None, ...] = ()
    output_digest: str | None = None
    corrections: int = 0
    review_note: str | None = None
    sign_off: SignOffState = "unknown"
    signed_by: Literal["tool", "person"] | None = None
    void: tuple[str, ...] = ()
    probability: float | None = None
    doubts: tuple[Doubt, ...] = ()

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

    outdated: whether it was learned from other demonstrations, labels or settings than there are now.
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
        """Those to be looked at: neither sure enough nor set aside, the least probable first."""
        some = [asset for asset in self.assets if asset.sign_off in ("held", "void", "unknown")]
        return tuple(
            sorted(some, key=lambda asset: (-1.0 if asset.probability is None else asset.probability, asset.id))
        )

    @property
    def is_signed_off(self) -> bool:
        """Whether every asset is signed off or set aside."""
        return all(asset.sign_off in ("signed off", "set aside") for asset in self.assets)

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
        **asset.confidence_to_json(),
    }


@dataclass(frozen=True, slots=True)
class Advice:
    """What to do next; command: what to type, None where there is nothing to type."""

    say: str
    command: str | None = None


@dataclass(frozen=True, slots=True)
class Adviser:
    """Finds what to do next in a project. paths: of the assets by id; rules: of the program, None where there is none.

    problem: why the program cannot be applied; first: which of some assets, by id, is to be demonstrated first;
    count_names: how many hulls without a label have names that say one.
    """

    folder: Path
    paths: Mapping[str, Path]
    assets: Sequence[AssetStatus]
    vocabulary: Sequence[str]
    rules: int | None
    state: ProgramState
    problem: str | None
    first: Callable[[Sequence[str]], str | None]
    count_names: Callable[[], int]

    def advise(self) -> Advice:
        """The first thing that is missing on the way from assets to edited assets."""
        if self.problem:
            return Advice(f"The program cannot be applied: {self.problem}")
        return (
            self._advise_hulls()
            or (self._advise_before_learning() if self.rules is None else None)
            or self._advise_program()
            or self._advise_output()
            or self._advise_review()
        )

    def _advise_hulls(self) -> Advice | None:
        bare = [asset for asset in self.assets if asset.hulls == 0 and asset.sources]
        if not bare:
            return None
        return Advice(
            f"{_name_assets(bare)} no hulls: decompose what has none.", self._type("prepare --decompose coacd")
        )

    def _advise_before_learning(self) -> Advice | None:
        """Labels, then a demonstration."""
        shown = any(asset.demonstrated for asset in self.assets)
        if not shown and not any(asset.labelled for asset in self.assets):
            command = self._type("label --with file")
            if any(map(label_file_beside, self.paths.values())):
                return Advice("No hull has a label yet: take over the labels files beside the assets.", command)
            return self._advise_label_source()
        bare = [asset for asset in self.assets if asset.hulls and not asset.labelled]
        if bare and any(asset.hulls and asset.labelled == asset.hulls for asset in self.assets):
            say = f"{_name_assets(bare)} no label: propagate those of the labelled assets."
            return Advice(say, self._type("label --with propagate"))
        return None if shown else self._advise_demonstration()

    def _advise_label_source(self) -> Advice:
        """Names where they say something, else by hand."""
        if count := self.count_names():
            say = f"No hull has a label yet: the names of {pluralize(count, 'hull')} say what they are."
            return Advice(say, self._type("label --with names"))
        counts = sorted(len(asset.names) for asset in self.assets if asset.names)
        if not counts:
            return Advice("No asset has hulls that can be read: see the remarks.")
        usual = next(asset for asset in self.assets if len(asset.names) == counts[(len(counts) - 1) // 2])
        say = (
            f"No hull has a label yet: label those of an asset by hand, best first {usual.id}, here or in the studio. "
            f"The names of hulls: meshforge info {quote_path(Path(usual.id))} --project {quote_path(self.folder)}"
        )
        return Advice(say, label_command(self.folder, usual.id, usual.names[0], self.vocabulary))

    def _advise_demonstration(self) -> Advice:
        labelled = [asset.id for asset in self.assets if asset.labelled]
        example = self.first(labelled) or next(iter(labelled or self.paths))
        quoted = quote_path(Path(example))
        return Advice(
            f"Nothing is demonstrated yet: show the steps of the edit on an asset or two, best first on {example}. "
            f"The names of hulls: meshforge info {quoted} --project {quote_path(self.folder)}",
            self._type(f"demonstrate {quoted} 'HULLS => ACTION' ..."),
        )

    def _advise_program(self) -> Advice | None:
        if self.rules is None:
            return Advice("Learn the program from the demonstrations.", self._type("synthesize"))
        if self.state.outdated:
            say = "Labels, demonstrations or settings changed since the program was learned: learn it again."
            return Advice(say, self._type("synthesize"))
        if self.state.question and self._behind:  # nobody is asked who has applied the program as it is
            rule, _, asset = self.state.question.partition(":")
            say = f"It is open what rule {rule} does on {asset}: answer the question, or apply the program as it is."
            return Advice(say, self._type("synthesize"))
        return None

    @property
    def _behind(self) -> list[AssetStatus]:
        """The assets whose output is not up to date."""
        return [asset for asset in self.assets if not asset.is_done and (asset.output != "failed" or asset.stale)]

    def _advise_output(self) -> Advice | None:
        if behind := self._behind:
            who = f"{behind[0].id} is" if len(behind) == 1 else f"{len(behind)} assets are"
            return Advice(f"Apply the program: {who} not up to date.", self._type("apply"))
        failed = [asset for asset in self.assets if asset.output == "failed"]
        if not failed:
            return None
        some = f"{len(failed)} of {len(self.assets)} assets, first on {failed[0].id}"
        return Advice(f"The program fails on {some}: fix what is named, then apply it again.", self._type("apply"))

    def _advise_review(self) -> Advice:
        odd = [asset.id for asset in self.assets if asset.flags or asset.review == "flagged"]
        if odd:
            return Advice(f"All assets are edited; {len(odd)} of them want a look, first {odd[0]}.")
        edited = quote_path(self.folder / "edited")
        return Advice("All assets are edited and up to date: check them.", f"meshforge check {edited}")

    def _type(self, words: str) -> str:
        """A command on the project as one types it here; words: its name, and what follows the project."""
        command, *more = words.split(" ", 1)
        return " ".join(["meshforge", command, quote_path(self.folder), *more])


def _name_assets(assets: Sequence[AssetStatus]) -> str:
    first = assets[0].id
    return f"{first} has" if len(assets) == 1 else f"{len(assets)} assets, first {first}, have"
