"""`meshforge demo`: the whole loop on the bundled family of tables, as a project in a folder of its own."""

import shutil
from collections.abc import Sequence
from pathlib import Path
from textwrap import indent
from time import perf_counter
from typing import Annotated

import typer

from meshforge.batch import ExecutionOptions, ReportAsset, ReportHeader, ReportOptions, compare_outcomes, write_report
from meshforge.checks import check
from meshforge.cli.console import progress
from meshforge.cli.options import Browser, Port, Workers
from meshforge.cli.terminal import remark
from meshforge.common import UsageError, quote_path
from meshforge.project import Project, add_result_status, create_tour_project, format_status
from meshforge.samples import TABLES

_OUT, _STUDIO = Path("meshforge-demo"), Path("meshforge-demo-studio")

DEMO_MARK = ".meshforge-demo"
"""The mark of a folder that an earlier demo made, and that the next one may therefore replace."""
STUDIO_MARK = ".meshforge-demo-studio"
"""The mark of a folder that a demo in the studio made; what a person did there stays."""


def demo(
    out: Annotated[
        Path | None, typer.Option("-o", "--out", help=f"Folder to make; {_OUT}, with --studio {_STUDIO}, unless given.")
    ] = None,
    workers: Workers = None,
    studio: Annotated[
        bool, typer.Option("--studio", help="Open the tables in the browser, for you to show the steps; with a tour.")
    ] = False,
    port: Port = None,
    browser: Browser = True,
) -> None:
    """Run the whole loop on the bundled tables: labels, demonstrations, a learned program, edited assets, report.

    With --studio you show the steps yourself; what you did is there again when you come back.
    """
    if studio:
        _open_in_browser(out or _STUDIO, port, browser)
    else:
        _run_all(out or _OUT, workers)


def _run_all(out: Path, workers: int | None) -> None:
    project = create_tables(out)
    shown = project.demonstrations()
    typer.echo(
        f"{len(project.assets())} tables, each cut into convex hulls by CoACD, every hull labelled: {out / 'assets'}"
    )
    typer.echo(
        f"Two of them show what to do, in {max(len(d.steps) for d in shown.values())} steps: {' and '.join(shown)}"
    )
    outcome = project.synthesize()
    program = project.program()
    if program is None:  # the bundled demonstrations always have a program; a changed install might not
        remark("no program was found; see: meshforge synthesize " + str(project.folder))
        raise typer.Exit(1)
    typer.echo(f"From these two, MeshForge learned a program in {sum(outcome.seconds.values()):.2f} s:\n")
    typer.echo(indent(str(program), "    "))
    started = perf_counter()
    with progress(len(project.assets()), "editing") as advance:
        outcomes = list(project.apply(execution=ExecutionOptions(workers, progress=advance)))
    seconds = perf_counter() - started
    project.review()
    found = project.status()
    pairs = compare_outcomes(outcomes, program, project.readers(o.asset for o in outcomes), shown)
    assets = add_result_status(pairs, found)
    with progress(len(assets), "drawing") as advance:
        report = out / "report.html"
        about = "Pictures show every table upright, as the program sees it; the files keep the frame they came in."
        header = ReportHeader("Tables", about, seconds, result_status=format_status(found))
        write_report(report, header, assets, program=program, options=ReportOptions(progress=advance))
    _print_result(assets, seconds, project, report, format_status(found))
    raise typer.Exit(int(any(asset.status == "failed" for asset in assets)))


def _open_in_browser(out: Path, port: int | None, browser: bool) -> None:
    """The tables in the studio; those of an earlier time with all that was done there."""
    from meshforge.cli.studio import open_studio  # lazy: 330 modules that only --studio needs
    from meshforge.studio.session.session import StudioOptions  # lazy: 330 modules that only --studio needs

    open_studio(StudioOptions(open_tables(out).folder, tour=True), port=port, browser=browser)


def _print_result(assets: Sequence[ReportAsset], seconds: float, project: Project, report: Path, sure: str) -> None:
    edited = [asset for asset in assets if asset.after and asset.counts]
    before, after = (sum(asset.counts[k] for asset in edited if asset.counts) for k in (0, 1))
    wrong = sum(any(f.severity == "error" for f in check(asset.after)) for asset in edited if asset.after)
    legal = "every hull legal" if not wrong else f"{wrong} with illegal hulls"
    typer.echo(f"It ran on all {len(assets)} in {seconds:.1f} s: {before} hulls became {after}, {legal}.")
    if len(edited) < len(assets):
        typer.echo(f"{len(assets) - len(edited)} failed; the report says why.")
    typer.echo(sure.replace("\n", "\n  "))
    typer.echo(f"Edited tables, each in the file format it came in: {quote_path(project.folder / 'edited')}")
    typer.echo(f"Before, after, and what each rule did: {quote_path(report)}")
    typer.echo(f"How sure each result is, and questions about it: meshforge review {quote_path(project.folder)}")


def create_tables(out: Path) -> Project:
    """Return a fresh project of the tables below `out`, labelled and demonstrated.

    Raises UsageError where the folder holds something else.
    """
    _empty_folder(out, DEMO_MARK)
    project = create_tour_project(out / "project", out / "assets")
    shutil.copytree(TABLES / "demonstrations", project.folder / "demonstrations")
    return project


def open_tables(out: Path) -> Project:
    """Return the project that an earlier demo in the studio made below `out`, or a fresh one, labelled.

    Raises UsageError where the folder holds something else.
    """
    whole = out / STUDIO_MARK
    if whole.exists() and whole.read_text(encoding="utf-8"):
        return Project.open(out / "project")
    _empty_folder(out, STUDIO_MARK)
    project = create_tour_project(out / "project", out / "assets")
    whole.write_text("whole\n", encoding="utf-8")  # from now on it is a person's
    return project


def _empty_folder(out: Path, mark: str) -> None:
    """An empty folder with a mark. Raises UsageError where it holds what no demo of that kind made."""
    if out.exists() and any(out.iterdir()) and not (out / mark).exists():
        raise UsageError("this folder holds something else", where=str(out), remedy="Choose another: demo --out DIR")
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    (out / mark).touch()
