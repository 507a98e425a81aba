"""How far a project is: each asset, the program, what is stale; and the next sensible step, as a sentence and a
command."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from meshforge.labels import label_file_beside
from meshforge.project.learn import ProgramState
from meshforge.symbolic import Label

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

    @property
    def is_done(self) -> bool:
        """Whether its output is there and up to date."""
        return self.output in ("edited", "unchanged") and not self.stale


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
    }


@dataclass(frozen=True, slots=True)
class Advice:
    """What to do next; command: what to type, None where there is nothing to type."""

    say: str
    command: str | None = None


def advise(
    folder: Path,
    paths: Mapping[str, Path],
    assets: Sequence[AssetStatus],
    vocabulary: Sequence[str],
    rules: int | None,
    state: ProgramState,
    problem: str | None,
    first: Callable[[Sequence[str]], str | None],
) -> Advice:
    """The first thing that is missing on the way from assets to edited assets.

    paths: of the assets by id; first: which of some assets, by id, is to be demonstrated first.
    """
    if problem:
        return Advice(f"The program cannot be applied: {problem}")
    return (
        _advise_hulls(folder, assets)
        or _advise_labels(folder, paths, assets, vocabulary, rules)
        or _advise_propagation(folder, assets, rules)
        or _advise_demonstration(folder, paths, assets, rules, first)
        or _advise_program(folder, rules, state.outdated)
        or _advise_question(folder, assets, state.question)
        or _advise_output(folder, assets)
        or _advise_review(folder, assets)
    )


def _advise_hulls(folder: Path, assets: Sequence[AssetStatus]) -> Advice | None:
    bare = [asset for asset in assets if asset.hulls == 0 and asset.sources]
    if not bare:
        return None
    first = bare[0].id
    who = f"{first} has" if len(bare) == 1 else f"{len(bare)} assets, first {first}, have"
    return Advice(
        f"{who} no hulls: decompose what has none.",
        f"meshforge prepare {_quote_path(folder)} --decompose coacd",
    )


def _advise_labels(
    folder: Path,
    paths: Mapping[str, Path],
    assets: Sequence[AssetStatus],
    vocabulary: Sequence[str],
    rules: int | None,
) -> Advice | None:
    if rules is not None or any(asset.labelled or asset.demonstrated for asset in assets):
        return None
    words = "" if vocabulary else " --vocabulary a,b,c"
    command = f"meshforge label {_quote_path(folder)} --with file"
    if any(map(label_file_beside, paths.values())):
        return Advice("No hull has a label yet: take over the labels files beside the assets.", command)
    return Advice("No hull has a label yet: name a folder of labels files.", f"{command} --labels FOLDER{words}")


def _advise_propagation(folder: Path, assets: Sequence[AssetStatus], rules: int | None) -> Advice | None:
    bare = [asset for asset in assets if asset.hulls and not asset.labelled]
    whole = [asset for asset in assets if asset.hulls and asset.labelled == asset.hulls]
    if rules is not None or not bare or not whole:
        return None
    who = f"{bare[0].id} has" if len(bare) == 1 else f"{len(bare)} assets, first {bare[0].id}, have"
    return Advice(
        f"{who} no label: propagate those of the labelled assets.",
        f"meshforge label {_quote_path(folder)} --with propagate",
    )


def _advise_demonstration(
    folder: Path,
    paths: Mapping[str, Path],
    assets: Sequence[AssetStatus],
    rules: int | None,
    first: Callable[[Sequence[str]], str | None],
) -> Advice | None:
    if rules is not None or any(asset.demonstrated for asset in assets):
        return None
    labelled = [asset.id for asset in assets if asset.labelled]
    example = first(labelled) or next(iter(labelled or paths))
    return Advice(
        f"Nothing is demonstrated yet: show the steps of the edit on an asset or two, best first on {example}. "
        f"The names of hulls: meshforge info {_quote_path(Path(example))} --project {_quote_path(folder)}",
        f"meshforge demonstrate {_quote_path(folder)} {_quote_path(Path(example))} 'HULLS => ACTION' ...",
    )


def _advise_program(folder: Path, rules: int | None, outdated: bool) -> Advice | None:
    if rules is None:
        return Advice("Learn the program from the demonstrations.", f"meshforge synthesize {_quote_path(folder)}")
    if outdated:
        say = "Labels, demonstrations or settings changed since the program was learned: learn it again."
        return Advice(say, f"meshforge synthesize {_quote_path(folder)}")
    return None


def _advise_question(folder: Path, assets: Sequence[AssetStatus], question: str | None) -> Advice | None:
    """Nobody is asked who has applied the program as it is."""
    if not question or not _not_up_to_date(assets):
        return None
    rule, _, asset = question.partition(":")
    say = f"It is open what rule {rule} does on {asset}: answer the question, or apply the program as it is."
    return Advice(say, f"meshforge synthesize {_quote_path(folder)}")


def _not_up_to_date(assets: Sequence[AssetStatus]) -> list[AssetStatus]:
    return [asset for asset in assets if not asset.is_done and (asset.output != "failed" or asset.stale)]


def _advise_output(folder: Path, assets: Sequence[AssetStatus]) -> Advice | None:
    behind = _not_up_to_date(assets)
    if behind:
        return Advice(
            f"Apply the program: {_subject_of(behind)} not up to date.", f"meshforge apply {_quote_path(folder)}"
        )
    failed = [asset for asset in assets if asset.output == "failed"]
    if failed:
        some = f"{len(failed)} of {len(assets)} assets, first on {failed[0].id}"
        say = f"The program fails on {some}: fix what is named, then apply it again."
        return Advice(say, f"meshforge apply {_quote_path(folder)}")
    return None


def _advise_review(folder: Path, assets: Sequence[AssetStatus]) -> Advice:
    odd = [asset.id for asset in assets if asset.flags or asset.review == "flagged"]
    if odd:
        return Advice(f"All assets are edited; {len(odd)} of them want a look, first {odd[0]}.")
    return Advice(
        "All assets are edited and up to date: check them.", f"meshforge check {_quote_path(folder / 'edited')}"
    )


def _subject_of(assets: Sequence[AssetStatus]) -> str:
    return f"{assets[0].id} is" if len(assets) == 1 else f"{len(assets)} assets are"


def _quote_path(path: Path) -> str:
    """A path as one types it here."""
    here = Path.cwd()
    return shlex.quote(str(path.relative_to(here) if path.is_relative_to(here) else path))
