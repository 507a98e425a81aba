"""The kinds of arguments that actions take: how each is written, read, checked and described."""

from __future__ import annotations

import json
import math
from abc import ABC, abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Literal, get_args

from meshforge.language.syntax import DIRECTIONS

TokenKind = Literal["word", "text", "number", "direction"]
Primitive = Literal["box", "cylinder", "capsule", "sphere"]
PRIMITIVES: tuple[Primitive, ...] = get_args(Primitive)
Axis = Literal["all", "X", "Y", "Z"]
AXES: tuple[Axis, ...] = get_args(Axis)


class Argument(ABC):
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
class WordArgument(Argument):
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
class FlagArgument(Argument):
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
class FileArgument(Argument):
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
        return (
            text if (kind == "word") == (text in PRIMITIVES) and kind in ("word", "text") and self.fits(text) else None
        )

    def show(self, value: Any) -> str:
        return str(value) if value in PRIMITIVES else json.dumps(value, ensure_ascii=False)


@dataclass(frozen=True, slots=True)
class FactorArgument(Argument):
    """A number above 0."""

    usage = "factor"
    wants = "a number above 0"

    def read(self, kind: TokenKind, text: str) -> float | None:
        return float(text) if kind == "number" and self.fits(float(text)) else None

    def fits(self, value: Any) -> bool:
        return isinstance(value, int | float) and math.isfinite(value) and value > 0

    def show(self, value: Any) -> str:
        return show_number(value)


def join_alternatives(words: Iterable[str]) -> str:
    """The words as `a, b or c`."""
    *most, last = words
    return f"{', '.join(most)} or {last}" if most else last


DIRECTION = WordArgument(DIRECTIONS, kind="direction")


def show_number(value: float) -> str:
    """The shortest decimal that reads back as the same float."""
    return repr(float(value)).removesuffix(".0")
