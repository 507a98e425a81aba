"""`meshforge demonstrate`: show on one asset what is to be done, step by step."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from meshforge.cli.console import progress
from meshforge.cli.hulls import find_hulls, is_extractor, labels_of_project, select_hulls
from meshforge.cli.options import asset_id
from meshforge.cli.terminal import remark
from meshforge.common import escape_name, join_names, pluralize
from meshforge.language import Program, Replay, RuleTrace
from meshforge.project import Project, format_next
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis import Step


def demonstrate(
    project: Annotated[Path, typer.Argument(help="A project folder.")],
    asset: Annotated[str, typer.Argument(help="The id of an asset, as `status` lists it, or its file.")],
    steps: Annotated[
        list[str] | None,
        typer.Argument(
            help="One for each rule: 'HULLS => ACTION', hulls by name, number (#5) or pattern, with commas between, or "
            "by an extractor."
        ),
    ] = None,
    clear: Annotated[bool, typer.Option("--clear", help="Take the demonstration of this asset away.")] = False,
) -> None:
    """Record the steps of a demonstration; without steps, show those that are recorded.

    HULLS are names or numbers as `info` lists them, patterns of whole names ('BODY/*' are all hulls of a body), or an
    extractor, 'Is(leg)', which stands for what it selects on this asset; or `nothing` where this asset has nothing to
    select, or `open` where it says nothing about that rule. Step by step, what earlier steps made can be named, too.
    """
    opened = Project.open(project)
    asset = asset_id(asset, opened)
    if clear:
        opened.demonstrate(asset, ())
        remark(f"{escape_name(asset)}: nothing is demonstrated any more")
        return
    with progress(None, f"reading {asset}"):
        recorded = _record_steps(opened, asset, steps or ())
    if steps:
        opened.demonstrate(asset, [step for step, _ in recorded])
    results = {step.rule: line for step, line in recorded}
    for step in opened.steps(asset):
        typer.echo(
            f"{step.rule}. {_format_selection(step)} => {step.action}{f' as {step.label}' if step.label else ''}"
        )
        if results.get(step.rule):
            remark(f"   {results[step.rule]}")
    if steps:
        remark(format_next("demonstrated", project))
    elif not opened.steps(asset):
        remark(f"{escape_name(asset)}: nothing is demonstrated yet")


def _record_steps(project: Project, asset: str, texts: Sequence[str]) -> list[tuple[Step, str]]:
    replay = Replay.begin(project.mesh(asset), project.orientation, project.settings.thresholds.contact)
    numbered, recorded = tuple(replay.mesh.index), []
    for number, text in enumerate(texts, 1):
        hulls, _, done_to_them = text.partition("=>")
        (rule,) = Program.parse(f"All => {done_to_them.strip()}", f"step {number}").rules
        action, label = rule.action, rule.label
        select = _parse_hulls(hulls.strip(), replay.mesh, f"step {number}", numbered, project)
        result = ""
        if select:
            replay = replay.apply(replay.mask_of(select), action, label, project.templates(action.templates))
            result = _describe_result(replay.trace[-1])
        recorded.append((Step(number, select, action, label), result))
    return recorded


def _describe_result(done: RuleTrace) -> str:
    """What a step did: `5 hulls -> 1, of which a~1 joins a, b and 3 more`."""
    joined = next((name for name, of in zip(done.made, done.sources, strict=True) if len(of) > 1), None)
    line = f"{pluralize(len(done.selected), 'hull')} -> {len(done.made)}"
    if joined is not None:
        line += f", of which {escape_name(joined)} joins {join_names(done.sources[done.made.index(joined)])}"
    return line + (f"; {done.note}" if done.note else "")


def _parse_hulls(
    text: str, mesh: SymbolicMesh, where: str, numbered: Sequence[str], project: Project
) -> frozenset[str] | None:
    """The hulls that the left side of a step names; None for `open`. numbered: names in the order of their numbers."""
    if text in ("open", "nothing"):
        return None if text == "open" else frozenset()
    if text not in mesh.index and is_extractor(text, mesh.index):
        known, extremity = partial(labels_of_project, project), project.settings.thresholds.extremity
        return select_hulls(text, mesh, known, where, extremity)
    return find_hulls(text, mesh.index, where, numbered=numbered)


def _format_selection(step: Step) -> str:
    if step.select is None:
        return "open"
    return ", ".join(sorted(step.select)) or "nothing"
