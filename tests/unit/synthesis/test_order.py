"""The order among extractors that select the same."""

import pytest
from hypothesis import given

from meshforge.language import All, Attach, Diff, Extractor, Geo, Intersect, Is, Union, size_of
from meshforge.synthesis.search.terms import order_key
from tests.examples import examples
from tests.strategies import VOCABULARY, extractors

LABELS = {label: place for place, label in enumerate(VOCABULARY)}
LEG, PANEL, DRAWER = Is("leg"), Is("panel"), Is("drawer")

EARLIER: list[tuple[Extractor, Extractor]] = [
    (Geo(All(), "-Z"), Attach(LEG, PANEL)),
    (LEG, All()),
    (PANEL, LEG),
    (Geo(LEG, "-X"), Geo(All(), "-Z")),
    (Geo(LEG, "-Z"), Geo(LEG, "-X")),
    (Attach(LEG, PANEL), Attach(LEG, All())),
    (Attach(LEG, PANEL), Attach(LEG, LEG)),
    (Attach(LEG, DRAWER), Diff(All(), PANEL)),
    (Union(LEG, PANEL), Diff(All(), DRAWER)),
    (Union(LEG, PANEL), Attach(All(), DRAWER)),
    (Diff(All(), DRAWER), Attach(All(), DRAWER)),
    (Diff(LEG, Geo(LEG, "+Z")), Intersect(LEG, Geo(All(), "-Z"))),
    (Diff(LEG, Attach(LEG, PANEL)), Intersect(Geo(LEG, "-X"), Geo(LEG, "-Z"))),
    (Union(PANEL, LEG), Intersect(PANEL, LEG)),
    (Intersect(PANEL, LEG), Diff(PANEL, LEG)),
]


@pytest.mark.parametrize(("earlier", "later"), EARLIER, ids=str)
def test_the_more_believable_comes_first(earlier: Extractor, later: Extractor) -> None:
    assert order_key(earlier, LABELS) < order_key(later, LABELS)


def test_operands_of_union_and_intersect_may_change_places_and_those_of_diff_may_not() -> None:
    for joint in (Union, Intersect):
        assert order_key(joint(LEG, PANEL), LABELS) == order_key(joint(PANEL, LEG), LABELS)
    assert order_key(Diff(LEG, PANEL), LABELS) != order_key(Diff(PANEL, LEG), LABELS)


@given(extractors())
def test_smaller_comes_first(extractor: Extractor) -> None:
    assert order_key(extractor, LABELS)[0] == size_of(extractor)


@examples(200)
@given(extractors(max_leaves=2), extractors(max_leaves=2), extractors(max_leaves=2))
def test_an_earlier_part_makes_the_whole_earlier(one: Extractor, other: Extractor, third: Extractor) -> None:
    one, other = sorted((one, other), key=lambda extractor: order_key(extractor, LABELS))
    strict = order_key(one, LABELS) < order_key(other, LABELS)
    for joint in (Union, Intersect, Diff):
        assert (order_key(joint(one, third), LABELS) < order_key(joint(other, third), LABELS)) == strict
        assert (order_key(joint(third, one), LABELS) < order_key(joint(third, other), LABELS)) == strict
