"""The file of `synthesize --answers`: what a script answers to questions."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from meshforge.project import Project
    from meshforge.synthesis import Answer

FORM = (
    'The file holds a list of {"question": "RULE:ASSET", "choice": 1} (null for neither) '
    'or {"rule": 1, "asset": "ASSET", "select": ["HULL", ...]} (null for neither).'
)


@dataclass(frozen=True, slots=True)
class Given:
    """What a file answers. direct: whether asked or not; choices: by the question's id, counted from 1."""

    direct: tuple[Answer, ...]
    choices: dict[str, int | None]


def read_given(path: Path, project: Project) -> Given:
    """Read the file. Raises UsageError naming the entry: not of that form, or a question that cannot be."""
    from meshforge.synthesis import Answer

    entries = _entries(path)
    direct, choices = [], {}
    for number, entry in enumerate(entries, 1):
        match entry:
            case {"question": str(question), "choice": int() | None as choice, **rest} if not rest:
                if isinstance(choice, bool) or (choice is not None and choice < 1):
                    raise _wrong(path, number, f"the choice {choice!r} is no number from 1")
                _check(question, path, number, project)
                choices[question] = choice
            case {"rule": int(rule), "asset": str(asset), "select": list() | None as select, **rest} if rest.keys() <= {
                "id",
                "action",
                "refused",
            } and all(isinstance(name, str) for name in select or ()):
                project.path(asset)
                direct.append(Answer(rule, asset, select))
            case _:
                raise _wrong(path, number, "it has not the right form")
    return Given(tuple(direct), choices)


def _entries(path: Path) -> list[Any]:
    from meshforge.errors import UsageError

    try:
        entries = json.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise UsageError(f"cannot be read: {error.strerror}", where=str(path)) from error
    except ValueError as error:
        raise UsageError(f"this is no JSON: {error}", where=str(path), remedy=FORM) from error
    if not isinstance(entries, list):
        raise UsageError("this is no list of answers", where=str(path), remedy=FORM)
    return entries


def _check(question: str, path: Path, number: int, project: Project) -> None:
    """Whether there can be such a question: of a rule, and an asset of the project."""
    rule, _, asset = question.partition(":")
    if not rule.isdecimal() or not asset:
        raise _wrong(path, number, f"{question!r} is no question; one is called RULE:ASSET")
    project.path(asset)


def _wrong(path: Path, number: int, problem: str) -> Exception:
    from meshforge.errors import UsageError

    return UsageError(f"answer {number}: {problem}", where=str(path), remedy=FORM)
