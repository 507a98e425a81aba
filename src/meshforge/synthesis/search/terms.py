"""Extractors as the search sees them: leaves, terms with what they select, and the order in which the search
answers.

The order says which of two extractors that select the same a person would rather believe. It is total, but for
the operands of `Union` and `Intersect` changing places. Putting an earlier part in place of a part makes the
whole earlier, so the earliest extractor is made of earliest parts, and of all parts that select the same the
search may forget all but the first.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, TypeVar, assert_never

from meshforge import language
from meshforge.common import blame
from meshforge.language import BaseExtractor, Diff, Leaf, Union
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.options import Layers

L = TypeVar("L", bound=Leaf)

Key = tuple[Any, ...]
"""Sorts extractors; entry 0 is the size, entry 1 the doubts."""

SetOperator = type[Union] | type[language.Intersect] | type[Diff]

_LEAF_RANK = {kind: rank for rank, kind in enumerate(language.EXTRACTORS.built_in.values())}
_PLUGIN_RANK = len(_LEAF_RANK)
OPERATOR_RANK: Mapping[SetOperator, int] = {
    kind: _PLUGIN_RANK + place for place, kind in enumerate(language.SET_OPERATORS, 1)
}
"""Of equal size and doubts: labels, then contact, then position, then leaves of plug-ins, then what adds, and last what
takes away."""


@lru_cache(maxsize=64)
def enumerate_leaves(vocabulary: tuple[str, ...], layers: Layers = "S+T+G") -> tuple[Leaf, ...]:
    """Return every built-in leaf over the labels of a vocabulary, bases first, labels before `All`."""
    return _enumerate(language.EXTRACTORS.built_in.values(), vocabulary, layers)


def enumerate_more_leaves(
    names: Sequence[str], vocabulary: Sequence[str], layers: Layers, meshes: Iterable[SymbolicMesh]
) -> tuple[Leaf, ...]:
    """Return the leaves that plug-ins of these names add to the built-in ones; meshes: of the family, as they come in.

    Raises PluginError where one cannot be loaded or fails, UsageError where there is none of the name.
    """
    if not names:
        return ()
    known = enumerate_leaves(tuple(vocabulary), layers)
    kinds = dict.fromkeys([*language.EXTRACTORS.built_in.values(), *map(language.EXTRACTORS.require, names)])
    every = _enumerate(kinds, tuple(vocabulary), layers, tuple(meshes))
    return tuple(leaf for leaf in dict.fromkeys(every) if leaf not in known)


def _enumerate(
    kinds: Iterable[type[Leaf]], labels: tuple[str, ...], layers: Layers, meshes: tuple[SymbolicMesh, ...] = ()
) -> tuple[Leaf, ...]:
    some = [kind for kind in kinds if kind.layer in layers]
    bases = [leaf for kind in some if issubclass(kind, BaseExtractor) for leaf in _list(kind, labels, (), meshes)]
    bases.sort(key=lambda base: base.uncertainty)
    others = [kind for kind in some if not issubclass(kind, BaseExtractor)]
    return (*bases, *(leaf for kind in others for leaf in _list(kind, labels, tuple(bases), meshes)))


def _list(
    kind: type[L], labels: tuple[str, ...], bases: tuple[BaseExtractor, ...], meshes: tuple[SymbolicMesh, ...]
) -> list[L]:
    with blame(kind.owner):
        found = list(kind.enumerate(language.Candidates(labels, bases, meshes)))
        strange = next((leaf for leaf in found if not isinstance(leaf, kind)), None)
    if kind.owner and strange is not None:
        raise kind.owner.error(f"enumerates {strange!r}, which is no {kind.__name__}")
    return found


def leaf_key(leaf: Leaf, labels: Mapping[str, int]) -> Key:
    """Return the key of an extractor without set operators; labels: the place of each label in the vocabulary.

    Doubts count what fits by accident more easily than labels, and contact between two labels, do: `All`; a
    direction, since there are six to try; an `Attach` that is not between two labels, since it says how parts
    were cut rather than what they are.
    """
    kind = type(leaf)
    rank = (_LEAF_RANK[kind],) if kind in _LEAF_RANK else (_PLUGIN_RANK, kind.__name__)
    return (leaf.size, leaf.uncertainty, *rank, *_argument_keys(leaf, labels))


def _argument_keys(leaf: Leaf, labels: Mapping[str, int]) -> Iterator[Any]:
    for name, argument in leaf.arguments().items():
        value = getattr(leaf, name)
        if isinstance(value, BaseExtractor):
            yield leaf_key(value, labels)
        elif value is None:
            yield ()
        else:
            yield (argument.sort_key(value, labels),)


def operator_key(operator: SetOperator, left: Key, right: Key) -> Key:
    """Return the key of a set operator over two extractors; the operands of `Union` and `Intersect` count in order."""
    if operator is not Diff and right < left:
        left, right = right, left
    return (1 + left[0] + right[0], left[1] + right[1], OPERATOR_RANK[operator], left, right)


def order_key(extractor: language.Extractor, labels: Mapping[str, int]) -> Key:
    """Return the key of any extractor: what sorts first is smaller, or as small and more believable."""
    match extractor:
        case Union(left, right) | language.Intersect(left, right) | Diff(left, right):
            return operator_key(type(extractor), order_key(left, labels), order_key(right, labels))
        case Leaf():
            return leaf_key(extractor, labels)
        case _:
            assert_never(extractor)


@dataclass(frozen=True, slots=True, eq=False)
class Compound:
    """A set operator over two terms."""

    operator: SetOperator
    left: "Term"
    right: "Term"


@dataclass(frozen=True, slots=True, eq=False)
class Term:
    """An extractor, its place in the order, and its selection as a bit set over the search's groups of hulls.

    form: the extractor itself, or the operands it is put together from: most terms are never written out.
    """

    bits: int
    key: Key
    form: Leaf | Compound

    @property
    def extractor(self) -> language.Extractor:
        """The term written out."""
        made = self.form
        return made.operator(made.left.extractor, made.right.extractor) if isinstance(made, Compound) else made

    @property
    def size(self) -> int:
        """Its syntax nodes."""
        size: int = self.key[0]
        return size


def combine(operator: SetOperator, left: Term, right: Term) -> Term:
    """Return a set operator over two terms; the operands of `Union` and `Intersect` are put in order."""
    if operator is not Diff and right.key < left.key:
        left, right = right, left
    if operator is Union:
        bits = left.bits | right.bits
    else:
        bits = left.bits & ~right.bits if operator is Diff else left.bits & right.bits
    return Term(bits, operator_key(operator, left.key, right.key), Compound(operator, left, right))


def first_term(terms: list[Term]) -> Term | None:
    """Return the first of the terms in the order."""
    return min(terms, key=lambda term: term.key, default=None)
