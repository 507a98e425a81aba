"""What every action has in common: arguments that are dataclass fields, and groups of hulls that it edits."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import MISSING, Field, fields
from typing import Any, ClassVar, cast

from meshforge.errors import ProgramError
from meshforge.language.actions.arguments import Argument
from meshforge.language.actions.edit import Edit, Group
from meshforge.symbolic import SymbolicMesh, bodies


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
        return bodies(mesh, mask) if self.by_body else [mask] if mask else []

    @abstractmethod
    def edit(self, group: Group) -> Edit:
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
        return {f.name: cast(Argument, f.metadata["argument"]) for f in _fields(cls)}

    @classmethod
    def min_arguments(cls) -> int:
        """How many arguments cannot be left out."""
        return sum(f.default is MISSING for f in _fields(cls))

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


def _fields(kind: type[Action]) -> tuple[Field[Any], ...]:
    return fields(cast(Any, kind))


def _field_default(kind: type[Action], name: str) -> Any:
    return next(f.default for f in _fields(kind) if f.name == name)
