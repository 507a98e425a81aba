"""`meshforge check`: whether hulls are legal, and within an engine's limits."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from meshforge.cli.options import AssetFiles, Json, Labels

if TYPE_CHECKING:
    from meshforge.batch import Examination

EngineName = Literal["mujoco", "physx-cpu", "physx-gpu", "unreal", "unity", "bullet", "godot"]


def check(
    assets: AssetFiles,
    engine: Annotated[EngineName | None, typer.Option("--engine", help="Also check the limits of this engine.")] = None,
    mend: Annotated[
        bool, typer.Option("--fix", help="Mend what is beyond the engine's limits, as far as safe; write to --out.")
    ] = False,
    out: Annotated[Path | None, typer.Option("-o", "--out", help="Folder for the mended assets.")] = None,
    tolerance: Annotated[
        float | None,
        typer.Option(
            "--tolerance",
            min=0.0,
            help="How far a mended hull may stick out of the old one [m]; default 1% of the diagonal.",
        ),
    ] = None,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace files in --out.")] = False,
    labels: Labels = None,
    json: Json = False,
) -> None:
    """Check that every hull is convex, closed and solid, and keeps to the limits of an engine.

    Exit code 1 when a check does not hold or a file cannot be read.
    """
    from meshforge.batch import Wanted, examine, expand, labels_for
    from meshforge.cli.output import print_json

    _refuse(engine, mend, out, tolerance, overwrite)
    wanted = Wanted(engine, out, tolerance, overwrite)
    failed = False
    found = expand(assets)
    for path in found:
        examined = examine(path, found.base, labels_for(path, labels, found.base), wanted)
        failed |= examined.failed
        if json:
            print_json(examined.to_json(), compact=True)
        else:
            _print(examined)
    raise typer.Exit(int(failed))


def _refuse(engine: str | None, mend: bool, out: Path | None, tolerance: float | None, overwrite: bool) -> None:
    """Raise UsageError for options that do not go together."""
    from meshforge.errors import UsageError

    if mend and not (engine and out):
        raise UsageError(
            "--fix needs --engine and --out", remedy="meshforge check ASSETS... --engine NAME --fix --out DIR"
        )
    for given, option in (
        (out is not None, "--out"),
        (tolerance is not None, "--tolerance"),
        (overwrite, "--overwrite"),
    ):
        if given and not mend:
            raise UsageError(f"{option} says nothing without --fix", remedy="Give --fix too, or leave it out.")


def _print(examined: Examination) -> None:
    path = examined.path
    if examined.error:
        typer.echo(f"{path}: cannot be read\n  " + examined.error.replace("\n", "\n  "))
        return
    typer.echo(f"{path}:" if examined.findings or examined.fixed else f"{path}: legal")
    if examined.fixed:
        for change in examined.fixed.changes:
            typer.echo(f"  fixed: {change.told}")
        for line in examined.fixed.left:
            typer.echo(f"  {line}")
        typer.echo(f"  wrote {examined.written}")
    for finding in examined.findings:
        typer.echo(f"  {finding.severity}: {finding.message}")
        if finding.remedy:
            typer.echo(f"    {finding.remedy}")
