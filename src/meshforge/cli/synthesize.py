"""`meshforge synthesize`: learn the program of a project from its demonstrations; the result as text for stdout, and
remarks on it for stderr."""

import shlex
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Annotated, Literal, assert_never

import typer

from meshforge import synthesis
from meshforge.cli.console import progress
from meshforge.cli.options import Json, takes
from meshforge.cli.terminal import catch_interrupt, print_json, remark
from meshforge.common import UsageError, escape_name, join_names, pluralize
from meshforge.labels import propose_class_names
from meshforge.language import show
from meshforge.project import format_next, learn_program, select_assets, try_goals_as_shown
from meshforge.store import MeshCache, Store, orientation_text, toml_value


@dataclass(frozen=True, slots=True)
class SynthesizeArguments:
    """What is typed after `meshforge synthesize`."""

    project: Annotated[Path, typer.Argument(help="A project folder.")]
    strategy: Annotated[
        Literal["default", "paper"], typer.Option("--strategy", help="paper: by the algorithms of the paper.")
    ] = "default"
    layers: Annotated[
        Literal["S", "S+T", "S+G", "S+T+G"],
        typer.Option("--layers", help="What rules may ask for: labels (S), touching (T), directions (G)."),
    ] = "S+T+G"
    extractors: Annotated[
        list[str] | None,
        typer.Option("--with", help="A plug-in's extractor that rules may use from now on.", metavar="NAME"),
    ] = None
    no_repair: Annotated[bool, typer.Option("--no-repair", help="Take all labels for right.")] = False
    budget: Annotated[float, typer.Option("--budget", min=0.1, help="Seconds to search.")] = 120.0
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Show what is learned; keep nothing.")] = False
    json: Json = False


@takes(SynthesizeArguments)
def synthesize(given: SynthesizeArguments) -> None:
    """Learn the smallest program that does on every demonstrated asset what was shown there.

    Ctrl-C ends the search. Exit code 1 when no program was found; then the nearest one is named, and where it differs.
    What the demonstrations leave open, and labels that are probably wrong, `meshforge review` asks about.
    """
    project = replace(Store.open(given.project), cache=MeshCache())
    asked = tuple(given.extractors or ())
    if asked and given.strategy == "paper":
        raise UsageError("--with does not go with --strategy paper, which knows the extractors of the paper only")
    if asked and not given.dry_run:
        project.add_extractors(asked)
    options = synthesis.Options(
        extractors=asked if given.dry_run else (),
        strategy=given.strategy,
        layers=given.layers,
        repair=not given.no_repair,
        budget=given.budget,
    )
    meshes = dict(project.meshes_by_id(select_assets(project)))
    for one in try_goals_as_shown(project, meshes):
        for name, result in one.after.items():
            if result.outcome == "failed":
                remark(f"{escape_name(one.asset)} as it was demonstrated fails goal {name}: {result.why}")
    with progress(None, "learning"), catch_interrupt() as stop:
        outcome = learn_program(project, accept=not given.dry_run, options=options, stop=stop, meshes=meshes)
        stopped = stop()
    if given.json:
        print_json(synthesis.outcome_to_json(outcome))
    else:
        feedback = project.feedback()
        _print_outcome(
            outcome,
            LearningContext(
                given.project,
                assets=len(project.assets()),
                in_use=len(select_assets(project)),
                readable=len(meshes),
                answers=len(feedback.answers) - len(outcome.stale),
                repairs=sum(fix.accepted for fix in feedback.fixes.values()),
                kept=not given.dry_run,
                stopped=stopped,
                classes=propose_class_names(project),
            ),
        )
    raise typer.Exit(int(outcome.program is None))


def _print_outcome(outcome: synthesis.LearningOutcome, about: "LearningContext") -> None:
    typer.echo(format_result(outcome, about))
    more = format_remarks(outcome, about)
    if more:
        remark(f"\n{more}")


_OVERRULED = "its result was accepted, which no program keeps that does what is demonstrated"


@dataclass(frozen=True, slots=True)
class LearningContext:
    """What there is to say besides the outcome.

    folder: of the project, as a person types it; assets, in_use, readable: how many there are, are learned from,
    and can be read of these; answers, repairs: how many were said so far; kept: whether the program was kept.
    stopped: whether a person ended the search; classes: of hulls that steps take, with the names proposed for them.
    """

    folder: Path
    assets: int
    in_use: int
    readable: int
    answers: int = 0
    repairs: int = 0
    kept: bool = True
    stopped: bool = False
    classes: Mapping[str, str | None] = field(default_factory=dict)

    @property
    def folder_word(self) -> str:
        return shlex.quote(str(self.folder))


def format_result(outcome: synthesis.LearningOutcome, about: LearningContext) -> str:
    """Return the result: a program, or why there is none."""
    match outcome:
        case synthesis.Found() | synthesis.Ambiguous():
            return str(outcome.program).rstrip("\n")
        case synthesis.NeedsRepair():
            return "\n".join(_describe_repairs(outcome, about))
        case synthesis.NoProgram():
            return "\n".join(_describe_failure(outcome))
        case synthesis.TimedOut():
            return "\n".join(_describe_timeout(outcome, about))
        case _:
            assert_never(outcome)


