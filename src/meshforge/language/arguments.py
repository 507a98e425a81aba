"""What actions and leaf extractors have in common: frozen classes whose fields are their arguments in a program; how
each kind of argument is written, read, checked and described."""

from __future__ import annotations

import json
import math
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from dataclasses import MISSING, dataclass, fields
from functools import cache
from typing import Any, ClassVar, Literal, NoReturn, cast, get_args

from meshforge.common import Plugin, PluginError, ProgramError
from meshforge.language.words import DIRECTIONS, check_direction, check_label, show_label

TokenKind = Literal["word", "text", "number", "direction", "quantity"]
Primitive = Literal["box", "cylinder", "capsule", "sphere"]
PRIMITIVES: tuple[Primitive, ...] = get_args(Primitive)


class ArgumentType(ABC):
    """One kind of argument; kept as metadata of the field.

    usage: how it is written; wants: what it must be, in a sentence; choices: the words to choose from, if any;
    symbol: what stands for it in the grammar of leaf extractors.
    """

    usage: str
    wants: str
    choices: tuple[str, ...] = ()
    symbol: ClassVar[str] = "_value"

    def read(self, kind: TokenKind, text: str) -> Any | None:
        """Return the value of a piece of program text (without quotes); None where it does not fit, or the parser
        reads it itself, as what has arguments of its own."""
        return None

    @abstractmethod
    def fits(self, value: Any) -> bool:
        """Return whether a value may stand in the field."""

    def check(self, kind: type[Operation], name: str, value: Any) -> None:
        """Raise ProgramError for a value that may not stand in the field `name` of an operation."""
        if not self.fits(value):
            problem = f"{kind.word()} takes {self.wants} as its {name}, not {value!r}"
            raise ProgramError(problem, remedy=f"Write {kind.usage()}.")

    def show(self, value: Any) -> str:
        """Return the value as program text."""
        return str(value)

    def sort_key(self, value: Any, labels: Mapping[str, int]) -> Any:
        """Return what sorts values, those first that are believed more; labels: the place of each in the vocabulary."""
        return value


class WordArgument(ArgumentType):
    """One of some bare words."""

    symbol = "NAME"

    def __init__(self, words: tuple[str, ...], kind: TokenKind = "word") -> None:
        self.usage, self.wants, self.choices = "|".join(words), join_alternatives(words), words
        self._kind = kind

    def read(self, kind: TokenKind, text: str) -> str | None:
        return text if kind == self._kind and text in self.choices else None

    def fits(self, value: Any) -> bool:
        return value in self.choices

    def sort_key(self, value: Any, labels: Mapping[str, int]) -> int:
        return self.choices.index(value)


class DirectionArgument(WordArgument):
    """A direction. Up and down sort first: the turn about the upright axis is often a convention."""

    symbol = "DIRECTION"

    def __init__(self) -> None:
        super().__init__(DIRECTIONS, "direction")

    def check(self, kind: type[Operation], name: str, value: Any) -> None:
        check_direction(value)

    def sort_key(self, value: Any, labels: Mapping[str, int]) -> int:
        return ("+Z", "-Z", "+X", "-X", "+Y", "-Y").index(value)


class FlagArgument(ArgumentType):
    """A bare word that is there or not."""

    symbol = "NAME"

    def __init__(self, word: str) -> None:
        self.usage, self.wants, self.choices = word, word, (word,)

    def read(self, kind: TokenKind, text: str) -> bool | None:
        return True if kind == "word" and text == self.usage else None

    def fits(self, value: Any) -> bool:
        return isinstance(value, bool)

    def show(self, value: Any) -> str:
        return self.usage


class TextArgument(ArgumentType):
    """A quoted text."""

    symbol = "STRING"
    usage = '"text"'
    wants = "a text in double quotes"

    def read(self, kind: TokenKind, text: str) -> str | None:
        return text if kind == "text" and self.fits(text) else None

    def fits(self, value: Any) -> bool:
        return isinstance(value, str) and bool(value) and value.isprintable()

    def show(self, value: Any) -> str:
        return json.dumps(value, ensure_ascii=False)


class FileArgument(TextArgument):
    """A quoted path of a template file."""

    usage = '"file"'
    wants = "a file name in double quotes"


