"""`meshforge label --with vlm`: what would be sent, or what a model said and what it cost."""

import sys
from dataclasses import asdict, replace

import typer

from meshforge import batch
from meshforge.cli.console import progress
from meshforge.cli.label_report import LabelPrinter
from meshforge.cli.terminal import catch_interrupt, print_json, remark
from meshforge.common import UsageError, join_names, pluralize
from meshforge.labels import (
    EndError,
    Endpoint,
    LabelFamily,
    Usage,
    VlmLabeler,
    approve_host,
    check_approved,
    describe_sending,
    forecast_vlm,
)
from meshforge.project import Project
from meshforge.store import VlmSettings

_MAX_NAMES = 8  # names in a row


def label_with_vlm(
    project: Project, labeler: VlmLabeler, execution: batch.ExecutionOptions, printer: LabelPrinter
) -> None:
    """Label a project, and print what came of it; an asking that ended early has failed.

    The first Ctrl-C ends the asking, and what is under way is waited for.
    """
    endpoint = Endpoint(labeler.settings or project.settings.vlm)
    sending = describe_sending(endpoint)
    try:
        check_approved(endpoint, labeler.typed)
    except UsageError:  # a person at the terminal is asked
        asked = sys.stdin.isatty() and sys.stderr.isatty()
        if not (asked and typer.confirm(f"For the first time, {sending}. Is that right?", err=True)):
            raise
        approve_host(endpoint.host)
    remark(sending)
    with catch_interrupt("stopping: waiting for the answers that are under way\n") as stop:
        execution = replace(execution, stop=stop)
        project.label(labeler, execution=execution, stage=progress, report=printer.print)
    printer.failed |= bool(labeler.result.ended)
    printer.summarize()
    _print_end(project, labeler, json=printer.json)


def _print_end(project: Project, labeler: VlmLabeler, *, json: bool) -> None:
    found = labeler.result
    if json:
        ending = {"ended": found.ended, "unasked": list(found.unasked), "blind": found.blind}
        print_json({"bill": asdict(found.usage)} | ending, compact=True)
        return
    typer.echo(_describe_usage(found.usage))
    if found.usage.answered + found.usage.cached:
        typer.echo(f"what was sent and what came back: {project.layout.vlm}")
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
    tokens = f"{usage.input:,} tokens in, {usage.output:,} out"
    tokens += " (estimated, since the server does not say)" if usage.estimated else ""
    cost = "cost not known: write input_price and output_price into [vlm]"
    if usage.cost is not None:
        lost = f", and up to ${usage.perhaps:.4f} should lost attempts be charged for" if usage.perhaps else ""
        cost = f"${usage.cost:.4f}{lost}"
    return f"{', '.join(parts)}; {tokens}; {cost}"


def print_forecast(family: LabelFamily, settings: VlmSettings, *, json: bool) -> None:
    """Print what would be sent and what it may cost; nothing is sent."""
    found, endpoint = forecast_vlm(family, settings), Endpoint(settings)
    if json:
        print_json({"host": endpoint.host, "model": settings.model} | asdict(found), compact=True)
        return
    usage, kind = found.usage, "hull" if settings.every_hull else "exemplar"
    hulls = f"{pluralize(found.assets, 'asset')} with {pluralize(found.hulls, kind)} to be labelled"
    typer.echo(f"{settings.model} at {endpoint.host}: {hulls}")
    known = f"; {usage.cached} more have their answer already" if usage.cached else ""
    typer.echo(f"would send {pluralize(usage.answered, 'question')} with {pluralize(found.pictures, 'picture')}{known}")
    cost = "price not known" if usage.cost is None else f"about ${usage.cost:.4f}"
    typer.echo(f"about {usage.input:,} tokens in and {usage.output:,} out: {cost}")
    if found.unreadable:
        typer.echo(f"cannot be read: {join_names(found.unreadable, _MAX_NAMES)}")
    try:
        endpoint.key()
    except EndError as error:
        typer.echo(error.problem)
    typer.echo("nothing was sent")
