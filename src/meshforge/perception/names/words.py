"""The words in names: taken apart, told from words that mean nothing, and joined ones parted again."""

from __future__ import annotations

from collections.abc import Collection, Container
from functools import cache
from importlib.resources import files

Words = tuple[str, ...]

_LEAST = 3  # letters of a word that is joined with others


def words_of(name: str) -> Words:
    """The words in a name, in lower case: `leftDoor_2` and `left-door` have two, `URDFLink` too."""
    spaced = "".join(
        f" {here}" if here.isupper() and (not before.isupper() or after.islower()) else here if here.isalpha() else " "
        for before, here, after in zip(f" {name}", name, f"{name[1:]} ", strict=False)
    )
    return tuple(spaced.casefold().split())


def forms(word: str) -> set[str]:
    """What a word may be in the singular: `shelves` is one shelf, or one shelve."""
    found = {word, word.removesuffix("s"), word.removesuffix("es")}
    if word.endswith("ves"):
        found |= {f"{word[:-3]}f", f"{word[:-3]}fe"}
    if word.endswith("ies"):
        found.add(f"{word[:-3]}y")
    return found - {""}


def is_one_of(word: str, words: Container[str]) -> bool:
    """Whether a word is one of some, be it in the plural."""
    return any(form in words for form in forms(word))


def is_same(one: str, other: str) -> bool:
    """Whether two words are the same, be it in the plural."""
    return not forms(one).isdisjoint(forms(other))


def common() -> frozenset[str]:
    """Words that are often in names of things and mean just what they say."""
    return _listed("common.txt")


@cache
def fillers() -> frozenset[str]:
    """Words that say nothing of what a thing is, or only which one."""
    return _listed("fillers.txt") | places()


@cache
def known() -> frozenset[str]:
    """All these words."""
    return common() | fillers()


def places() -> frozenset[str]:
    """Words that tell which one as often as what: `drawer_top` is a drawer, `table_top` a top."""
    return _listed("places.txt")


@cache
def _listed(file: str) -> frozenset[str]:
    text = files("meshforge.perception.names").joinpath(file).read_text(encoding="utf-8")
    return frozenset(text.split())


def parted(word: str, more: Collection[str]) -> Words:
    """A word that is several words joined, `kettlehandle`, as these, the fewest; any other as it is.

    more: words besides the known ones. Parts have three letters at least.
    """
    best: list[Words | None] = [()]
    for end in range(1, len(word) + 1):
        ways = [
            (*before, word[start:end])
            for start, before in enumerate(best)
            if before is not None and end - start >= _LEAST and _is_part(word[start:end], more)
        ]
        best.append(min(ways, key=len, default=None))
    return best[-1] or (word,)


def _is_part(word: str, more: Collection[str]) -> bool:
    return any(form in known() or form in more for form in forms(word))
