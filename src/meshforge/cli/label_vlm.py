"""`meshforge label --with vlm`: what would be sent, or what a model said and what it cost."""

from __future__ import annotations

import threading
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from meshforge.batch import ExecutionOptions
    from meshforge.cli.label_report import LabelReport
    from meshforge.labels import Usage, VlmForecast, VlmResult
    from meshforge.project import Project
    from meshforge.store import VlmSettings


_MAX_NAMES = 8  # names in a row


@dataclass(frozen=True)
class VlmOptions:
    """What the command line says of the model; None where it leaves that to meshforge.toml."""

    model: str | None = None
    base_url: str | None = None
    mode: str | None = None
    max_cost: float | None = None

    def settings(self, project: Project) -> VlmSettings:
        """The settings of the project with these in their place. Raises UsageError where they do not fit."""
        from pydantic import ValidationError

        from meshforge.common import UsageError, first_validation_error
        from meshforge.store import VlmSettings

        given = {name: value for name, value in asdict(self).items() if value is not None}
        try:
            return VlmSettings.model_validate(project.settings.vlm.model_dump() | given)
        except ValidationError as error:
            raise UsageError(first_validation_error(error)) from error

    @property
    def first_option(self) -> str | None:
        """The first option that was given, as it is typed."""
        names = (name for name, value in asdict(self).items() if value is not None)
        return next((f"--{name.replace('_', '-')}" for name in names), None)


def forecast(
    project: Project, options: VlmOptions, vocabulary: Sequence[str] | None, spread: ExecutionOptions, *, json: bool
) -> None:
    """Print what would be sent and what it may cost; nothing is sent. vocabulary: None for that of the project."""
    from meshforge.cli.terminal import catch_interrupt, print_json, progress

    settings = options.settings(project)
    with progress(len(project.assets()), "drawing") as advance, catch_interrupt() as stop:
        found = project.forecast_vlm(settings, progress=advance, stop=stop, vocabulary=vocabulary, execution=spread)
        if stop():
            raise KeyboardInterrupt
    if json:
        print_json(asdict(found), compact=True)
    else:
        _print_forecast(found)


def label_with_vlm(
    project: Project,
    options: VlmOptions,
    spread: ExecutionOptions,
    sheets: Path | None,
    page: LabelReport | None,
    *,
    json: bool,
) -> bool:
    """Label a project, and say what came of it; whether some labels could not be taken, or it ended early."""
    from meshforge.cli.label_report import LabelPrinter, summarize

    found, telling = _ask_model(project, options, spread), LabelPrinter(page, json=json)
    for report in found.reports:
        telling(report, {"open": found.open.get(report.asset, {})})
        lines = _describe_open(found, report.asset)
        if not json:
            typer.echo("".join(f"    {line}\n" for line in lines), nl=False)
        if page:
            page.note(report.asset, lines)
    if page and found.ended:
        why = ". ".join(line.strip(" .") for line in found.ended.splitlines())
        page.remark(f"The asking ended early: {why}.")
    summarize(project, sheets, page, json=json)
    _print_end(project, found, json=json)
    return telling.failed or bool(found.ended)


def _ask_model(project: Project, options: VlmOptions, spread: ExecutionOptions) -> VlmResult:
    """Ask for labels; the first Ctrl-C ends the asking, and what is under way is waited for."""
    from meshforge.cli.terminal import catch_interrupt, progress

    settings, waiting = options.settings(project), "stopping: waiting for the answers that are under way"
    bar = progress(len(project.assets()), f"asking {settings.model}")
    with bar as advance, catch_interrupt() as stop, _announce_stop(stop, waiting):
        return project.label_with_vlm(settings, progress=lambda bill: advance(), stop=stop, execution=spread)


@contextmanager
def _announce_stop(stop: Callable[[], bool], text: str) -> Iterator[None]:
    """Within the block, say so as soon as a stop is wanted, whatever is waited for then."""
    from meshforge.cli.terminal import remark

    over = threading.Event()

    def watch() -> None:
        while not over.wait(0.1):
            if stop():
                remark(text)
                return

    threading.Thread(target=watch, daemon=True).start()
    try:
        yield
    finally:
        over.set()


def _describe_open(found: VlmResult, asset: str) -> list[str]:
    """The hulls of an asset that got no label, by why."""
    from meshforge.common import join_names

    by_reason: dict[str, list[str]] = defaultdict(list)
    for hull, why in found.open.get(asset, {}).items():
        by_reason[why].append(hull)
    return [f"no label: {join_names(hulls, _MAX_NAMES)} ({why})" for why, hulls in by_reason.items()]


def _print_end(project: Project, found: VlmResult, *, json: bool) -> None:
    """Say what it all came to, and where it can be looked at."""
    from meshforge.cli.terminal import print_json, remark
    from meshforge.common import join_names

    pages = project.layout.vlm / "pages"
    if json:
        ending = {"ended": found.ended, "unasked": list(found.unasked), "blind": found.blind}
        print_json({"bill": asdict(found.usage)} | ending, compact=True)
        return
    typer.echo(_describe_bill(found.usage))
    if any(found.open.values()) or found.usage.answered + found.usage.cached:
        typer.echo(f"what was sent and what came back: {pages}")
    if found.blind:
        remark("The model took a red picture for another one: it may not see pictures at all.")
    if found.ended:
        remark(f"The asking ended early: {found.ended}")
    if found.unasked:
        remark(f"not labelled: {join_names(found.unasked, _MAX_NAMES)}; run it again to go on")


def _describe_bill(bill: Usage) -> str:
    from meshforge.common import pluralize

    parts = [f"{pluralize(bill.answered, 'answer')}"]
    parts += [f"{bill.cached} more from earlier"] if bill.cached else []
    parts += [f"{pluralize(bill.retries, 'attempt')} repeated"] if bill.retries else []
    tokens = f"{bill.usage.input:,} tokens in, {bill.usage.output:,} out"
    tokens += " (estimated, since the server does not tell)" if bill.usage.estimated else ""
    return f"{', '.join(parts)}; {tokens}; {_describe_cost(bill)}"


def _describe_cost(bill: Usage) -> str:
    from meshforge.common import pluralize

    if bill.cost is None:
        return "cost not known: write input_price and output_price into [vlm]"
    lost = f", and up to ${bill.perhaps:.4f} should {pluralize(bill.lost, 'lost attempt')} be charged for"
    return f"${bill.cost:.4f}{lost if bill.lost else ''}"


def _print_forecast(found: VlmForecast) -> None:
    from meshforge.common import join_names, pluralize

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
