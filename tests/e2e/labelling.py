"""How a person labels a whole family at once: its assets side by side, look-alikes of one hull taken on all of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from tests.e2e.hand import Hand


def label_look_alikes(person: Hand, truth: Mapping[str, Mapping[str, str]], words: Sequence[str]) -> None:
    """Label every hull of up to eight assets. truth: by asset and name; words: the labels by their digits."""
    meant = {f"{hull} · {asset}": word for asset, own in truth.items() for hull, word in own.items()}
    done = set[str]()
    person.press("w")
    person.page.wait_for_function(
        "count => document.querySelector('[data-testid=counts]')?.textContent.startsWith(`${count}`)", arg=len(meant)
    )
    for digit, word in enumerate(words, 1):
        while left := [name for name, its in meant.items() if its == word and name not in done]:
            person.hull(next(name for name in left if visible(person, name)))
            person.press("Shift+J")
            taken = until_found(person)
            for wrong in [name for name in taken if meant[name] != word]:
                person.hull(wrong, "Control")
            person.press(str(digit))
            done |= {name for name in taken if meant[name] == word}


def visible(person: Hand, hull: str) -> bool:
    """Whether something of a hull is seen in the view."""
    return person.page.evaluate("name => window.meshforgeViewport.project(name)", hull) is not None


def until_found(person: Hand) -> list[str]:
    """The hulls that are outlined once look-alikes were found."""
    person.page.wait_for_function("() => window.meshforgeViewport.selected().length > 1")
    found: list[str] = person.page.evaluate("window.meshforgeViewport.selected()")
    return found
