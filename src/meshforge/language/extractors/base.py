"""The nodes of extractors: leaves, which are classes of their own in a registry, and set operators over extractors; and
what they select (paper, figures of the DSL and of its semantics)."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal, TypeVar, assert_never

import numpy as np

from meshforge.common import ProgramError, blame
from meshforge.language.arguments import ArgumentType, LabelArgument, MissingOperation, Operation
from meshforge.language.hull_table import EXTREMITY, Bools, HullTable
from meshforge.symbolic import SymbolicMesh, bits_of

L = TypeVar("L", bound="Leaf")


class _Selector:
    """Lets every extractor be asked for its selection, and be combined by `&`, `|` and `-`."""

    __slots__ = ()

    def __and__(self, other: Extractor) -> Intersect:
        return Intersect(_as_extractor(self), other)

    def __or__(self, other: Extractor) -> Union:
        return Union(_as_extractor(self), other)

    def __sub__(self, other: Extractor) -> Diff:
        return Diff(_as_extractor(self), other)

    def select(self, mesh: SymbolicMesh, extremity: float = EXTREMITY) -> frozenset[int]:
        return select(_as_extractor(self), mesh, extremity)


@dataclass(frozen=True, slots=True)
class Candidates:
    """What a search chooses leaves from.

    labels: the vocabulary; bases: the base extractors of the search, for leaves that refine one; meshes: of the family,
    as they come in.
    """

    labels: tuple[str, ...]
    bases: tuple[BaseExtractor, ...]
    meshes: tuple[SymbolicMesh, ...] = ()


class Leaf(_Selector, Operation, ABC):
    """An extractor without set operators; with base extractors it selects hulls of the first only."""

    __slots__ = ()
    layer: ClassVar[Literal["S", "T", "G"]] = "S"
    """Whether it asks for labels (S), contact (T) or position (G): a search may leave some of these out (paper)."""

    @abstractmethod
    def mask(self, hulls: HullTable, *bases: Bools) -> Bools:
        """Return which hulls it selects (hulls,); bases: what each of its base extractors selects.

        What is built in gets the hulls of many meshes side by side, and keeps them apart by `hulls.owner`; a leaf of a
        plug-in those of one mesh.
        """

    @property
    @abstractmethod
    def phrase(self) -> str:
        """What it selects, in words: of a leaf with a base what follows the words for that one, `that touch a drawer
        hull`, else a phrase of its own, `the leg hulls`."""

    @classmethod
    def enumerate(cls: type[L], candidates: Candidates) -> Iterator[L]:
        """Yield the leaves of this kind that a search may use: none, where only people write it."""
        yield from ()

    @property
    def cost(self) -> float:
        """How little it is believed for what it asks [nats], besides its nodes: more for what fits by accident."""
        return 1.65 + sum(base.cost for base in self.bases)

    @property
    def uncertainty(self) -> int:
        """The doubts by which a search, which knows no shares, puts it behind others of its size."""
        return 1 + sum(base.uncertainty for base in self.bases)

    @property
    def bases(self) -> tuple[BaseExtractor, ...]:
        """The base extractors that it takes, in order."""
        values = (getattr(self, name) for name in self.arguments())
        return tuple(value for value in values if isinstance(value, BaseExtractor))

    @property
    def size(self) -> int:
        """Its syntax nodes: itself and its bases."""
        return 1 + len(self.bases)

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels it asks for, in order of mention."""
        own = (getattr(self, name) for name, kind in self.arguments().items() if isinstance(kind, LabelArgument))
        return (*own, *(label for base in self.bases for label in base.labels))

    def rename(self: L, old: str, new: str) -> L:
        """Return the same with a label by another name."""
        given = {name: (kind, getattr(self, name)) for name, kind in self.arguments().items()}
        changed: dict[str, Any] = {
            name: value.rename(old, new) if isinstance(value, BaseExtractor) else new
            for name, (kind, value) in given.items()
            if isinstance(value, BaseExtractor) or (isinstance(kind, LabelArgument) and value == old)
        }
        return replace(self, **changed) if changed else self  # type: ignore[type-var]  # it is a dataclass


class BaseExtractor(Leaf):
    """A leaf that others refine: it takes no base itself."""

    __slots__ = ()

    def one(self, *, other: bool) -> str:
        """Return one of its hulls, in words; other: one besides the hull that is spoken of."""
        return f"{'another' if other else 'one'} of {self.phrase}"


@dataclass(frozen=True, slots=True)
class MissingExtractor(MissingOperation, BaseExtractor):
    """A leaf that cannot be loaded here."""

    def mask(self, hulls: HullTable, *bases: Bools) -> Bools:
        self.fail()

    @property
    def phrase(self) -> str:
        return f"what {self} selects"


class BaseArgument(ArgumentType):
    """A base extractor; the parser reads it, since it has arguments of its own."""

    symbol = "_base"
    usage = "base"
    wants = "All or Is(label)"

    def fits(self, value: Any) -> bool:
        return isinstance(value, BaseExtractor)

    def check(self, kind: type[Any], name: str, value: Any) -> None:
        if not self.fits(value):
            remedy = "Combine selections with Union, Intersect and Diff instead of nesting them."
            raise ProgramError(f"{kind.__name__} takes {self.wants}, not {value!r}", remedy=remedy)


