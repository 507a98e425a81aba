"""Labels on the cards of a family: shown as soon as a person gave them, while their files are still being written; and
what the history says of them: how many were given since all hulls were labelled."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager

from meshforge.project import GIVEN, NO_LABEL, PropagationState
from meshforge.store import History, HistoryEntry
from meshforge.studio.edits.base import Edit, LabelsByAsset
from meshforge.studio.pages import PageState
from meshforge.studio.wire import family as wire
from meshforge.symbolic import NO_PART

HullNames = Mapping[str, Sequence[str]]
"""The names of the hulls of each asset, in order."""


class LabelChanges:
    """Reads the history of labels."""

    def __init__(self, history: History) -> None:
        self._history = history
        self._no_change: tuple[tuple[HistoryEntry, ...], str | None] | None = None

    def note_no_change(self, entries: int, best: str | None) -> None:
        """Note a propagation that changed no label and so is no entry; entries: how many there were then."""
        self._no_change = self._history.entries[:entries], best

    def propagation_state(self, cards: Sequence[wire.Card]) -> PropagationState | None:
        """Return what is known of the last time that all hulls were labelled; None where it is undone or never was."""
        done = self._history.entries
        found = self._last_run(done)
        if found is None:
            return None
        used, best = found
        is_open = any(card.asset == best and any(sure != GIVEN for sure in card.confidence) for card in cards)
        edits = [entry.edit for entry in done[used:] if entry.edit.get("kind") == "label"]
        rows = ((asset, hulls, edit["label"]) for edit in edits for asset, hulls in edit["hulls"].items())
        given = {(asset, hull): label for asset, hulls, label in rows for hull in hulls}
        unused = sum(label is not None for label in given.values())
        return PropagationState(unused=unused, next=best if is_open else None)

    def _last_run(self, done: tuple[HistoryEntry, ...]) -> tuple[int, str | None] | None:
        """How many entries were done when all hulls were labelled last, and the asset that would help most then."""
        last = next((k for k in reversed(range(len(done))) if done[k].edit.get("kind") == "label-all"), None)
        edit = {} if last is None else done[last].edit
        found = None if last is None else (min(edit.get("used", last), last), edit.get("next"))
        if self._no_change is None:
            return found
        entries, best = self._no_change
        is_newer = found is None or len(entries) > found[0]
        return (len(entries), best) if is_newer and done[: len(entries)] == entries else found


class EarlyLabels:
    """Shows labels before they are written; refreshing the cards shows the rest of what they change.

    names: gives the names of the hulls of each asset that was read, in order.
    """

    def __init__(self, pages: PageState, names: Callable[[], HullNames]) -> None:
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

    def _put_on_cards(self, labels: LabelsByAsset) -> tuple[wire.Card, ...]:
        cards = {card.asset: card for card in self._pages.cards if card.asset in labels}
        places = {word.name: place for place, word in enumerate(self._pages.shown.project.vocabulary)}
        names = self._names()
        self._pages.set_cards(
            relabel_card(card, names.get(asset, ()), labels[asset], places) for asset, card in cards.items()
        )
        return tuple(cards.values())


def relabel_card(
    card: wire.Card, names: Sequence[str], labels: Mapping[str, str | None], places: Mapping[str, int]
) -> wire.Card:
    """Return a card with labels that a person gave; names: of its hulls, in order; places: of the labels in the
    vocabulary.

    Those that will be refused, of other hulls or outside of the vocabulary, are left out.
    """
    if len(names) != len(card.labels):
        return card
    at = {name: place for place, name in enumerate(names)}
    known = {**places, NO_PART: wire.NO_PART}
    wanted = {hull: label for hull, label in labels.items() if hull in at and (label is None or label in known)}
    new = {at[hull]: NO_LABEL if label is None else known[label] for hull, label in wanted.items()}
    sure = {place: NO_LABEL if label == NO_LABEL else GIVEN for place, label in new.items()}
    return card.model_copy(
        update={
            "labels": tuple(new.get(place, label) for place, label in enumerate(card.labels)),
            "confidence": tuple(sure.get(place, percent) for place, percent in enumerate(card.confidence)),
        }
    )
