"""What a person said while a program was learned: listed, and taken back."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from meshforge.project import AnswersFile, Project, RepairLine


def list_answers(project: Project, folder: Path, json: bool) -> None:
    """List all answers and repairs by their ids."""
    from meshforge.cli.output import print_json, remark

    said = project.answers()
    if json:
        print_json(said.model_dump(mode="json", by_alias=True))
        return
    for line in _lines(said):
        typer.echo(line)
    if said.ids:
        remark(f"To take one back: meshforge synthesize {shlex.quote(str(folder))} --forget {shlex.quote(said.ids[0])}")
    else:
        remark("nothing was answered, mended or refused yet")


def _lines(said: AnswersFile) -> Iterator[str]:
    from meshforge.words import counted, listed

    for line in said.answers:
        hulls = f"{counted(len(line.select), 'hull')}: {listed(line.select)}" if line.select else "nothing"
        yield f"{line.id}  {'neither of the choices' if line.select is None else hulls}"
    yield from (f"{line.id}  mended, was {_before(line)}" for line in said.confirmed)
    yield from (f"{line.id}  refused, stays {_before(line)}" for line in said.rejected)


def _before(line: RepairLine) -> str:
    return line.was or "without a label"


def forget(project: Project, folder: Path, ids: Sequence[str]) -> None:
    """Take back what has one of these ids, or everything by `all`."""
    from meshforge.cli.output import remark
    from meshforge.words import counted

    if "all" in ids:
        count = len(project.answers().ids)
        notes = list(project.forget_answers())
        typer.echo(f"taken back: {counted(count, 'answer or repair', 'answers and repairs')}")
    else:
        notes = []
        for said in ids:
            note = project.take_back(said)
            notes += [note] if note else []
            typer.echo(f"taken back: {said}")
    for note in notes:
        remark(note)
    remark(f"Next: meshforge synthesize {shlex.quote(str(folder))}")
