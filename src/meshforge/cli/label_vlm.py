"""`meshforge label --with vlm`: what would be sent, or what a model said and what it cost."""

from __future__ import annotations

import sys
import threading
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Annotated, Literal

import typer
from pydantic import ValidationError

from meshforge import batch
from meshforge.cli.console import progress
from meshforge.cli.label_report import LabelPrinter
from meshforge.cli.terminal import catch_interrupt, print_json, remark
from meshforge.common import UsageError, first_validation_error, join_names, pluralize
from meshforge.labels import (
    Endpoint,
    VlmLabeler,
    approve_host,
    check_approved,
    describe_sending,
    is_approved,
)
from meshforge.project import Project
from meshforge.store import VlmSettings

if TYPE_CHECKING:
    from meshforge.labels import LabelOutcome, Usage, VlmForecast, VlmResult

_MAX_NAMES = 8  # names in a row


@dataclass(frozen=True)
class VlmOptions:
    """What the command line says of the model; None where it leaves that to meshforge.toml."""

    model: Annotated[str | None, typer.Option("--model", help="The model that --with vlm asks.")] = None
    base_url: Annotated[str | None, typer.Option("--base-url", help="Where it is, for example .../v1.")] = None
    mode: Annotated[
        Literal["cheap", "balanced", "exact"] | None,
        typer.Option("--mode", help="How many pictures and questions --with vlm takes for a hull.", show_default=False),
    ] = None
    max_cost: Annotated[
        float | None, typer.Option("--max-cost", min=0, help="Dollars that --with vlm may spend.", show_default=False)
    ] = None

    approve_host: Annotated[
        str | None,
        typer.Option("--approve-host", metavar="HOST", help="Let pictures and a key be sent to this host from now on."),
    ] = None

    def settings(self, project: Project) -> VlmSettings:
        """The settings of the project with these in their place. Raises UsageError where they do not fit."""
        given = {name: one for name, one in asdict(self).items() if one is not None and name != "approve_host"}
        try:
            return VlmSettings.model_validate(project.settings.vlm.model_dump() | given)
        except ValidationError as error:
            raise UsageError(first_validation_error(error)) from error

    @property
    def first_option(self) -> str | None:
        """The first option that was given, as it is typed."""
        names = (name for name, value in asdict(self).items() if value is not None)
        return next((f"--{name.replace('_', '-')}" for name in names), None)


VLM = VlmOptions()


def forecast(
    project: Project,
    options: VlmOptions,
    vocabulary: Sequence[str] | None,
    execution: batch.ExecutionOptions,
    *,
    json: bool,
) -> None:
    """Print what would be sent and what it may cost; nothing is sent. vocabulary: None for that of the project."""
    settings = options.settings(project)
    with progress(len(project.assets()), "drawing") as advance, catch_interrupt() as stop:
        found = project.forecast_vlm(settings, progress=advance, stop=stop, vocabulary=vocabulary, execution=execution)
        if stop():
            raise KeyboardInterrupt
    if json:
        print_json(asdict(found), compact=True)
    else:
        _print_forecast(found)


def label_with_vlm(
    project: Project, options: VlmOptions, execution: batch.ExecutionOptions, printer: LabelPrinter
) -> None:
    """Label a project, and print what came of it; an asking that ended early has failed."""
    outcomes, found = _ask_model(project, options, execution)
    for outcome in outcomes:
        printer.print(outcome, {"open": found.open.get(outcome.asset, {})}, _describe_open(found, outcome.asset))
    if found.ended:
        printer.failed = True
        why = ". ".join(line.strip(" .") for line in found.ended.splitlines())
        printer.remark(f"The asking ended early: {why}.")
    printer.summarize(project)
    _print_end(project, found, json=printer.json)


def _ask_model(
    project: Project, options: VlmOptions, execution: batch.ExecutionOptions
) -> tuple[Sequence[LabelOutcome], VlmResult]:
    """Ask for labels; the first Ctrl-C ends the asking, and what is under way is waited for."""
    settings, waiting = options.settings(project), "stopping: waiting for the answers that are under way"
    endpoint, typed = Endpoint(settings), (options.base_url,) if options.base_url else ()
    _ask_approval(endpoint, typed)
    check_approved(endpoint, typed)
    remark(describe_sending(endpoint))
    labeler = VlmLabeler(settings, typed)
    with catch_interrupt() as stop, _announce_stop(stop, waiting):
        result = project.label(labeler, execution=replace(execution, stop=stop), stage=progress)
    return result.outcomes, labeler.result


