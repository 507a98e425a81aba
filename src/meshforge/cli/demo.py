"""`meshforge demo`: the whole loop on the bundled family of tables."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from textwrap import indent
from typing import TYPE_CHECKING, Annotated

import typer

from meshforge.cli.options import Workers
from meshforge.cli.studio import Browser, Port

if TYPE_CHECKING:
    from meshforge.batch.report import ReportAsset
    from meshforge.project import Project

_OUT, _STUDIO = Path("meshforge-demo"), Path("meshforge-demo-studio")


def demo(
    out: Annotated[
        Path | None,
        typer.Option("-o", "--out", help=f"Folder to make; {_OUT}, with --studio {_STUDIO}, unless given."),
    ] = None,
    workers: Workers = None,
    studio: Annotated[
        bool, typer.Option("--studio", help="Open the tables in the browser, for you to show the steps; with a tour.")
    ] = False,
    port: Port = 0,
    browser: Browser = True,
) -> None:
    """The whole loop on the bundled tables: labels, demonstrations, a learned program, edited assets, report.

    With --studio you show the steps yourself; what you did is there again when you come back.
    """
    if studio:
        _in_browser(out or _STUDIO, port, browser)
        return
    _run_through(out or _OUT, workers)


def _run_through(out: Path, workers: int | None) -> None:
    """Everything at once, with what happened in a few lines."""
    from time import perf_counter

    from meshforge.batch.report import write_report
    from meshforge.cli.compared import compared
    from meshforge.cli.output import progress, remark
    from meshforge.cli.tables import demonstrated_tables

    project = demonstrated_tables(out)
    shown = project.demonstrations()
    _say(f"{len(project.assets())} tables, each cut into convex hulls by CoACD, every hull labelled: {out / 'assets'}")
    _say(f"Two of them show what to do, in {max(len(d.steps) for d in shown.values())} steps: {' and '.join(shown)}")
    lesson = project.synthesize()
    program = project.program()
    if program is None:  # the bundled demonstrations always have a program; a changed install might not
        remark("no program was found; see: meshforge synthesize " + str(project.folder))
        raise typer.Exit(1)
    _say(f"From these two, MeshForge learned a program in {sum(lesson.seconds.values()):.2f} s:\n")
    typer.echo(indent(str(program), "    "))
    started = perf_counter()
    with progress(len(project.assets()), "editing") as advance:
        outcomes = list(project.apply(workers=workers, progress=advance))
    seconds = perf_counter() - started
    assets = list(compared(outcomes, program, project.readers(o.asset for o in outcomes), shown))
    with progress(len(assets), "drawing") as advance:
        report = out / "report.html"
        about = "Pictures show every table upright, as the program sees it; the files keep the frame they came in."
        write_report(
            report, title="Tables", program=program, assets=assets, seconds=seconds, about=about, progress=advance
        )
    _told(assets, seconds, project, report)
    raise typer.Exit(int(any(asset.status == "failed" for asset in assets)))


def _in_browser(out: Path, port: int, browser: bool) -> None:
    """The tables in the studio; those of an earlier time with all that was done there."""
    from meshforge.cli.studio import opened
    from meshforge.cli.tables import kept_tables
    from meshforge.studio.serving import Opening

    opened(Opening(kept_tables(out).folder, tour=True), port=port, browser=browser)


def _told(assets: Sequence[ReportAsset], seconds: float, project: Project, report: Path) -> None:
    from meshforge.checks import check

    edited = [asset for asset in assets if asset.after and asset.counts]
    before, after = (sum(asset.counts[k] for asset in edited if asset.counts) for k in (0, 1))
    wrong = sum(any(f.severity == "error" for f in check(asset.after)) for asset in edited if asset.after)
    legal = "every hull legal" if not wrong else f"{wrong} with illegal hulls"
    _say(f"It ran on all {len(assets)} in {seconds:.1f} s: {before} hulls became {after}, {legal}.")
    if len(edited) < len(assets):
        _say(f"{len(assets) - len(edited)} failed; the report says why.")
    _say(f"Edited tables, each in the file format it came in: {_short(project.folder / 'edited')}")
    _say(f"Before, after, and what each rule did: {_short(report)}")
    _say(f"Look around: meshforge status {_short(project.folder)}")


def _short(path: Path) -> Path:
    """A path as a person here would type it."""
    path, here = path.absolute(), Path.cwd()
    return path.relative_to(here) if path.is_relative_to(here) else path


def _say(text: str) -> None:
    typer.echo(text)
