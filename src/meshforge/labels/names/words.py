"""The words in names: split apart, compared with other words, and the label that they stand for together."""

from collections.abc import Collection, Container, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from functools import cache, lru_cache
from importlib.resources import files
from itertools import pairwise
from typing import Literal

Words = tuple[str, ...]

_LEAST_PART = 3  # letters of a word that is joined with others

EXACT = 0.7
"""How sure a label is whose word is in a name: names are given by people, though not for this."""
_VOWELLESS, _SYNONYM, _GUESS = 0.6, 0.5, 0.45
WordKind = Literal["word", "synonym", "likeness"]
_KINDS: dict[float, WordKind] = {EXACT: "word", _SYNONYM: "synonym"}
_VOWELS = frozenset("aeiou")
_LEAST_LETTERS = 3  # letters of a shortened word, and of a label that may be shortened one more
_LIKE = 0.8  # share of letters that a misspelt word has in common with the one that is meant, as difflib counts them


def words_of(name: str) -> Words:
    """Return the words in a name, in lower case: `leftDoor_2` and `left-door` have two, `URDFLink` too."""
    spaced = "".join(
        f" {here}" if here.isupper() and (not before.isupper() or after.islower()) else here if here.isalpha() else " "
        for before, here, after in zip(f" {name}", name, f"{name[1:]} ", strict=False)
    )
    return tuple(spaced.casefold().split())


def forms(word: str) -> set[str]:
    """Return what a word may be in the singular: `shelves` is one shelf, or one shelve."""
    found = {word, word.removesuffix("s"), word.removesuffix("es")}
    if word.endswith("ves"):
        found |= {f"{word[:-3]}f", f"{word[:-3]}fe"}
    if word.endswith("ies"):
        found.add(f"{word[:-3]}y")
    return found - {""}


def is_one_of(word: str, words: Container[str]) -> bool:
    """Return whether a word is one of some, be it in the plural."""
    return any(form in words for form in forms(word))


def is_same(one: str, other: str) -> bool:
    """Return whether two words are the same, be it in the plural."""
    return not forms(one).isdisjoint(forms(other))


def common() -> frozenset[str]:
    """Return words that are often in names of things and mean just what they say."""
    return _read_words("common.txt")


@cache
def fillers() -> frozenset[str]:
    """Return words that say nothing of what a thing is, or only which one."""
    return _read_words("fillers.txt") | places()


@cache
def dictionary() -> frozenset[str]:
    """Return all these words."""
    return common() | fillers()


def places() -> frozenset[str]:
    """Return words that tell which one as often as what: `drawer_top` is a drawer, `table_top` a top."""
    return _read_words("places.txt")


@cache
def synonyms() -> dict[str, frozenset[str]]:
    """Return the other words that files use for a part, by its word: a `handle` may be called a knob."""
    lines = (line.split() for line in _read_file("synonyms.txt").splitlines())
    return {word: frozenset(others) for word, *others in lines}


def _read_words(file: str) -> frozenset[str]:
    return frozenset(_read_file(file).split())


@cache
def _read_file(name: str) -> str:
    return files("meshforge.labels.names").joinpath(name).read_text(encoding="utf-8")


def split_joined_word(word: str, more: Collection[str]) -> Words:
    """Return a word that is several words joined, `kettlehandle`, as these, the fewest; any other as it is.

    more: words besides the known ones. Parts have three letters at least.
    """
    best: list[Words | None] = [()]
    for end in range(1, len(word) + 1):
        ways = [
            (*before, word[start:end])
            for start, before in enumerate(best)
            if before is not None
            and end - start >= _LEAST_PART
            and any(form in dictionary() or form in more for form in forms(word[start:end]))
        ]
        best.append(min(ways, key=len, default=None))
    return best[-1] or (word,)