class ExtractorArgument(ArgumentType):
    """Any extractor; the parser reads it, as above."""

    symbol = "_extractor"
    usage = "extractor"
    wants = "an extractor such as Is(label)"

    def fits(self, value: Any) -> bool:
        return isinstance(value, Extractor)


@dataclass(frozen=True, slots=True)
class _SetOperator(_Selector):
    left: Extractor
    right: Extractor

    def __post_init__(self) -> None:
        for operand in (self.left, self.right):
            if not isinstance(operand, Leaf | _SetOperator):
                remedy = None
                if isinstance(operand, type) and issubclass(operand, Leaf):
                    remedy = f"Write {operand.__name__}()."
                raise ProgramError(f"{type(self).__name__} takes extractors, not {operand!r}", remedy=remedy)

    def __str__(self) -> str:
        return f"{type(self).__name__}({self.left}, {self.right})"


@dataclass(frozen=True, slots=True)
class Union(_SetOperator):
    """The hulls of either."""


@dataclass(frozen=True, slots=True)
class Intersect(_SetOperator):
    """The hulls of both."""


@dataclass(frozen=True, slots=True)
class Diff(_SetOperator):
    """The hulls of `left` that are not in `right`."""


Extractor = Leaf | Union | Intersect | Diff
SET_OPERATORS: tuple[type[Union | Intersect | Diff], ...] = (Union, Intersect, Diff)


def _as_extractor(node: _Selector) -> Extractor:
    assert isinstance(node, Leaf | Union | Intersect | Diff)
    return node


def select(extractor: Extractor, mesh: SymbolicMesh, extremity: float = EXTREMITY) -> frozenset[int]:
    """Return indices of the hulls that an extractor selects, in the frame the mesh is in."""
    return bits_of(select_mask(extractor, mesh, extremity))


def select_mask(
    extractor: Extractor, mesh: SymbolicMesh, extremity: float = EXTREMITY, labels: Sequence[str | None] | None = None
) -> int:
    """Return the selection as a bit set. labels: of the hulls, in place of those that they have."""
    return to_bits(select_hulls(extractor, HullTable([mesh], labels, extremity)))


def to_bits(selected: Bools) -> int:
    """Return the selection of some hulls (hulls,) as a bit set."""
    return int.from_bytes(np.packbits(selected, bitorder="little").tobytes(), "little")


def select_hulls(extractor: Extractor, hulls: HullTable) -> Bools:
    """Return which of the hulls of some meshes an extractor selects (hulls,); of the same table each leaf is asked
    once.

    Raises PluginError for what a leaf of a plug-in does wrong.
    """
    match extractor:
        case Leaf():
            return hulls.recall(extractor, lambda: _select_by_leaf(extractor, hulls))
        case Union(left, right):
            return select_hulls(left, hulls) | select_hulls(right, hulls)
        case Intersect(left, right):
            return select_hulls(left, hulls) & select_hulls(right, hulls)
        case Diff(left, right):
            return select_hulls(left, hulls) & ~select_hulls(right, hulls)
        case _:
            assert_never(extractor)


def _select_by_leaf(leaf: Leaf, hulls: HullTable) -> Bools:
    bases = [select_hulls(base, hulls) for base in leaf.bases]
    if leaf.plugin is None:
        return leaf.mask(hulls, *bases)
    found = np.zeros(len(hulls), dtype=np.bool_)
    for part, start, end in zip(hulls.split(), hulls.starts, hulls.starts[1:], strict=False):
        with blame(leaf.plugin):
            chosen = leaf.mask(part, *(base[start:end] for base in bases))
        if not isinstance(chosen, np.ndarray) or chosen.dtype != np.bool_ or chosen.shape != (end - start,):
            what = f"{chosen.dtype} {chosen.shape}" if isinstance(chosen, np.ndarray) else type(chosen).__name__
            remedy = "Its method mask returns an array of booleans, one for each hull."
            raise leaf.plugin.error(f"selects by {what}, not by {end - start} booleans", remedy=remedy)
        found[start:end] = chosen & bases[0][start:end] if bases else chosen
    return found


def size_of(extractor: Extractor) -> int:
    """Return the number of syntax nodes: All, Is 1; Geo 2; Attach 3; set operators 1 and both operands."""
    match extractor:
        case Leaf():
            return extractor.size
        case Union(left, right) | Intersect(left, right) | Diff(left, right):
            return 1 + size_of(left) + size_of(right)
        case _:
            assert_never(extractor)


def leaves_of(extractor: Extractor) -> Iterator[Leaf]:
    """Yield the leaves between the set operators, from left to right."""
    match extractor:
        case Leaf():
            yield extractor
        case Union(left, right) | Intersect(left, right) | Diff(left, right):
            yield from leaves_of(left)
            yield from leaves_of(right)
        case _:
            assert_never(extractor)


def labels_of(extractor: Extractor) -> tuple[str, ...]:
    """Return the labels an extractor asks for, each once, in order of mention."""
    return tuple(dict.fromkeys(label for leaf in leaves_of(extractor) for label in leaf.labels))


def rename_in_extractor(node: Extractor, old: str, new: str) -> Extractor:
    """Return an extractor that asks for the label `new` wherever it asked for `old`."""
    match node:
        case Leaf():
            return node.rename(old, new)
        case Union(left, right) | Intersect(left, right) | Diff(left, right):
            return type(node)(rename_in_extractor(left, old, new), rename_in_extractor(right, old, new))
        case _:
            assert_never(node)
