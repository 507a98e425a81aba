"""program.mf, the record of what it was learned from and the templates it names; and the steps that it is learned from:
demonstrations/ID.json, and corrections/ID.json, replayed after the program.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

from pydantic import AliasChoices, ConfigDict, Field

from meshforge import language, synthesis
from meshforge.batch import ManualEdit, action_text
from meshforge.common import MeshForgeError, ProjectError, write_atomically
from meshforge.store.layout import JsonFile, Layout, ReplacedHulls, read_json, write_json


class ProgramRecord(JsonFile):
    """What a program was learned from, and the outcome of learning; question: the id of the one that stayed open."""

    model_config = ConfigDict(populate_by_name=True)

    program: str
    inputs_digest: str = Field(validation_alias=AliasChoices("inputs_digest", "lesson"))
    status: str = "found"
    question: str | None = None


def write_program(layout: Layout, program: language.Program) -> None:
    """Write a program; the one that it replaces stays as `program.previous.mf`."""
    path, text = layout.program, str(program)
    old = path.read_bytes() if path.exists() else text.encode()  # which may be no text in UTF-8
    if old != text.encode():
        write_atomically(layout.previous_program, old)
    write_atomically(path, text)


class StepLine(JsonFile):
    """One step. select: names of hulls, [] for nothing, null for open; action: in the language's own text."""

    rule: Annotated[int, Field(ge=1)]
    select: tuple[str, ...] | None
    action: str
    replaced: ReplacedHulls = Field(default_factory=dict)


class DemonstrationFile(JsonFile):
    """demonstrations/ID.json."""

    asset: str
    steps: tuple[StepLine, ...]


class ManualEditLine(JsonFile):
    """One edit by hand; hulls: the digest of each by its name, so that a hull that changed is noticed."""

    hulls: dict[str, str]
    action: str


class ManualEditsFile(JsonFile):
    """corrections/ID.json."""

    asset: str
    steps: tuple[ManualEditLine, ...]


def parse_action_text(text: str, where: str | Path) -> tuple[language.Action, str | None]:
    """Return the action and the label it gives. Raises ProjectError, about `where`, where the text is no action."""
    try:
        (rule,) = language.Program.parse(f"All => {text}", "action").rules
    except (MeshForgeError, ValueError) as error:
        raise ProjectError(f"{text!r} is no action: {error}", where=str(where)) from error
    return rule.action, rule.label


def read_steps(path: Path) -> tuple[synthesis.Step, ...]:
    """Return the steps in a demonstrations file, none where there is none. Raises ProjectError for no action."""
    kept = read_json(path, DemonstrationFile)
    lines = kept.steps if kept else ()
    return tuple(synthesis.Step(line.rule, line.select, *parse_action_text(line.action, path)) for line in lines)


def read_manual_edits(path: Path) -> tuple[ManualEdit, ...]:
    """Return the edits by hand in a file, none where there is no such file. Raises ProjectError for no action."""
    kept = read_json(path, ManualEditsFile)
    lines = kept.steps if kept else ()
    return tuple(ManualEdit(tuple(line.hulls.items()), *parse_action_text(line.action, path)) for line in lines)


def write_steps(path: Path, asset: str, steps: Sequence[synthesis.Step]) -> None:
    """Write the steps of a demonstrations file, names sorted; without any step the file is removed."""
    if not steps:
        path.unlink(missing_ok=True)
        return
    kept = read_json(path, DemonstrationFile) or DemonstrationFile(asset=asset, steps=())
    lines = tuple(
        StepLine(
            rule=step.rule,
            select=None if step.select is None else tuple(sorted(step.select)),
            action=action_text(step.action, step.label),
        )
        for step in steps
    )
    write_json(path, kept.model_copy(update={"asset": asset, "steps": lines}))


def write_manual_edits(path: Path, asset: str, manual_edits: Sequence[ManualEdit]) -> None:
    """Write the edits by hand of a corrections file; without any the file is removed."""
    if not manual_edits:
        path.unlink(missing_ok=True)
        return
    kept = read_json(path, ManualEditsFile) or ManualEditsFile(asset=asset, steps=())
    lines = [ManualEditLine(hulls=dict(c.hulls), action=action_text(c.action, c.label)) for c in manual_edits]
    write_json(path, kept.model_copy(update={"steps": tuple(lines)}))
