"""The base of all actions, and of the arguments that are their fields: how each kind is written, read, checked and
described."""

from __future__ import annotations

import json
import math
from abc import ABC, abstractmethod
from collections.abc import Iterable
from dataclasses import MISSING, Field, dataclass, fields
from typing import Any, ClassVar, Literal, cast, get_args

from meshforge import symbolic
from meshforge.common import ProgramError
from meshforge.language.actions.edit import GroupEdit, HullGroup
from meshforge.language.words import DIRECTIONS

TokenKind = Literal["word", "text", "number", "direction"]
Primitive = Literal["box", "cylinder", "capsule", "sphere"]
PRIMITIVES: tuple[Primitive, ...] = get_args(Primitive)
Axis = Literal["all", "X", "Y", "Z"]
AXES: tuple[Axis, ...] = get_args(Axis)


class ArgumentType(ABC):
    """One kind of argument; kept as metadata of the action's field."""

    __slots__ = ()

    @property
    @abstractmethod
    def usage(self) -> str:
        """How it is written, as the documentation shows it."""

    @property
    @abstractmethod
    def wants(self) -> str:
        """What it must be, in a sentence."""

    @property
    def choices(self) -> tuple[str, ...]:
        """The words to choose from, where there are such."""
        return ()

    @abstractmethod
    def read(self, kind: TokenKind, text: str) -> Any | None:
        """The value of a piece of program text (a quoted text without its quotes), None where it does not fit."""

    @abstractmethod
    def fits(self, value: Any) -> bool:
        """Whether a value may stand in the action's field."""

    def show(self, value: Any) -> str:
        """The value as program text."""
        return str(value)


@dataclass(frozen=True, slots=True)
class WordArgument(ArgumentType):
    """One of some bare words."""

    words: tuple[str, ...]
    kind: TokenKind = "word"

    @property
    def usage(self) -> str:
        return "|".join(self.words)

    @property
    def wants(self) -> str:
        return join_alternatives(self.words)

    @property
    def choices(self) -> tuple[str, ...]:
        return self.words

    def read(self, kind: TokenKind, text: str) -> str | None:
        return text if kind == self.kind and text in self.words else None

    def fits(self, value: Any) -> bool:
        return value in self.words


@dataclass(frozen=True, slots=True)
class FlagArgument(ArgumentType):
    """A bare word that is there or not."""

    word: str

    @property
    def usage(self) -> str:
        return self.word

    @property
    def wants(self) -> str:
        return self.word

    @property
    def choices(self) -> tuple[str, ...]:
        return (self.word,)

    def read(self, kind: TokenKind, text: str) -> bool | None:
        return True if kind == "word" and text == self.word else None

    def fits(self, value: Any) -> bool:
        return isinstance(value, bool)

    def show(self, value: Any) -> str:
        return self.word


@dataclass(frozen=True, slots=True)
class FileArgument(ArgumentType):
    """A quoted path of a template file."""

    usage = '"file"'
    wants = "a file name in double quotes"

    def read(self, kind: TokenKind, text: str) -> str | None:
        return text if kind == "text" and self.fits(text) else None

    def fits(self, value: Any) -> bool:
        return isinstance(value, str) and bool(value) and value.isprintable()

    def show(self, value: Any) -> str:
        return json.dumps(value, ensure_ascii=False)


@dataclass(frozen=True, slots=True)
class PrimitiveOrFileArgument(FileArgument):
    """The bare word of a primitive, or a quoted path of a template file."""

    usage = "|".join((*PRIMITIVES, FileArgument.usage))
    wants = f"{', '.join(PRIMITIVES)} or {FileArgument.wants}"
    choices = PRIMITIVES

    def read(self, kind: TokenKind, text: str) -> str | None:
        if text in PRIMITIVES:
            return text if kind == "word" else None
        return FileArgument.read(self, kind, text)

    def show(self, value: Any) -> str:
        return str(value) if value in PRIMITIVES else json.dumps(value, ensure_ascii=False)


