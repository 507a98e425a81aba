"""Random extractors, demonstrated on two of the bundled tables: found, never larger, and among the readings."""

from functools import cache

from hypothesis import assume, given
from hypothesis import strategies as st

from meshforge.formats import load
from meshforge.language import Extractor, Program, select_mask, size_of, to_canonical_frame
from meshforge.samples import TABLES
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.candidates.rank import enumerate_consistent
from meshforge.synthesis.demonstration import Example
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.search.smallest import Hit, Search
from tests.examples import examples
from tests.strategies import extractors

LABELS = ("panel", "leg", "handle", "drawer", "misc")
places = st.integers(0, 13)


@cache
def tables() -> tuple[SymbolicMesh, ...]:
    """The bundled tables with their labels, upright."""
    orient = Program.read(TABLES / "tables.mf").orient
    paths = sorted(TABLES.glob("table_*.obj"))
    return tuple(to_canonical_frame(load(path, path.with_suffix(".labels.json")), orient)[0] for path in paths)


def examples_from(hidden: Extractor, shown: tuple[int, int]) -> list[Example]:
    found = [Example(f"table {k}", tables()[k], select_mask(hidden, tables()[k])) for k in dict.fromkeys(shown)]
    assume(any(example.selection for example in found))
    return found


@examples(120)
@given(extractors(LABELS, max_leaves=4), st.tuples(places, places))
def test_what_is_found_is_no_larger_and_what_was_meant_is_a_reading(hidden: Extractor, shown: tuple[int, int]) -> None:
    known = examples_from(hidden, shown)
    rest = [table for k, table in enumerate(tables()) if k not in shown]
    search = Search(known, LABELS, TimeBudget(600), Options(max_size=19), batch=rest)
    answer = search.run()
    assert isinstance(answer, Hit)
    assert [select_mask(answer.extractor, e.mesh) for e in known] == [e.selection for e in known]
    assert size_of(answer.extractor) <= size_of(hidden)
    found = enumerate_consistent(search, answer.extractor, 3)
    if found.complete and size_of(hidden) <= size_of(answer.extractor) + 3:
        assert search.field.bits(hidden) in {term.bits for term in found.terms}
