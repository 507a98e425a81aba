"""How surely a word stands for another one: the same, shortened, or misspelt."""

from __future__ import annotations

from itertools import pairwise

from meshforge.perception.names.words import is_one_of, is_same, known

EXACT = 0.7
"""How sure a label is whose word is in a name: names are given by people, though not for this."""
_VOWELLESS, _SLIP, _GUESS = 0.6, 0.55, 0.45
_VOWELS = frozenset("aeiou")
_LEAST = 3  # letters of a shortened word, and of a label that may be shortened one more
_LONG = 6  # letters of a word in which any one letter may be wrong; in shorter ones that makes other words


def likeness(word: str, meant: str) -> float:
    """How surely one word stands for another, 0 where it does not. Common words stand for themselves alone."""
    if is_same(word, meant):
        return EXACT
    if is_one_of(word, known()) or len(word) < _LEAST or len(meant) <= _LEAST or word[0] != meant[0]:
        return 0.0
    if word == _consonants(meant):
        return _VOWELLESS
    if _is_slip(word, meant):
        return _SLIP
    return _GUESS if _is_short_for(word, meant) or _is_misspelt(word, meant) else 0.0


def _consonants(word: str) -> str:
    """A word without its vowels, and without the second of two letters that are the same: `bottle` is `btl`."""
    kept = [letter for letter in word if letter not in _VOWELS]
    return "".join(letter for before, letter in pairwise(["", *kept]) if letter != before)


def _is_slip(word: str, meant: str) -> bool:
    """Whether two letters that follow each other are exchanged, or one is doubled or should be."""
    if len(meant) <= _LEAST + 1:
        return False
    swapped = (meant[:k] + meant[k + 1] + meant[k] + meant[k + 2 :] for k in range(1, len(meant) - 1))
    return word in swapped or _undoubled(word) == _undoubled(meant)


def _undoubled(word: str) -> str:
    return "".join(letter for before, letter in pairwise(["", *word]) if letter != before)


def _is_short_for(word: str, meant: str) -> bool:
    """Whether a word is the beginning of another, four letters at least, or most of its consonants in order."""
    if meant.startswith(word):
        return len(word) > _LEAST and 2 * len(word) >= len(meant)
    letters = iter(_consonants(meant))
    consonants = _VOWELS.isdisjoint(word) and all(letter in letters for letter in word)
    return consonants and 5 * len(word) >= 3 * len(_consonants(meant))


def _is_misspelt(word: str, meant: str) -> bool:
    """Whether one letter is wrong, missing or too many."""
    if len(meant) < _LONG or abs(len(word) - len(meant)) > 1:
        return False
    same = next((k for k, (a, b) in enumerate(zip(word, meant, strict=False)) if a != b), min(len(word), len(meant)))
    return any(word[same + i :] == meant[same + j :] for i, j in ((1, 1), (0, 1), (1, 0)))