@dataclass(frozen=True, slots=True)
class FactorArgument(ArgumentType):
    """A number above 0."""

    usage: str = "factor"
    wants: str = "a number above 0"

    def read(self, kind: TokenKind, text: str) -> float | None:
        return float(text) if kind == "number" and self.fits(float(text)) else None

    def fits(self, value: Any) -> bool:
        return isinstance(value, int | float) and math.isfinite(value) and value > 0

    def show(self, value: Any) -> str:
        return show_number(value)


@dataclass(frozen=True, slots=True)
class LengthArgument(FactorArgument):
    """A length above 0 [m]."""

    usage: str = "metres"
    wants: str = "a length in metres above 0"


@dataclass(frozen=True, slots=True)
class OptionArgument(ArgumentType):
    """An option with a value: `word = value`."""

    word: str
    value: ArgumentType

    @property
    def usage(self) -> str:
        return f"{self.word} = {self.value.usage}"

    @property
    def wants(self) -> str:
        return f"{self.value.wants} as its {self.word}"

    @property
    def choices(self) -> tuple[str, ...]:
        return (self.word,)

    def read(self, kind: TokenKind, text: str) -> Any | None:
        return self.value.read(kind, text)

    def fits(self, value: Any) -> bool:
        return self.value.fits(value)

    def show(self, value: Any) -> str:
        return f"{self.word} = {self.value.show(value)}"


DIRECTION = WordArgument(DIRECTIONS, kind="direction")


class Action(ABC):
    """One editing action. A subclass is a frozen dataclass; its fields, in order, are its arguments in a program."""

    __slots__ = ()
    by_body: ClassVar[bool] = False
    """Whether it acts on each body's hulls separately, since what it makes is one part."""
    planned: ClassVar[tuple[str, ...]] = ()
    """Options that the language has, and that this version does not run."""

    def __post_init__(self) -> None:
        for name, argument in self.arguments().items():
            value = getattr(self, name)
            if value != _field_default(type(self), name) and not argument.fits(value):
                problem = f"{type(self).__name__} takes {argument.wants} as its {name}, not {value!r}"
                raise ProgramError(problem, remedy=f"Write {self.usage()}.")
        clash = self.conflict()
        if clash:
            raise ProgramError(clash, remedy=f"Write {self.usage()}.")

    def conflict(self) -> str | None:
        """Why the arguments do not go together, None where they do."""
        return None

    def groups(self, mesh: symbolic.SymbolicMesh, mask: int) -> list[int]:
        """The parts of a selection that are edited one by one, as bit sets."""
        return symbolic.split_by_body(mesh, mask) if self.by_body else [mask] if mask else []

    def note_on(self, mesh: symbolic.SymbolicMesh, mask: int) -> str | None:
        """What a user should know of acting on a selection, besides the notes on its parts."""
        return None

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

    @property
    def depends_on_frame(self) -> bool:
        """Whether it would do something else if the mesh were turned first, and back afterwards."""
        return False

    @classmethod
    def arguments(cls) -> dict[str, ArgumentType]:
        """The kind of each argument by the name of its field, in order."""
        return {f.name: cast(ArgumentType, f.metadata["argument"]) for f in _fields_of(cls)}

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
class ActionArgument(ArgumentType):
    """An action inside another; the parser reads it, since it has arguments of its own."""

    usage = "action"
    wants = "an action"

    def read(self, kind: TokenKind, text: str) -> None:
        return None

    def fits(self, value: Any) -> bool:
        return isinstance(value, Action)


def join_alternatives(words: Iterable[str]) -> str:
    """The words as `a, b or c`."""
    *most, last = words
    return f"{', '.join(most)} or {last}" if most else last


def show_number(value: float) -> str:
    """The shortest decimal that reads back as the same float."""
    return repr(float(value)).removesuffix(".0")
