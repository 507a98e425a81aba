"""Labels on the cards of a family as soon as a person gave them, while their files are still being written."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager

from meshforge.studio.edits.base import Edit, LabelsByAsset
from meshforge.studio.pages import PageState
from meshforge.studio.wire.family import Card


class EarlyLabels:
    """Shows labels before they are written; refreshing the cards shows the rest of what they change.

    names: gives the names of the hulls of each asset that was read, in order.
    """

    def __init__(self, pages: PageState, names: Callable[[], Mapping[str, Sequence[str]]]) -> None:
        self._pages, self._names = pages, names

    @contextmanager
    def show(self, edit: Edit) -> Iterator[None]:
        """Show the labels of an edit that is made within the block; an error in it puts the cards back."""
        before = self._put_on_cards(edit.list_labels())
        try:
            yield
        except BaseException:
            self._pages.set_cards(before)
            raise

    def _put_on_cards(self, labels: LabelsByAsset) -> tuple[Card, ...]:
        """Show labels; gives the cards as they were."""
        cards = {card.asset: card for card in self._pages.cards if card.asset in labels}
        places = {word.name: place for place, word in enumerate(self._pages.vocabulary)}
        names = self._names()
        self._pages.set_cards(
            relabel_card(card, names.get(asset, ()), labels[asset], places) for asset, card in cards.items()
        )
        return tuple(cards.values())


def relabel_card(card: Card, names: Sequence[str], labels: Mapping[str, str | None], places: Mapping[str, int]) -> Card:
    """A card with labels that a person gave; names: of its hulls, in order; places: of the labels in the vocabulary.

    Those that will be refused, of other hulls or outside of the vocabulary, are left out.
    """
    if len(names) != len(card.labels):
        return card
    at = {name: place for place, name in enumerate(names)}
    new = {
        at[hull]: -1 if label is None else places[label]
        for hull, label in labels.items()
        if hull in at and (label is None or label in places)
    }
    return card.model_copy(
        update={
            "labels": tuple(new.get(place, label) for place, label in enumerate(card.labels)),
            "unsure": tuple(place for place in card.unsure if place not in new),
        }
    )
