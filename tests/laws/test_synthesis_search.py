"""The search gives the answer of a search that tries everything, whatever it keeps and begins with."""

from collections.abc import Sequence
from dataclasses import replace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from meshforge.language import Extractor, select_mask
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.demonstration import Example
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.search.smallest import Hit, Miss, Search
from meshforge.synthesis.search.terms import Key, order_key
from tests.examples import examples
from tests.strategies import extractors, grid_boxes, meshes
from tests.synthesis_naive import naive_search

LABELS = ("a", "b", "c")
TWO = LABELS[:2]
OPTIONS = {
    "as it ships": Options(),
    "only goals": Options(stored=0),
    "all hulls at once": Options(few=0),
    "few hulls": Options(few=2),
    "only goals, few hulls": Options(stored=0, few=2),
}
batches = st.lists(meshes(grid_boxes(), vocabulary=LABELS), min_size=1, max_size=3)


def examples_of(batch: Sequence[SymbolicMesh], extractor: Extractor) -> list[Example]:
    examples = [Example(f"mesh {k}", mesh, select_mask(extractor, mesh)) for k, mesh in enumerate(batch)]
    assume(any(example.selection for example in examples))
    return examples


def found(
    examples: Sequence[Example], max_size: int, options: Options | None = None, labels: Sequence[str] = TWO
) -> Extractor | None:
    answer = Search(examples, labels, TimeBudget(600), replace(options or Options(), max_size=max_size)).run()
    assert isinstance(answer, Hit | Miss)
    return answer.extractor if isinstance(answer, Hit) else None


def key(extractor: Extractor | None) -> Key | None:
    """The place in the order: the same for two extractors that differ by the order of operands only."""
    return order_key(extractor, {label: place for place, label in enumerate(LABELS)}) if extractor else None


@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
@examples(60)
@given(batch=batches, shown=extractors(TWO) | st.integers(0, 2**24 - 1))
def test_the_answer_is_of_a_full_search(options: Options, batch: list[SymbolicMesh], shown: Extractor | int) -> None:
    """Whether an extractor or anything at all was shown."""
    if isinstance(shown, int):
        selected = [(shown >> 8 * k) % (1 << len(mesh.hulls)) for k, mesh in enumerate(batch)]
        assume(any(selected))
        examples = [Example(str(k), mesh, mask) for k, (mesh, mask) in enumerate(zip(batch, selected, strict=True))]
    else:
        examples = examples_of(batch, shown)
    assert key(found(examples, 6, options)) == key(naive_search(examples, TWO, max_size=6))


@examples(100)
@given(batches, extractors(LABELS, max_leaves=5))
def test_what_is_found_selects_what_was_shown(batch: list[SymbolicMesh], hidden: Extractor) -> None:
    examples = examples_of(batch, hidden)
    extractor = found(examples, max_size=19, labels=LABELS)
    assert extractor is not None
    assert [select_mask(extractor, e.mesh) for e in examples] == [e.selection for e in examples]
