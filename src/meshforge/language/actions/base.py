"""The base of all actions: arguments that are dataclass fields, and groups of hulls that they edit."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import MISSING, Field, dataclass, fields
from typing import Any, ClassVar, cast

from meshforge.common import ProgramError
from meshforge.language.actions.arguments import Argument, TokenKind
from meshforge.language.actions.edit import GroupEdit, HullGroup
from meshforge.symbolic import SymbolicMesh, split_by_body


class Action(ABC):
    """One editing action. A subclass is a frozen dataclass; its fields, in order, are its arguments in a program."""

    __slots__ = ()
    by_body: ClassVar[bool] = False
    """Whether it acts on each body's hulls separately, since what it makes is one part."""

    def __post_init__(self) -> None:
        for name, argument in self.arguments().items():
            value = getattr(self, name)
            if value != _field_default(type(self), name) and not argument.fits(value):
                raise ProgramError(
                    f"{type(self).__name__} takes {argument.wants} as its {name}, not {value!r}",
                    remedy=f"Write {self.usage()}.",
                )
        clash = self.conflict()
        if clash:
            raise ProgramError(clash, remedy=f"Write {self.usage()}.")

    def conflict(self) -> str | None:
        """Why the arguments do not go together, None where they do."""
        return None

    def groups(self, mesh: SymbolicMesh, mask: int) -> list[int]:
        """The parts of a selection that are edited one by one, as bit sets."""
        return split_by_body(mesh, mask) if self.by_body else [mask] if mask else []

    @abstractmethod
    def edit(self, group: HullGroup) -> GroupEdit:
        """What becomes of one group of at least one hull. Raises ProgramError for a missing template."""

    @property
    def makes_hulls(self) -> bool:
        """Whether `as LABEL` may follow."""
        return True

    @property
    def templates(self) -> tuple[str, ...]:
        """The template files it names."""
        return ()

    @classmethod
    def arguments(cls) -> dict[str, Argument]:
        """The kind of each argument by the name of its field, in order."""
        return {f.name: cast(Argument, f.metadata["argument"]) for f in _fields_of(cls)}

    @classmethod
    def min_arguments(cls) -> int:
        """How many arguments cannot be left out."""
        return sum(f.default is MISSING for f in _fields_of(cls))

    @classmethod
    def usage(cls) -> str:
        """How it is written: `Add(+X|-X|..., "file"[, keep])`."""
        parts = ""
        for k, argument in enumerate(cls.arguments().values()):
            text = f"{', ' if k else ''}{argument.usage}"
            parts += text if k < cls.min_arguments() else f"[{text}]"
        return f"{cls.__name__}({parts})" if parts else cls.__name__

    @classmethod
    def summary(cls) -> str:
        """What it does, in one sentence."""
        return (cls.__doc__ or "").strip().splitlines()[0]

    def __str__(self) -> str:
        shown = [
            argument.show(getattr(self, name))
            for name, argument in self.arguments().items()
            if getattr(self, name) != _field_default(type(self), name)
        ]
        return f"{type(self).__name__}({', '.join(shown)})" if shown else type(self).__name__


def _fields_of(kind: type[Action]) -> tuple[Field[Any], ...]:
    return fields(cast(Any, kind))


def _field_default(kind: type[Action], name: str) -> Any:
    return next(f.default for f in _fields_of(kind) if f.name == name)


@dataclass(frozen=True, slots=True)
class ActionArgument(Argument):
    """An action inside another; the parser reads it, since it has arguments of its own."""

    usage = "action"
    wants = "an action"

    def read(self, kind: TokenKind, text: str) -> None:
        return None

    def fits(self, value: Any) -> bool:
        return isinstance(value, Action)