def word_similarity(word: str, meant: str) -> float:
    """Return how surely one word stands for another, 0 where it does not. Common words stand for themselves alone."""
    if is_same(word, meant):
        return EXACT
    if is_synonym(word, meant):
        return _SYNONYM
    if (
        is_one_of(word, dictionary())
        or len(word) < _LEAST_LETTERS
        or len(meant) <= _LEAST_LETTERS
        or word[0] != meant[0]
    ):
        return 0.0
    if word == _consonants_of(meant):
        return _VOWELLESS
    is_near = len(word) > _LEAST_LETTERS and SequenceMatcher(None, word, meant, False).ratio() > _LIKE
    return _GUESS if is_near else 0.0


def is_synonym(word: str, meant: str) -> bool:
    """Return whether a word is another one for a part; words that tell which one as often as what are none."""
    return not is_one_of(word, fillers()) and any(is_one_of(word, synonyms().get(form, ())) for form in forms(meant))


def _consonants_of(word: str) -> str:
    """A word without its vowels, and without the second of two letters that are the same: `bottle` is `btl`."""
    kept = [letter for letter in word if letter not in _VOWELS]
    return "".join(letter for before, letter in pairwise(["", *kept]) if letter != before)


UNSURE = 0.45
"""How sure a label is at most where a name may mean another thing, or a place."""
_LESS = 0.1  # for a label that is not alone in its name
_PREPOSITIONS = frozenset(("of", "for", "on", "in"))
_DIGITS = 2


@dataclass(frozen=True, slots=True)
class LabelInName:
    """A label, how sure it is, and whether its very words are in the name, other words for it, or nearly these."""

    label: str
    confidence: float
    how: WordKind


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
    """Return the label that a name says, None where it says none, or several as surely.

    The words of a label may be in the plural, shortened or misspelt, or joined with others: the last thing in a name
    is what it names, `drawer_handle` is a handle.
    """
    return _match_words(words_of(name), tuple(vocabulary))


@lru_cache(maxsize=1 << 14)
def _match_words(spoken: Words, vocabulary: tuple[str, ...]) -> LabelInName | None:
    known = {label: words_of(label) for label in vocabulary}
    parts = {word for own in known.values() for word in own}
    others = {other for word in parts for form in forms(word) for other in synonyms().get(form, ())} - fillers()
    words = tuple(part for word in _put_thing_last(spoken) for part in _split_word(word, parts, parts | others))
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
    how = _KINDS.get(chosen.sure, "likeness")
    return LabelInName(chosen.label, round(min(sure, UNSURE) if is_open else sure, _DIGITS), how)


def _put_thing_last(words: Words) -> Words:
    """The words of a name with the thing at the end, also of a `handle_of_drawer`."""
    turn = next((k for k, word in enumerate(words) if word in _PREPOSITIONS and k), None)
    return words if turn is None else (*words[turn + 1 :], *words[:turn])


def _split_word(word: str, own: Collection[str], known: Collection[str]) -> Words:
    """A word of a name, taken apart if it is joined and the thing that it ends with is of a label, or a synonym of one.

    own: the words of labels, of which none is taken apart; known: these and their synonyms.
    """
    if is_one_of(word, own):
        return (word,)
    parts = split_joined_word(word, own)
    things = [part for part in parts if part not in fillers() or part in own]
    if not things or not is_one_of(things[-1], known):
        return (word,)
    return tuple(part for part in parts if is_one_of(part, known))


def _find_mentions(words: Words, label: str, wanted: Words) -> list[_Mention]:
    runs = [(start, start + count) for count in {1, 2, len(wanted)} for start in range(len(words) - count + 1)]
    sure = [(start, end, _confidence(words[start:end], wanted)) for start, end in runs if end > start]
    return [_Mention(label, start, end, value) for start, end, value in sure if value]


def _confidence(run: Words, wanted: Words) -> float:
    if is_same("".join(run), "".join(wanted)):
        return EXACT
    return min(map(word_similarity, run, wanted)) if len(run) == len(wanted) else 0.0


def _outdoes(one: _Mention, other: _Mention) -> bool:
    """Whether a mention makes another one void: it is of the same words and more, or of the same more surely."""
    return one.start <= other.start and other.end <= one.end and one.weight > other.weight


def _are_all(words: Words, kind: Container[str]) -> bool:
    return all(is_one_of(word, kind) for word in words)
