"""`meshforge studio`: the project in a browser."""

from pathlib import Path
from typing import Annotated

import typer

from meshforge.cli.options import Browser, Port
from meshforge.studio.api.server import PAGE_FOLDER, serve
from meshforge.studio.session.session import StudioOptions


def studio(
    project: Annotated[
        Path | None, typer.Argument(help="A project folder; without it, the start page.", show_default=False)
    ] = None,
    port: Port = None,
    browser: Browser = True,
    export: Annotated[
        Path | None,
        typer.Option("--export", help="Folder outside of the project that outputs may be exported to, too."),
    ] = None,
    page: Annotated[Path | None, typer.Option(hidden=True, help="Folder of another build of the page.")] = None,
) -> None:
    """See, label, demonstrate, learn and review in the browser; stops with Ctrl-C.

    Without a project it opens the start page: recent projects, and new ones from a folder, from dropped files or from a
    bundled family. The studio answers on this machine only, to the address with its token that is printed.
    """
    open_studio(StudioOptions(project, export), port=port, browser=browser, page=page)


def open_studio(options: StudioOptions, *, port: int | None, browser: bool, page: Path | None = None) -> None:
    """Serve a studio, and say where."""

    def announce(address: str) -> None:
        print(f"Studio: {address}", flush=True)

    serve(options, announce, port=port, browser=browser, page=page or PAGE_FOLDER)
