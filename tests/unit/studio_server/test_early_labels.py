import pytest

from meshforge.project import GIVEN, NO_LABEL, NextStep
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
    Card(asset="a", hulls=2, labels=(0, 0), confidence=(30, 60)),
    Card(asset="b", hulls=1, labels=(-1,), confidence=(NO_LABEL,)),
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


@pytest.mark.parametrize(
    ("label", "labels", "confidence"),
    [
        ("panel", [(0, 1), (1,), ()], (30, GIVEN)),
        ("no part", [(0, -2), (-2,), ()], (30, GIVEN)),
        (None, [(0, -1), (-1,), ()], (30, NO_LABEL)),
        ("door", [(0, 0), (-1,), ()], (30, 60)),  # outside of the vocabulary
    ],
)
def test_labels_are_on_the_cards_before_they_are_written(
    label: str | None, labels: list[tuple[int, ...]], confidence: tuple[int, ...]
) -> None:
    shown = pages()
    with EarlyLabels(shown, lambda: NAMES).show(group(label)):
        within = shown.cards
    assert [card.labels for card in within] == labels
    assert within[0].confidence == confidence and shown.cards == within


def test_an_edit_that_is_refused_leaves_the_cards_as_they_were() -> None:
    shown = pages()
    with pytest.raises(OSError), EarlyLabels(shown, lambda: NAMES).show(group("panel")):
        raise OSError
    assert shown.cards == CARDS
