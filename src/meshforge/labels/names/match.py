"""The label that one name stands for."""

from __future__ import annotations

from collections.abc import Collection, Container, Sequence
from dataclasses import dataclass
from functools import lru_cache

from meshforge.labels.names.words import (
    EXACT,
    Words,
    fillers,
    is_one_of,
    is_same,
    places,
    split_joined_word,
    word_similarity,
    words_of,
)

UNSURE = 0.45
"""How sure a label is at most where a name may mean another thing, or a place."""
_LESS = 0.1  # for a label that is not alone in its name
_PREPOSITIONS = frozenset(("of", "for", "on", "in"))
_DIGITS = 2


@dataclass(frozen=True, slots=True)
class LabelInName:
    """A label, how sure it is, and whether its very words are in the name."""

    label: str
    confidence: float
    exact: bool


@dataclass(frozen=True, slots=True)
class _Mention:
    """A label whose words are, surely or not, those from `start` to `end`."""

    label: str
    start: int
    end: int
    sure: float

    @property
    def weight(self) -> tuple[int, float]:
        return self.end - self.start, self.sure


def match_label(name: str, vocabulary: Sequence[str]) -> LabelInName | None:
    """The label that a name says, None where it says none, or several as surely.

    The words of a label may be in the plural, shortened or misspelt, or joined with others: the last thing in a name
    is what it names, `drawer_handle` is a handle.
    """
    return _match_words(words_of(name), tuple(vocabulary))


@lru_cache(maxsize=1 << 14)
def _match_words(spoken: Words, vocabulary: tuple[str, ...]) -> LabelInName | None:
    """The same of the words of a name, of which there are far fewer than names."""
    known = {label: words_of(label) for label in vocabulary}
    words = _split_joined_words(_put_thing_last(spoken), {word for own in known.values() for word in own})
    found = [mention for label, wanted in known.items() for mention in _find_mentions(words, label, wanted)]
    found = [one for one in found if not any(_outdoes(other, one) for other in found)]
    things = [one for one in found if not _are_all(known[one.label], fillers())] or found
    last = max((one.end for one in things), default=0)
    best = {one.label: one for one in things if one.end == last}
    if len(best) != 1:
        return None
    (chosen,) = best.values()
    at_places = {one.start for one in found if _are_all(known[one.label], places())}
    sure = chosen.sure - (_LESS if len({one.label for one in found}) > 1 else 0.0)
    before = words[: chosen.start] if chosen.start in at_places else ()
    is_open = any(start >= last for start in at_places) or not _are_all((*before, *words[last:]), fillers())
    return LabelInName(chosen.label, round(min(sure, UNSURE) if is_open else sure, _DIGITS), chosen.sure == EXACT)


def _put_thing_last(words: Words) -> Words:
    """The words of a name with the thing at the end, also of a `handle_of_drawer`."""
    turn = next((k for k, word in enumerate(words) if word in _PREPOSITIONS and k), None)
    return words if turn is None else (*words[turn + 1 :], *words[:turn])


def _split_joined_words(words: Words, known: Collection[str]) -> Words:
    """The words of a name, those that are joined taken apart where the thing that they end with is of a label."""
    return tuple(part for word in words for part in _split_word(word, known))


def _split_word(word: str, known: Collection[str]) -> Words:
    if is_one_of(word, known):
        return (word,)
    parts = split_joined_word(word, known)
    things = [part for part in parts if part not in fillers() or part in known]
    if not things or not is_one_of(things[-1], known):
        return (word,)
    return tuple(part for part in parts if is_one_of(part, known))


def _find_mentions(words: Words, label: str, wanted: Words) -> list[_Mention]:
    """Where the words of a label are in a name, one by one or joined."""
    runs = [(start, start + count) for count in {1, 2, len(wanted)} for start in range(len(words) - count + 1)]
    sure = [(start, end, _sureness(words[start:end], wanted)) for start, end in runs if end > start]
    return [_Mention(label, start, end, value) for start, end, value in sure if value]


def _sureness(run: Words, wanted: Words) -> float:
    """How surely a run of words stands for the words of a label."""
    if is_same("".join(run), "".join(wanted)):
        return EXACT
    return min(map(word_similarity, run, wanted)) if len(run) == len(wanted) else 0.0


def _outdoes(one: _Mention, other: _Mention) -> bool:
    """Whether a mention makes another one void: it is of the same words and more, or of the same more surely."""
    return one.start <= other.start and other.end <= one.end and one.weight > other.weight


def _are_all(words: Words, kind: Container[str]) -> bool:
    """Whether words are all of a kind, be it in the plural."""
    return all(is_one_of(word, kind) for word in words)
