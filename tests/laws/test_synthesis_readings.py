"""The readings are every way in which a consistent extractor of so many nodes selects on the batch."""

from collections.abc import Sequence

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from meshforge.language import Extractor, select_mask, size_of
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.candidates.rank import ConsistentTerms, RankedCandidates, enumerate_consistent
from meshforge.synthesis.demonstration import Example
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.search.smallest import Hit, Search
from tests.examples import examples
from tests.strategies import extractors, grid_boxes, meshes
from tests.synthesis_naive import naive_behaviours

LABELS = ("a", "b", "c")
TWO = LABELS[:2]
OTHERWISE = {"stored": Options(stored=1), "few": Options(few=2), "all at once": Options(few=0)}
batches = st.lists(meshes(grid_boxes(), vocabulary=LABELS), min_size=2, max_size=4)
shown_on = st.integers(1, 2)

Behaviour = tuple[int, ...]


def searched(
    batch: Sequence[SymbolicMesh], shown: int, hidden: Extractor, labels: Sequence[str], options: Options
) -> tuple[Search, Extractor]:
    """A finished search with the first meshes demonstrated, and its answer."""
    examples = [Example(f"mesh {k}", mesh, select_mask(hidden, mesh)) for k, mesh in enumerate(batch[:shown])]
    assume(any(example.selection for example in examples))
    search = Search(examples, labels, TimeBudget(600), options, batch=batch[shown:])
    answer = search.run()
    assert isinstance(answer, Hit)
    return search, answer.extractor


def behaviours(search: Search, found: ConsistentTerms) -> dict[Behaviour, int]:
    """What each reading selects on every mesh, with its size."""
    count = range(len(search.field.meshes))
    return {tuple(search.field.on(term.bits, k) for k in count): term.size for term in found.terms}


@examples(60)
@given(batches, shown_on, extractors(TWO, max_leaves=2))
def test_no_reading_is_missing_and_none_is_too_much(batch: list[SymbolicMesh], shown: int, hidden: Extractor) -> None:
    search, answer = searched(batch, shown, hidden, TWO, Options())
    above = max(0, min(3, 6 - size_of(answer)))
    found = enumerate_consistent(search, answer, above)
    assert found.complete
    naive = naive_behaviours(batch, search.selections, TWO, size_of(answer) + above)
    assert behaviours(search, found) == naive


@examples(60)
@given(batches, shown_on, extractors(LABELS, max_leaves=3))
def test_readings_select_what_was_shown_and_say(batch: list[SymbolicMesh], shown: int, hidden: Extractor) -> None:
    search, answer = searched(batch, shown, hidden, LABELS, Options())
    weighed = RankedCandidates(search, enumerate_consistent(search, answer, 2))
    seen = set()
    for term in weighed.terms:
        chosen = tuple(select_mask(term.extractor, mesh) for mesh in batch)
        assert chosen[:shown] == search.selections
        assert chosen == tuple(search.field.on(term.bits, k) for k in range(len(batch)))
        assert size_of(term.extractor) == term.size
        seen.add(chosen)
    assert len(seen) == len(weighed.terms)
    assert sum(weighed.beliefs) == pytest.approx(1.0)


@pytest.mark.parametrize("switched", OTHERWISE)
@examples(25)
@given(batch=batches, shown=shown_on, hidden=extractors(TWO, max_leaves=2))
def test_the_readings_do_not_depend_on_what_is_kept_and_what_the_search_begins_with(
    switched: str, batch: list[SymbolicMesh], shown: int, hidden: Extractor
) -> None:
    search, answer = searched(batch, shown, hidden, TWO, Options())
    above = max(0, min(3, 6 - size_of(answer)))
    other, again = searched(batch, shown, hidden, TWO, OTHERWISE[switched])
    assert again == answer
    assert behaviours(other, enumerate_consistent(other, again, above)) == behaviours(
        search, enumerate_consistent(search, answer, above)
    )


@examples(40)
@given(batches, shown_on, extractors(LABELS, max_leaves=3))
def test_without_a_batch_the_smallest_is_taken(batch: list[SymbolicMesh], shown: int, hidden: Extractor) -> None:
    search, answer = searched(batch[:shown], shown, hidden, LABELS, Options())
    weighed = RankedCandidates(search, enumerate_consistent(search, answer, 2))
    assert weighed.extractor == answer
    assert weighed.unambiguous


@examples(40)
@given(batches, extractors(LABELS, max_leaves=4), st.integers(0, 40))
def test_effort_that_is_cut_short_leaves_whole_sizes(batch: list[SymbolicMesh], hidden: Extractor, effort: int) -> None:
    search, answer = searched(batch, 1, hidden, LABELS, Options(effort=effort))
    found = enumerate_consistent(search, answer, 3)
    whole, _ = searched(batch, 1, hidden, LABELS, Options())
    below = {b: n for b, n in behaviours(whole, enumerate_consistent(whole, answer, 3)).items() if n <= found.size}
    assert below.items() <= behaviours(search, found).items()
    assert found.complete or found.size < size_of(answer) + 3