class PrimitiveOrFileArgument(FileArgument):
    """The bare word of a primitive, or a quoted path of a template file."""

    symbol = "_value"
    usage = "|".join((*PRIMITIVES, FileArgument.usage))
    wants = f"{', '.join(PRIMITIVES)} or {FileArgument.wants}"
    choices = PRIMITIVES

    def read(self, kind: TokenKind, text: str) -> str | None:
        if text in PRIMITIVES:
            return text if kind == "word" else None
        return super().read(kind, text)

    def show(self, value: Any) -> str:
        return str(value) if value in PRIMITIVES else super().show(value)


class FactorArgument(ArgumentType):
    """A number above 0."""

    symbol = "NUMBER"
    usage = "factor"
    wants = "a number above 0"

    def read(self, kind: TokenKind, text: str) -> float | None:
        return float(text) if kind == "number" and self.fits(float(text)) else None

    def fits(self, value: Any) -> bool:
        return isinstance(value, int | float) and math.isfinite(value) and value > 0

    def show(self, value: Any) -> str:
        return show_number(value)


class LengthArgument(FactorArgument):
    """A length above 0 [m]."""

    usage = "metres"
    wants = "a length in metres above 0"


class ShareArgument(FactorArgument):
    """A share of something, above 0 and at most 1."""

    usage = "share"
    wants = "a share above 0 and at most 1"

    def fits(self, value: Any) -> bool:
        return super().fits(value) and value <= 1


class LabelArgument(ArgumentType):
    """A label, bare or in double quotes; the parser reads it, since it knows which are declared."""

    symbol = "label"
    usage = "label"
    wants = "a label"

    def fits(self, value: Any) -> bool:
        return isinstance(value, str) and bool(value)

    def check(self, kind: type[Operation], name: str, value: Any) -> None:
        check_label(value)

    def show(self, value: Any) -> str:
        return show_label(value)

    def sort_key(self, value: Any, labels: Mapping[str, int]) -> int:
        return labels[value]


UNITS = {"mm": 0.001, "cm": 0.01, "m": 1.0, "g": 0.001, "kg": 1.0, "N": 1.0, "s": 1.0, "deg": 1.0}
"""What a unit is in metres, kilograms, newtons, seconds or degrees."""
_LIKE = {"mm": "m", "cm": "m", "g": "kg"}
_WANTS = {"m": "a length above 0", "deg": "an angle above 0"}


@dataclass(frozen=True, order=True, slots=True)
class Share:
    """A share of something that is measured, such as of an opening, above 0; text: `80%`."""

    value: float

    def __str__(self) -> str:
        return f"{show_number(round(100 * self.value, 10))}%"


class QuantityArgument(ArgumentType):
    """A number above 0 with a unit, of which a bare one has that of the argument; or, where the argument is a share of
    something by default, a `Share`. Values are floats in the argument's unit.

    unit: m or deg; of: what a share is of, empty for no shares.
    """

    symbol = "QUANTITY"

    def __init__(self, unit: Literal["m", "deg"], of: str = "") -> None:
        self._unit, self._of = unit, of
        self.usage = {"m": "length", "deg": "angle"}[unit] + ("|share%" if of else "")
        example = {"m": "80 mm", "deg": "90 deg"}[unit]
        self.wants = f"{_WANTS[unit]} such as {example}{f', or a share of {of} such as 80%' if of else ''}"

    def read(self, kind: TokenKind, text: str) -> float | Share | None:
        if kind not in ("quantity", "number"):
            return None
        number = text.rstrip("%" + "".join(UNITS))
        unit = text[len(number) :]
        value = float(number) / 100 if unit == "%" else float(number) * UNITS[unit or self._unit]
        suits = bool(self._of) if unit == "%" else _LIKE.get(unit, unit or self._unit) == self._unit
        found = Share(value) if unit == "%" else value
        return found if suits and self.fits(found) else None

    def fits(self, value: Any) -> bool:
        number = value.value if isinstance(value, Share) and self._of else value
        return isinstance(number, int | float) and math.isfinite(number) and number > 0

    def show(self, value: Any) -> str:
        return str(value) if isinstance(value, Share) else show_number(value)


