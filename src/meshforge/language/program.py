"""Programs: a vocabulary, an orientation and rules, with the comments of the text they came from."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.errors import ProgramError, nearest
from meshforge.language.actions import Action
from meshforge.language.evaluate import labels_used
from meshforge.language.syntax import Extractor, Orient, check_label
from meshforge.language.template import Template
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from meshforge.language.run import RunResult

Lines = tuple[str | None, ...]
"""Comment lines without their `#`; None is an empty line."""


@dataclass(frozen=True, slots=True)
class Comments:
    """The lines above a statement and the comment at its end."""

    above: Lines = ()
    beside: str | None = None


@dataclass(frozen=True, slots=True)
class HeaderComments:
    """The comments of the header lines, and those after the last statement."""

    labels: Comments = Comments()
    contact: Comments = Comments()
    extremity: Comments = Comments()
    orient: Comments = Comments()
    end: Lines = ()


@dataclass(frozen=True, slots=True)
class Rule:
    """One rule: what to select, what to do with it, and the label for what is made (None: that of the largest hull).

    Comments do not count when rules are compared.
    """

    extractor: Extractor
    action: Action
    label: str | None = None
    comments: Comments = field(default=Comments(), compare=False)

    def __post_init__(self) -> None:
        if self.label is None:
            return
        check_label(self.label)
        if not self.action.makes_hulls:
            raise ProgramError(f"{self.action} makes no hull that could take the label {self.label!r}")

    def __str__(self) -> str:
        from meshforge.language.print import show

        return show(self)


@dataclass(frozen=True, slots=True)
class Program:
    """A batch-editing program; a program without declared labels declares those it uses.

    contact, extremity: epsilon and delta where the program sets them; None takes the mesh's and 0.05.
    Raises ProgramError for a label that is used, but not declared, and for a threshold outside 0..1.
    """

    labels: tuple[str, ...] = ()
    orient: Orient | None = None
    rules: tuple[Rule, ...] = ()
    contact: float | None = None
    extremity: float | None = None
    comments: HeaderComments = field(default=HeaderComments(), compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "labels", tuple(self.labels) or self.labels_in_use)
        object.__setattr__(self, "rules", tuple(self.rules))
        for label in self.labels:
            check_label(label)
            if self.labels.count(label) > 1:
                raise ProgramError(f"the label {label!r} is declared twice")
        for label in self.labels_in_use:
            check_declared(label, self.labels)
        check_threshold("contact", self.contact)
        check_threshold("extremity", self.extremity)

    @property
    def labels_asked(self) -> tuple[str, ...]:
        """The labels that landmarks and extractors ask for, each once, in order of mention."""
        pairs = self.orient.pairs if self.orient else ()
        asked: list[Extractor] = [end for pair in pairs for end in (pair.start, pair.end)]
        asked += [rule.extractor for rule in self.rules]
        return tuple(dict.fromkeys(label for extractor in asked for label in labels_used(extractor)))

    @property
    def labels_in_use(self) -> tuple[str, ...]:
        """The labels asked for, then those that rules give to what they make."""
        given = [rule.label for rule in self.rules if rule.label is not None]
        return tuple(dict.fromkeys([*self.labels_asked, *given]))

    @property
    def templates(self) -> tuple[str, ...]:
        """The template files that the rules name, each once, in order of mention."""
        return tuple(dict.fromkeys(name for rule in self.rules for name in rule.action.templates))

    @staticmethod
    def parse(text: str, name: str = "program") -> Program:
        """The program in a text. Raises ProgramError at `name:line:column`, with the line and a caret."""
        from meshforge.language.parse import parse

        return parse(text, name)

    @staticmethod
    def read(path: Path | str) -> Program:
        """The program in a file. Raises ProgramError where it cannot be read or does not parse."""
        from meshforge.language.parse import read

        return read(Path(path))

    def run(self, mesh: SymbolicMesh, templates: Mapping[str, Template] | None = None) -> RunResult:
        """The program's edit of a mesh, with a trace. Raises ProgramError where it cannot run on this mesh."""
        from meshforge.language.run import run

        return run(self, mesh, templates or {})

    def __str__(self) -> str:
        from meshforge.language.print import _program

        return "".join(f"{line}\n" for line in _program(self))


def check_declared(label: str, declared: tuple[str, ...]) -> None:
    """Raises ProgramError for a label that is not among those declared."""
    if label not in declared:
        like = nearest(label, declared)
        hint = f"Did you mean {like!r}? " if like else ""
        raise ProgramError(f"unknown label {label!r}", remedy=f"{hint}Declared labels: {', '.join(declared)}.")


def check_threshold(name: str, value: float | None) -> None:
    """Raises ProgramError for a threshold that is not a number above 0 and at most 1."""
    if value is not None and not (math.isfinite(value) and 0 < value <= 1):
        raise ProgramError(f"{name} is a share of a diagonal, above 0 and at most 1, not {value:g}")
