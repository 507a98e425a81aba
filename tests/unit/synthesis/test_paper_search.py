"""The search of the paper strategy: order, counts, layers, limits and the nearest miss."""

from __future__ import annotations

from itertools import count

import pytest

from meshforge.language import All, Attach, Diff, Extractor, Geo, Intersect, Is, Union, select_mask
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.demonstration import Example
from meshforge.synthesis.options import Layers, Options, TimeBudget
from meshforge.synthesis.paper.partial import Hole, HoleGrammar, Open, Worklist
from meshforge.synthesis.paper.search import HitWithFixes, PaperSearch
from meshforge.synthesis.search.smallest import Miss, NearestExtractor, SearchResult, Unfinished
from tests.synthesis_boxes import table

LABELS = ("panel", "leg", "drawer", "handle", "misc")
EXACT = Options(repair=False)
CONTACT = Options(repair=False, layers="S+T", max_size=3)


def masked(mesh: SymbolicMesh, *names: str) -> int:
    return sum(1 << mesh.index[name] for name in names)


def shown(extractor: Extractor, *meshes: SymbolicMesh) -> list[Example]:
    return [Example(f"table {k}", mesh, select_mask(extractor, mesh)) for k, mesh in enumerate(meshes)]


def run(examples: list[Example], options: Options = EXACT) -> SearchResult | HitWithFixes:
    return PaperSearch(examples, LABELS, TimeBudget(60), options).run()


def enumerate_extractors(size: int, layers: Layers) -> list[Extractor]:
    """All up to a size, in the order of the search."""
    found: list[Extractor] = []
    worklist, grammar = Worklist(size), HoleGrammar(("a",), layers)
    worklist.put(Hole())
    while popped := worklist.pop():
        partial = popped[1]
        if isinstance(partial, Open):
            for candidate in grammar.fill(partial):
                worklist.put(candidate)
        else:
            found.append(partial)
    return found


def test_of_equal_size_labels_come_first_then_all_then_contact_then_position_then_sets() -> None:
    first = enumerate_extractors(3, "S+T+G")
    assert first[:4] == [Is("a"), All(), Geo(Is("a"), "+X"), Geo(All(), "+X")]
    assert [type(extractor) for extractor in first[14:]] == [Attach] * 4 + [Union] * 4 + [Intersect] * 4 + [Diff] * 4
    assert first[18:20] == [Union(Is("a"), Is("a")), Union(Is("a"), All())]


@pytest.mark.parametrize(("layers", "barred"), [("S", {Attach, Geo}), ("S+T", {Geo}), ("S+G", {Attach})])
def test_a_layer_left_out_is_not_used(layers: Layers, barred: set[type]) -> None:
    def parts(extractor: Extractor) -> set[type]:
        inner = (extractor.left, extractor.right) if isinstance(extractor, Union | Intersect | Diff) else ()
        return {type(extractor)}.union(*map(parts, inner))

    seen: set[type] = set().union(*map(parts, enumerate_extractors(5, layers)))
    assert seen == {All, Is, Attach, Geo, Union, Intersect, Diff} - barred


def test_what_nothing_selects_is_a_miss_with_the_nearest() -> None:
    mesh = table()
    answer = run([Example("table", mesh, masked(mesh, "handle0", "leg0_low"))], CONTACT)
    assert isinstance(answer, Miss)
    assert answer.why == "no extractor of up to 3 nodes matches"
    assert answer.nearest == NearestExtractor(Is("handle"), "table", extra=("knob",), missing=("leg0_low",))
    assert answer.tried.size == 3


def test_when_the_time_is_out_the_nearest_so_far_is_kept() -> None:
    ticks = count()
    budget = TimeBudget(30, clock=lambda: next(ticks))
    mesh = table()
    example = Example("table", mesh, select_mask(Diff(Is("drawer"), Geo(Is("drawer"), "-Z")), mesh))
    answer = PaperSearch([example], LABELS, budget, EXACT).run()
    assert isinstance(answer, Unfinished)
    assert answer.nearest is not None
    assert answer.nearest.extractor == Is("drawer")
    assert answer.nearest.extra == ("drawer0_bottom",)
    assert answer.tried.selections + answer.tried.goals < 31


def test_when_there_is_no_time_at_all_there_is_no_nearest() -> None:
    answer = PaperSearch(shown(Is("leg"), table()), LABELS, TimeBudget(0), EXACT).run()
    assert isinstance(answer, Unfinished)
    assert answer.nearest is None