class OptionArgument(ArgumentType):
    """An option with a value: `word = value`."""

    def __init__(self, word: str, value: ArgumentType) -> None:
        self.usage, self.wants, self.choices = f"{word} = {value.usage}", f"{value.wants} as its {word}", (word,)
        self.value = value

    def read(self, kind: TokenKind, text: str) -> Any | None:
        return self.value.read(kind, text)

    def fits(self, value: Any) -> bool:
        return self.value.fits(value)

    def show(self, value: Any) -> str:
        return f"{self.choices[0]} = {self.value.show(value)}"


class Operation:
    """An action or a leaf extractor. A subclass is a frozen dataclass; its fields, in order, are its arguments in a
    program, each with metadata={"argument": its kind}; for the studio's form also `title`, its name there, `omitted`,
    what happens without it, and `words`, longer texts for some of its words."""

    __slots__ = ()
    owner: ClassVar[Plugin | None] = None
    """The plug-in that the class comes from, None for a built-in one."""

    @classmethod
    def word(cls) -> str:
        """Return the word for it in a text: the name of the class."""
        return cls.__name__

    def __post_init__(self) -> None:
        for name, argument in self.arguments().items():
            value = getattr(self, name)
            if not self._leaves_out(name, value):
                argument.check(type(self), name, value)
        clash = self.conflict()
        if clash:
            raise ProgramError(clash, remedy=f"Write {self.usage()}.")

    @property
    def plugin(self) -> Plugin | None:
        """The plug-in that does its work, None for a built-in one."""
        return self.owner

    def conflict(self) -> str | None:
        """Return why the arguments do not go together, None where they do."""
        return None

    @classmethod
    def arguments(cls) -> Mapping[str, ArgumentType]:
        """Return the kind of each argument by the name of its field, in order."""
        return _read_fields(cast(Any, cls))[0]

    @classmethod
    def options(cls) -> Mapping[str, Any]:
        """Return the arguments that may be left out, the last ones, with their defaults."""
        return _read_fields(cast(Any, cls))[1]

    @classmethod
    def min_arguments(cls) -> int:
        """Return how many arguments cannot be left out."""
        return len(cls.arguments()) - len(cls.options())

    @classmethod
    def usage(cls) -> str:
        """Return how it is written: `Add(+X|-X|..., "file"[, keep])`."""
        parts = ""
        for k, argument in enumerate(cls.arguments().values()):
            text = f"{', ' if k else ''}{argument.usage}"
            parts += text if k < cls.min_arguments() else f"[{text}]"
        return f"{cls.word()}({parts})" if parts else cls.word()

    @classmethod
    def summary(cls) -> str:
        """Return what it does, in one sentence."""
        return (cls.__doc__ or "").strip().splitlines()[0]

    def values(self) -> dict[str, Any]:
        """Return the arguments that differ from their defaults, by name."""
        given = {name: getattr(self, name) for name in self.arguments()}
        return {name: value for name, value in given.items() if not self._leaves_out(name, value)}

    def __str__(self) -> str:
        shown = [self.arguments()[name].show(value) for name, value in self.values().items()]
        return f"{self.word()}({', '.join(shown)})" if shown else self.word()

    def _leaves_out(self, name: str, value: Any) -> bool:
        return name in self.options() and value == self.options()[name]


@dataclass(frozen=True, slots=True)
class MissingOperation(Operation):
    """Stands for an operation of a plug-in that cannot be loaded in this process; it prints as that, and fails."""

    source: Plugin
    text: str
    error: PluginError

    @property
    def plugin(self) -> Plugin:
        return self.source

    def fail(self) -> NoReturn:
        """Raise PluginError: why it cannot be loaded."""
        raise PluginError(self.error.problem, where=self.error.where, remedy=self.error.remedy)

    def __str__(self) -> str:
        return self.text


@cache
def _read_fields(kind: Any) -> tuple[Mapping[str, ArgumentType], Mapping[str, Any]]:
    found = [one for one in fields(kind) if "argument" in one.metadata]
    options = {one.name: one.default for one in found if one.default is not MISSING}
    return {one.name: one.metadata["argument"] for one in found}, options


def join_alternatives(words: Iterable[str]) -> str:
    """Return the words as `a, b or c`."""
    *most, last = words
    return f"{', '.join(most)} or {last}" if most else last


def show_number(value: float) -> str:
    """Return the shortest decimal that reads back as the same float."""
    return repr(float(value)).removesuffix(".0")
