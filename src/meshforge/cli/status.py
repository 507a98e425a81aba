"""`meshforge status`: how far a project is, and what to do next."""

from pathlib import Path
from typing import Annotated

import typer

from meshforge.cli.console import print_table, progress
from meshforge.cli.options import Json
from meshforge.cli.terminal import print_json
from meshforge.common import escape_name, pluralize
from meshforge.project import AssetStatus, Status, compute_status, format_status, format_step
from meshforge.store import Store
from meshforge.symbolic import NO_PART, is_class_name


def status(
    project: Annotated[Path, typer.Argument(help="A project folder.")],
    signed_off: Annotated[
        bool, typer.Option("--signed-off", help="Exit code 1 while some asset is not signed off.")
    ] = False,
    allow_excluded: Annotated[
        bool, typer.Option("--allow-excluded", help="With --signed-off: assets that are not solved do not count.")
    ] = False,
    verify: Annotated[
        bool, typer.Option("--verify", help="Read every file anew, even where its size and times are what they were.")
    ] = False,
    json: Json = False,
) -> None:
    """Show what is labelled, demonstrated, learned, applied, stale and flagged, and the next sensible step.

    How sure each result is, is what `meshforge review` found last, as far as nothing changed since.
    """
    store = Store.open(project)
    with progress(len(store.assets()), "reading") as advance:
        found = compute_status(store, progress=advance, verify=verify)
    if json:
        print_json(found.to_json())
    else:
        _print_status(found, store.folder)
    if signed_off and not (found.is_signed_off_but_unsolved if allow_excluded else found.is_signed_off):
        raise typer.Exit(1)


def _print_status(found: Status, folder: Path) -> None:
    every = {label.name for asset in found.assets for label in asset.labels if label} - {NO_PART}
    classes = ", ".join(sorted(filter(is_class_name, every)))
    rules = "no program yet" if found.rules is None else f"a program of {pluralize(found.rules, 'rule')}"
    typer.echo(f"{found.name}: {pluralize(len(found.assets), 'asset')}, {rules}{' (outdated)' * found.outdated}")
    typer.echo(f"vocabulary: {', '.join(found.vocabulary) or 'none'}{'; of steps: ' * bool(classes)}{classes}\n")
    print_table(
        ("asset", "hulls", "labelled", "demonstrated", "output", "remarks"),
        map(_to_row, found.assets),
        right=("hulls",),
    )
    for asset in found.lost:
        typer.echo(f"kept for an asset that is not there: {escape_name(asset)} (a file of that name gets it back)")
    if found.rules is not None:
        typer.echo(f"\n{format_status(found)}")
    typer.echo(f"\n{format_step(found.next)}")


def _to_row(asset: AssetStatus) -> tuple[object, ...]:
    stale = f"stale: {', '.join(asset.stale)} changed" if asset.stale else None
    bare = f"{asset.sources} without hulls (meshforge prepare)" if asset.sources else None
    error = "; ".join(line.strip() for line in (asset.error or "").splitlines())
    remarks = [text for text in (error, stale, asset.review, bare, *asset.prepared, *asset.flags) if text]
    labelled = "" if not asset.hulls else "all" if asset.labelled == asset.hulls else asset.labelled
    output = "" if asset.output == "none" else asset.output
    return asset.id, asset.hulls, labelled, "yes" if asset.demonstrated else "", output, "; ".join(remarks)
