"""Labels on the cards of a family: shown as soon as a person gave them, while their files are still being written; and
what the history says of them: what the last edit of all labels changed, and how many were given since."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import get_args

from meshforge.common import MeshForgeError
from meshforge.project import GIVEN, NO_LABEL, PropagationState
from meshforge.store import History, HistoryEntry, Layout
from meshforge.studio.edits.base import Edit, LabelsByAsset
from meshforge.studio.pages import PageState
from meshforge.studio.wire import family as wire
from meshforge.studio.wire.jobs import AssetLabelUpdate, LabelEditKind, LabelUpdate
from meshforge.symbolic import NO_PART, Label, read_labels

_LABEL_EDIT_KINDS: tuple[str, ...] = get_args(LabelEditKind)
HullNames = Mapping[str, Sequence[str]]
"""The names of the hulls of each asset, in order."""


class LabelChanges:
    """Reads the history of labels; the result for the last entry is cached."""

    def __init__(self, history: History) -> None:
        self._history = history
        self._last: tuple[HistoryEntry, int, LabelUpdate] | None = None
        self._no_change: tuple[tuple[HistoryEntry, ...], str | None] | None = None

    def last_change(self, names: HullNames) -> LabelUpdate | None:
        """Return what the last edit did to assets whose hulls are known by now; None where it did not edit all
        labels."""
        done = self._history.entries
        if not done or done[-1].edit.get("kind") not in _LABEL_EDIT_KINDS:
            return None
        entry = done[-1]
        if self._last is None or self._last[0] is not entry or self._last[1] != len(names):
            self._last = entry, len(names), self._build_change(entry, names)
        return self._last[2]

    def note_no_change(self, entries: int, best: str | None) -> None:
        """Note a propagation that changed no label and so is no entry; entries: how many there were then."""
        self._no_change = self._history.entries[:entries], best

    def propagation_state(self, cards: Sequence[wire.Card]) -> PropagationState | None:
        """Return what is known of the last time that all hulls were labelled; None where there was none, or where it is
        undone."""
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

    def _build_change(self, entry: HistoryEntry, names: HullNames) -> LabelUpdate:
        found = (
            diff_labels(a, names[a], self._read_state(entry.before[name]), self._read_state(entry.after[name]))
            for a, name in _labels_files(entry.names).items()
            if a in names
        )
        return LabelUpdate(way=entry.edit["kind"], assets=tuple(filter(None, found)))

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

    def _read_state(self, digest: str | None) -> Mapping[str, Label]:
        """What a labels file held; empty where there was none, or where the history was damaged."""
        try:
            return read_labels(self._history.path_of(digest)).labels if digest else {}
        except MeshForgeError:
            return {}


def _labels_files(names: Iterable[str]) -> dict[str, str]:
    """The labels files among some files, by asset; names: paths from the project's folder."""
    return {asset: name for name in names if (asset := Layout.labels.match(name)) is not None}


def diff_labels(
    asset: str, names: Sequence[str], before: Mapping[str, Label], after: Mapping[str, Label]
) -> AssetLabelUpdate | None:
    """Return which hulls got another label, None where none did; names: of all hulls, in order."""
    pairs = [(k, before.get(name), after.get(name)) for k, name in enumerate(names)]
    new = tuple(k for k, was, now in pairs if now and not was)
    changed = {k: was.name for k, was, now in pairs if was and now and was.name != now.name}
    if not new and not changed:
        return None
    return AssetLabelUpdate(asset=asset, new=new, changed=tuple(changed), was=tuple(changed.values()))


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
