"""What learning came to, as text: the result for stdout, and remarks on it for stderr."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from meshforge.synthesis import Ambiguous, Found, Nearest, NeedsRepair, NoProgram, Outcome, TimedOut


@dataclass(frozen=True, slots=True)
class About:
    """What there is to tell besides the outcome.

    folder: of the project, as a person types it; assets, looked_at, readable: how many there are, are learned from,
    and can be read of these; answers, repairs: how many were said so far; kept: whether the program was kept.
    stopped: whether a person ended the search.
    """

    folder: Path
    assets: int
    in_use: int
    readable: int
    answers: int = 0
    repairs: int = 0
    kept: bool = True
    stopped: bool = False

    @property
    def folder_word(self) -> str:
        return shlex.quote(str(self.folder))


def result(outcome: Outcome, about: About) -> str:
    """The result: a program, or why there is none."""
    from typing import assert_never

    from meshforge.synthesis import Ambiguous, Found, NeedsRepair, NoProgram, TimedOut

    match outcome:
        case Found() | Ambiguous():
            return str(outcome.program).rstrip("\n")
        case NeedsRepair():
            return "\n".join(_repairs(outcome, about))
        case NoProgram():
            return "\n".join(_failure(outcome))
        case TimedOut():
            return "\n".join(_unfinished(outcome, about))
        case _:
            assert_never(outcome)


def remarks(outcome: Outcome, about: About) -> str:
    """How far the result can be trusted, and what to do next."""
    from meshforge.synthesis import Ambiguous, Found

    lines = [*_stale(outcome, about), *_overruled(outcome)]
    if isinstance(outcome, Found | Ambiguous):
        took = f"learned in {sum(outcome.seconds.values()):.2f} s{_used(about)}"
        lines += [f"{took}, kept as {about.folder / 'program.mf'}" if about.kept else took]
        lines += _settled(outcome, about)
        lines += [f"Next: meshforge apply {about.folder_word}"] if about.kept else []
    return "\n".join(lines)


def _used(about: About) -> str:
    from meshforge.words import counted

    said = [counted(about.answers, "answer")] if about.answers else []
    said += [counted(about.repairs, "mended label")] if about.repairs else []
    return f" with {' and '.join(said)}" if said else ""


def _settled(outcome: Found | Ambiguous, about: About) -> Iterator[str]:
    from meshforge.words import listed

    if outcome.settled:
        all_ = "your one asset" if about.assets == 1 else f"your {about.assets:,} assets"
        part = "were looked at" if about.in_use < about.assets else "can be read"
        seen = all_ if about.readable == about.assets else f"the {about.readable} of {all_} that {part}"
        yield f"settled: all believable readings agree on {seen}"
        return
    if outcome.question:
        yield f"not settled: it is open what rule {outcome.question.rule} does on {outcome.question.asset}"
    else:
        yield from _almost(outcome)
        if outcome.sample:
            yield f"After applying, look at {listed(outcome.sample)} first: these tell best whether it is right"
    if outcome.hint:
        yield f"To be surer, demonstrate {outcome.hint.asset}: {outcome.hint.why}"
        yield f"  meshforge demonstrate {about.folder_word} {shlex.quote(outcome.hint.asset)} 'HULLS => ACTION' ..."


def _almost(outcome: Found | Ambiguous) -> Iterator[str]:
    """Where a reading that is not likely enough to ask about would do something else."""
    from meshforge.words import listed

    rows = _doubtful(outcome)
    rules, assets = sorted({str(rule) for rule, _ in rows}), sorted({asset for _, asset in rows})
    if rows:
        many = "s" * (len(rules) > 1)
        yield f"almost settled: rule{many} {listed(rules)} might mean something else on {listed(assets)}; look there"


def _doubtful(outcome: Found | Ambiguous) -> set[tuple[int, str]]:
    """The rules and assets on which a believable reading differs from the program."""
    from meshforge.synthesis.readings.weighed import BELIEVABLE

    believable = (reading for reading in outcome.readings if reading.belief >= BELIEVABLE)
    return {(reading.rule, asset) for reading in believable for asset in reading.differs_on}


def _stale(outcome: Outcome, about: About) -> Iterator[str]:
    for answer in outcome.stale:
        said = f"{answer.rule}:{answer.asset}"
        yield f"the answer {said} no longer fits what is there, and is left out"
        yield f"  to take it back: meshforge synthesize {about.folder_word} --forget {shlex.quote(said)}"


def _overruled(outcome: Outcome) -> Iterator[str]:
    from meshforge.words import listed

    if outcome.overruled:
        yield f"no program does what is demonstrated and keeps the accepted results of {listed(outcome.overruled)};"
        yield "  it was learned without these: look at them again after applying"


def _failure(outcome: NoProgram) -> Iterator[str]:
    from meshforge.project.settings import orientation_text
    from meshforge.project.toml_edit import toml_value

    yield f"no program found: {outcome.why}"
    yield from (f"  learned: {rule}" for rule in outcome.rules)
    yield from _nearest(outcome.nearest)
    yield from (f"- {line}" for line in outcome.advice)
    if not outcome.advice:
        yield "Look at the labels of these hulls (meshforge info), or at what was demonstrated there."
    if outcome.suggested:
        yield f"Another orientation would do: {outcome.suggested.why}."
        yield "  in meshforge.toml write: orient = " + toml_value(orientation_text(outcome.suggested.orient))


def _unfinished(outcome: TimedOut, about: About) -> Iterator[str]:
    number = len(outcome.rules) + 1
    if about.stopped:
        yield f"stopped while rule {number} was searched for"
    else:
        yield f"the time ran out while rule {number} was searched for; --budget SECONDS gives more"
    yield from (f"  learned: {rule}" for rule in outcome.rules)
    yield from _nearest(outcome.nearest) if outcome.nearest else ()


def _nearest(nearest: Nearest) -> Iterator[str]:
    from meshforge.language import show

    yield f"nearest for rule {nearest.rule}: {show(nearest.extractor)}; on {nearest.asset} it"
    if nearest.extra:
        yield f"  selects too much: {', '.join(nearest.extra)}"
    if nearest.missing:
        yield f"  leaves out:       {', '.join(nearest.missing)}"


def _repairs(outcome: NeedsRepair, about: About) -> Iterator[str]:
    from meshforge.cli.cards import change, sureness
    from meshforge.words import counted

    yield f"no program yet: {counted(len(outcome.repairs), 'label')} may be wrong"
    for repair in outcome.repairs:
        yield f"  {change(repair)}" + (f"  ({sureness(repair)} sure)" if sureness(repair) else "")
        yield f"    {repair.why}"
    if outcome.proposed:
        yield "With that, the program is:"
        yield from (f"  {rule}" for rule in outcome.proposed.rules)
    command = f"meshforge synthesize {about.folder_word}"
    yield f"To look at each: {command} in a terminal; to mend all: {command} --accept-repairs"
    yield f"To keep the labels as they are: {command} --reject-repairs"
