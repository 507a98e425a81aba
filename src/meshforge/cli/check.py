"""`meshforge check`: whether hulls are legal, and within an engine's limits."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from meshforge.cli.options import AssetFiles, Json, Labels

if TYPE_CHECKING:
    from meshforge.checks import Finding


def check(
    assets: AssetFiles,
    engine: Annotated[
        Literal["mujoco", "physx-cpu", "physx-gpu", "unreal", "unity", "bullet", "godot"] | None,
        typer.Option("--engine", help="Also check the limits of this engine."),
    ] = None,
    labels: Labels = None,
    json: Json = False,
) -> None:
    """Check that every hull is convex, closed and solid, and keeps to the limits of an engine.

    Exit code 1 when a check does not hold or a file cannot be read.
    """
    from meshforge.batch import expand, labels_for
    from meshforge.checks import check as findings_of
    from meshforge.cli.output import print_json
    from meshforge.errors import MeshForgeError
    from meshforge.formats import load

    failed = False
    found = expand(assets)
    for path in found:
        error: str | None = None
        findings: tuple[Finding, ...] = ()
        try:
            findings = findings_of(load(path, labels=labels_for(path, labels, found.base)), engine)
        except MeshForgeError as problem:
            error = problem.message
        failed |= error is not None or any(f.severity == "error" for f in findings)
        if json:
            print_json(_line(path, error, findings), compact=True)
        else:
            _print(path, error, findings)
    raise typer.Exit(int(failed))


def _line(path: Path, error: str | None, findings: tuple[Finding, ...]) -> dict[str, Any]:
    rows = [
        {"rule": f.rule, "severity": f.severity, "hulls": list(f.hulls), "message": f.message, "remedy": f.remedy}
        for f in findings
    ]
    return {"asset": str(path), "error": error, "findings": rows}


def _print(path: Path, error: str | None, findings: tuple[Finding, ...]) -> None:
    if error:
        typer.echo(f"{path}: cannot be read\n  {error}")
    elif not findings:
        typer.echo(f"{path}: legal")
    else:
        typer.echo(f"{path}:")
    for finding in findings:
        typer.echo(f"  {finding.severity}: {finding.message}")
        if finding.remedy:
            typer.echo(f"    {finding.remedy}")