def _ask_approval(endpoint: Endpoint, typed: Sequence[str]) -> None:
    """Ask a person at the terminal for a host that is not approved; where nobody can be asked, it stays that."""
    if endpoint.settings.base_url in typed or is_approved(endpoint) or not (sys.stdin.isatty() and sys.stderr.isatty()):
        return
    if typer.confirm(f"For the first time, {describe_sending(endpoint)}. Is that right?", err=True):
        approve_host(endpoint.host)


@contextmanager
def _announce_stop(stop: Callable[[], bool], text: str) -> Iterator[None]:
    """Within the block, say so as soon as a stop is wanted, whatever is waited for then."""
    over = threading.Event()

    def wait() -> None:
        while not over.wait(0.1):
            if stop():
                remark(text)
                return

    threading.Thread(target=wait, daemon=True).start()
    try:
        yield
    finally:
        over.set()


def _describe_open(found: VlmResult, asset: str) -> list[str]:
    by_reason: dict[str, list[str]] = defaultdict(list)
    for hull, why in found.open.get(asset, {}).items():
        by_reason[why].append(hull)
    return [f"no label: {join_names(hulls, _MAX_NAMES)} ({why})" for why, hulls in by_reason.items()]


def _print_end(project: Project, found: VlmResult, *, json: bool) -> None:
    pages = project.layout.vlm / "pages"
    if json:
        ending = {"ended": found.ended, "unasked": list(found.unasked), "blind": found.blind}
        print_json({"bill": asdict(found.usage)} | ending, compact=True)
        return
    typer.echo(_describe_usage(found.usage))
    if any(found.open.values()) or found.usage.answered + found.usage.cached:
        typer.echo(f"what was sent and what came back: {pages}")
    if found.blind:
        remark("The model took a red picture for another one: it may not see pictures at all.")
    if found.ended:
        remark(f"The asking ended early: {found.ended}")
    if found.unasked:
        remark(f"not labelled: {join_names(found.unasked, _MAX_NAMES)}; run it again to go on")


def _describe_usage(usage: Usage) -> str:
    parts = [f"{pluralize(usage.answered, 'answer')}"]
    parts += [f"{usage.cached} more from earlier"] if usage.cached else []
    parts += [f"{pluralize(usage.retries, 'attempt')} repeated"] if usage.retries else []
    tokens = f"{usage.usage.input:,} tokens in, {usage.usage.output:,} out"
    tokens += " (estimated, since the server does not say)" if usage.usage.estimated else ""
    return f"{', '.join(parts)}; {tokens}; {_describe_cost(usage)}"


def _describe_cost(usage: Usage) -> str:
    if usage.cost is None:
        return "cost not known: write input_price and output_price into [vlm]"
    lost = f", and up to ${usage.perhaps:.4f} should {pluralize(usage.lost, 'lost attempt')} be charged for"
    return f"${usage.cost:.4f}{lost if usage.lost else ''}"


def _print_forecast(found: VlmForecast) -> None:
    hulls = f"{pluralize(found.assets, 'asset')} with {pluralize(found.hulls, 'hull')} to be labelled"
    typer.echo(f"{found.model} at {found.host}, mode {found.mode}: {hulls}")
    known = f"; {found.known} more have their answer already" if found.known else ""
    fresh = found.questions - found.known
    typer.echo(f"would send {pluralize(fresh, 'question')} with {pluralize(found.pictures, 'picture')}{known}")
    cost = "price not known" if found.cost is None else f"about ${found.cost:.4f}"
    typer.echo(f"about {found.input:,} tokens in and {found.output:,} out: {cost}")
    if found.unreadable:
        typer.echo(f"cannot be read: {join_names(found.unreadable, _MAX_NAMES)}")
    if not found.key_is_set:
        typer.echo(f"the key is not there: the environment variable {found.key} is not set")
    typer.echo("nothing was sent")
