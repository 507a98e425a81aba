from __future__ import annotations

import pytest

from meshforge.project import NextStep
from meshforge.store.history import HistoryState
from meshforge.studio.edits.assets import LabelHulls
from meshforge.studio.label_changes import EarlyLabels
from meshforge.studio.pages import PageHub, PageState
from meshforge.studio.wire.family import Card, OrientView, ProjectView, VocabularyLabel

WORDS = tuple(VocabularyLabel(name=name, text=name, color="#000000") for name in ("leg", "panel"))
NO_HISTORY = HistoryState(None, None, 0, 0)
PROJECT = ProjectView(name="p", folder="/p", vocabulary=WORDS, next=NextStep("label", "Label."), orient=OrientView())
NAMES = {"a": ("one", "two"), "b": ("one",)}
CARDS = (
    Card(asset="a", hulls=2, labels=(0, 0), unsure=(0, 1)),
    Card(asset="b", hulls=1, labels=(-1,)),
    Card(asset="c"),  # not read yet
)


def pages() -> PageState:
    shown = PageState(PageHub(), PROJECT, NO_HISTORY, "1")
    shown.set_assets([card.asset for card in CARDS])
    shown.set_cards(CARDS)
    return shown


def group(label: str | None) -> LabelHulls:
    """Labels of hulls of all assets, one that is not there."""
    return LabelHulls(label=label, hulls={"a": ("two",), "b": ("one", "three"), "c": ("one",)})


def test_labels_are_on_the_cards_before_they_are_written() -> None:
    shown = pages()
    with EarlyLabels(shown, lambda: NAMES).show(group("panel")):
        within = shown.cards
    assert [card.labels for card in within] == [(0, 1), (1,), ()]
    assert within[0].unsure == (0,) and shown.cards == within


def test_a_label_is_taken_away() -> None:
    shown = pages()
    with EarlyLabels(shown, lambda: NAMES).show(group(None)):
        assert [card.labels for card in shown.cards] == [(0, -1), (-1,), ()]


def test_an_edit_that_is_refused_leaves_the_cards_as_they_were() -> None:
    shown = pages()
    with pytest.raises(OSError), EarlyLabels(shown, lambda: NAMES).show(group("panel")):
        raise OSError
    assert shown.cards == CARDS


def test_a_label_outside_of_the_vocabulary_is_not_shown() -> None:
    shown = pages()
    with EarlyLabels(shown, lambda: NAMES).show(group("door")):
        assert [card.labels for card in shown.cards] == [(0, 0), (-1,), ()]