def format_remarks(outcome: synthesis.LearningOutcome, about: LearningContext) -> str:
    """Return how far the result can be trusted, and what to do next."""
    lines = list(_describe_stale(outcome, about))
    if isinstance(outcome, synthesis.Found | synthesis.Ambiguous):
        took = f"learned in {sum(outcome.seconds.values()):.2f} s{_describe_inputs(about)}"
        lines += [f"{took}, kept as {about.folder / 'program.mf'}" if about.kept else took]
        lines += [*_describe_suggestion(outcome, "may be meant"), *_describe_agreement(outcome, about)]
        lines += _describe_classes(about)
        lines += [format_next("left open" if outcome.open_rule else "learned", about.folder)] if about.kept else []
    return "\n".join(lines)


def _describe_inputs(about: LearningContext) -> str:
    parts = [pluralize(about.answers, "answer")] if about.answers else []
    parts += [pluralize(about.repairs, "repaired label")] if about.repairs else []
    return f" with {' and '.join(parts)}" if parts else ""


def _describe_classes(about: LearningContext) -> Iterator[str]:
    if not about.classes or not about.kept:
        return
    are = "is what a step takes" if len(about.classes) == 1 else "are what steps take"
    yield f"{join_names([*about.classes], len(about.classes))} {are}, and what looks like it. Name parts when you like:"
    given = (shlex.quote(f"{name}={word or 'NAME'}") for name, word in about.classes.items())
    yield f"  meshforge label {about.folder_word} {' '.join(f'--rename {one}' for one in given)}"


def _describe_agreement(outcome: synthesis.Found | synthesis.Ambiguous, about: LearningContext) -> Iterator[str]:
    if outcome.unambiguous:
        all_ = "your one asset" if about.assets == 1 else f"your {about.assets:,} assets"
        part = "were looked at" if about.in_use < about.assets else "can be read"
        seen = all_ if about.readable == about.assets else f"the {about.readable} of {all_} that {part}"
        yield f"all believable readings of the rules agree on {seen}"
    elif outcome.open_rule:
        yield f"ambiguous: it is open what rule {outcome.open_rule.rule} does on {outcome.open_rule.asset}"
    yield from (f"{asset}: {_OVERRULED}" for asset in outcome.overruled)


def _describe_stale(outcome: synthesis.LearningOutcome, about: LearningContext) -> Iterator[str]:
    for answer in outcome.stale:
        question = f"{answer.rule}:{answer.asset}"
        yield f"the answer {question} no longer fits what is there, and is left out"
        yield f"  to take it back: meshforge review {about.folder_word} --forget {shlex.quote(question)}"


def _describe_failure(outcome: synthesis.NoProgram) -> Iterator[str]:
    yield f"no program found: {outcome.why}"
    yield from (f"  learned: {rule}" for rule in outcome.rules)
    yield from _describe_nearest(outcome.nearest)
    yield from (f"- {line}" for line in outcome.advice)
    if not outcome.advice:
        yield "Look at the labels of these hulls (meshforge info), or at what was demonstrated there."
    yield from _describe_suggestion(outcome, "would do")


def _describe_suggestion(outcome: synthesis.LearningOutcome, how: str) -> Iterator[str]:
    if outcome.suggested:
        yield f"Another orientation {how}: {outcome.suggested.why}."
        yield "  in meshforge.toml write: orient = " + toml_value(orientation_text(outcome.suggested.orient))


def _describe_timeout(outcome: synthesis.TimedOut, about: LearningContext) -> Iterator[str]:
    number = len(outcome.rules) + 1
    if about.stopped:
        yield f"stopped while rule {number} was searched for"
    else:
        yield f"the time ran out while rule {number} was searched for; --budget SECONDS gives more"
    yield from (f"  learned: {rule}" for rule in outcome.rules)
    yield from _describe_nearest(outcome.nearest) if outcome.nearest else ()


def _describe_nearest(nearest: synthesis.Nearest) -> Iterator[str]:
    yield f"nearest for rule {nearest.rule}: {show(nearest.extractor)}; on {nearest.asset} it"
    if nearest.extra:
        yield f"  selects too much: {', '.join(nearest.extra)}"
    if nearest.missing:
        yield f"  leaves out:       {', '.join(nearest.missing)}"


def _describe_repairs(outcome: synthesis.NeedsRepair, about: LearningContext) -> Iterator[str]:
    yield f"no program yet: {pluralize(len(outcome.repairs), 'label')} may be wrong"
    for repair in outcome.repairs:
        wrong, sure = repair.fix, format_belief(repair)
        change = f"  {wrong.hull} of {wrong.asset}: {wrong.was or 'no label'} -> {wrong.to}"
        yield change + (f"  ({sure} sure)" if sure else "")
        yield f"    {repair.why}"
    if outcome.proposed:
        yield "With that, the program is:"
        yield from (f"  {rule}" for rule in outcome.proposed.rules)
    yield format_next("left open", about.folder)


def format_belief(repair: synthesis.Repair) -> str | None:
    """Return how likely the repair is right, for people; None where that is not known, as of the paper's strategy."""
    return f"{min(round(100 * repair.belief), 99)} %" if repair.belief < 1 else None
