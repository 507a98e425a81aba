"""`meshforge demonstrate`: show on one asset what is to be done, step by step."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from meshforge.cli.hulls import find_hulls
from meshforge.cli.options import asset_id
from meshforge.cli.terminal import remark
from meshforge.language import Program, apply_action, to_canonical_frame
from meshforge.project import Project
from meshforge.symbolic import SymbolicMesh, mask_of
from meshforge.synthesis import Step


def demonstrate(
    project: Annotated[Path, typer.Argument(help="A project folder.")],
    asset: Annotated[str, typer.Argument(help="The id of an asset, as `status` lists it, or its file.")],
    steps: Annotated[
        list[str] | None,
        typer.Argument(help="One for each rule: 'HULLS => ACTION', hulls by name or pattern, with commas between."),
    ] = None,
    clear: Annotated[bool, typer.Option("--clear", help="Take the demonstration of this asset away.")] = False,
) -> None:
    """Record the steps of a demonstration; without steps, show those that are recorded.

    HULLS are names as `info` lists them (patterns as in a shell: 'leg_*'), or `nothing` where this asset has nothing to
    select, or `open` where it says nothing about that rule. Step by step, what earlier steps made can be named, too.
    """
    opened = Project.open(project)
    asset = asset_id(asset, opened)
    if clear:
        opened.demonstrate(asset, ())
        remark(f"{asset}: nothing is demonstrated any more")
        return
    if steps:
        opened.demonstrate(asset, _record_steps(opened, asset, steps))
    for step in opened.steps(asset):
        typer.echo(
            f"{step.rule}. {_format_selection(step)} => {step.action}{f' as {step.label}' if step.label else ''}"
        )
    if steps:
        remark(f"Next: meshforge synthesize {project}")


def _record_steps(project: Project, asset: str, texts: Sequence[str]) -> list[Step]:
    mesh = to_canonical_frame(project.mesh(asset), project.orientation, project.settings.thresholds.contact)[0]
    recorded, used = [], frozenset[str]()
    for number, text in enumerate(texts, 1):
        hulls, _, done_to_them = text.partition("=>")
        (rule,) = Program.parse(f"All => {done_to_them.strip()}", f"step {number}").rules
        action, label = rule.action, rule.label
        select = _parse_hulls(hulls, mesh, number)
        recorded.append(Step(number, select, action, label))
        if select:
            templates = project.templates(action.templates)
            mask = mask_of(mesh.index[name] for name in select)
            done = apply_action(mesh, mask, action, templates, label, used)
            mesh, used = done.mesh, done.used
    return recorded


def _parse_hulls(text: str, mesh: SymbolicMesh, number: int) -> frozenset[str] | None:
    """The hulls that the left side of a step names; None for `open`."""
    text = text.strip()
    if text in ("open", "nothing"):
        return None if text == "open" else frozenset()
    return find_hulls(text, mesh.index, f"step {number}")


def _format_selection(step: Step) -> str:
    if step.select is None:
        return "open"
    return ", ".join(sorted(step.select)) or "nothing"
