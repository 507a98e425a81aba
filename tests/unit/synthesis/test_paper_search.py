"""The search of the paper strategy: order, counts, layers, limits and the nearest miss. Labels that it suspects: found,
asked about, refused, and never more than allowed."""

from collections.abc import Callable, Collection, Mapping
from itertools import count

import pytest

from meshforge.language import All, Attach, Diff, Extractor, Geo, Intersect, Is, Union, select_mask
from meshforge.symbolic import Label, SymbolicMesh
from meshforge.synthesis.demonstration import Example, LabelFix
from meshforge.synthesis.options import Layers, Options, TimeBudget
from meshforge.synthesis.paper.partial import Hole, HoleGrammar, Open, Worklist
from meshforge.synthesis.paper.search import HitWithFixes, PaperSearch
from meshforge.synthesis.search.smallest import Miss, NearestExtractor, SearchResult, Unfinished
from tests.synthesis_boxes import table

LABELS = ("panel", "leg", "drawer", "handle", "misc")
EXACT = Options(repair=False)
EXACT_CONTACT = Options(repair=False, layers="S+T", max_size=3)


def masked(mesh: SymbolicMesh, *names: str) -> int:
    return sum(1 << mesh.index[name] for name in names)


def shown(extractor: Extractor, *meshes: SymbolicMesh) -> list[Example]:
    return [Example(f"table {k}", mesh, select_mask(extractor, mesh)) for k, mesh in enumerate(meshes)]


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
    answer = run(Example("table", mesh, masked(mesh, "handle0", "leg0_low")), options=EXACT_CONTACT)
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


WRONG_LEG = LabelFix("table", "leg2_low", "panel", "leg")


def misread(right: SymbolicMesh, wanted: Extractor, name: str = "table", **labels: str | None) -> Example:
    """A mesh with some labels wrong, and what an extractor selects on it as it should be."""
    right.contacts  # noqa: B018 (measured now, and taken over by the relabelled mesh)
    wrong = right.with_labels({hull: Label(label) if label else None for hull, label in labels.items()})
    return Example(name, wrong, select_mask(wanted, right))


def run(
    *examples: Example,
    options: Options = Options(max_size=3),  # noqa: B008 (frozen)
    confirm: Callable[[LabelFix], bool] | None = None,
    rejected: Collection[LabelFix] = (),
    spent: Mapping[str, int] | None = None,
) -> SearchResult | HitWithFixes:
    return PaperSearch(
        examples, LABELS, TimeBudget(60), options, confirm=confirm, rejected=rejected, spent=spent or {}
    ).run()


def one_leg_wrong() -> Example:
    return misread(table(), Is("leg"), leg2_low="panel")


def test_a_wrong_label_is_found_and_proposed() -> None:
    answer = run(one_leg_wrong(), misread(table(legs=5), Is("leg"), "other"))
    assert isinstance(answer, HitWithFixes)
    assert (answer.extractor, answer.fixes) == (Is("leg"), (WRONG_LEG,))


def test_a_hull_leaves_for_the_most_frequent_label_that_is_not_mentioned() -> None:
    answer = run(misread(table(legs=4, drawers=2), Is("leg"), top_0="leg"))
    assert isinstance(answer, HitWithFixes)
    assert answer.fixes == (LabelFix("table", "top_0", "leg", "drawer"),)


def test_of_labels_as_frequent_the_first_of_the_vocabulary_is_taken() -> None:
    answer = run(misread(table(legs=1, drawers=0, litter=2, knob=None), Is("leg"), residue_0="leg", shelf="misc"))
    assert isinstance(answer, HitWithFixes)
    assert answer.fixes == (LabelFix("table", "residue_0", "leg", "panel"),)


def test_what_is_confirmed_ends_the_search() -> None:
    asked: list[LabelFix] = []

    def confirm(correction: LabelFix) -> bool:
        asked.append(correction)
        return True

    answer = run(one_leg_wrong(), confirm=confirm)
    assert isinstance(answer, HitWithFixes)
    assert asked == [WRONG_LEG] == list(answer.fixes)


def test_what_is_refused_is_not_asked_again_and_the_search_goes_on() -> None:
    asked: list[LabelFix] = []

    def refuse(correction: LabelFix) -> bool:
        asked.append(correction)
        return False

    answer = run(one_leg_wrong(), confirm=refuse)
    assert isinstance(answer, Miss)
    assert answer.why == "no extractor of up to 3 nodes matches, even after corrections of labels"
    assert asked[0] == WRONG_LEG
    assert len(set(asked)) == len(asked)


def test_corrections_are_asked_about_one_by_one_until_one_is_refused() -> None:
    example = misread(table(), Is("leg"), leg1_low="panel", leg2_low="panel")
    asked: list[str] = []

    def confirm(correction: LabelFix) -> bool:
        asked.append(correction.hull)
        return correction.hull != "leg2_low"

    run(example, options=Options(max_size=1), confirm=confirm)
    assert asked == ["leg1_low", "leg2_low"]


@pytest.mark.parametrize(("spent", "explained"), [({}, True), ({"other": 2}, True), ({"table": 2}, False)])
def test_what_was_spent_on_a_mesh_is_no_longer_allowed(spent: Mapping[str, int], explained: bool) -> None:
    assert isinstance(run(one_leg_wrong(), options=Options(max_size=1), spent=spent), HitWithFixes) == explained


HANDLES = Attach(Is("handle"), Is("drawer"))
CONTACT = Options(layers="S+T", max_size=3, eta=1)


def test_bounds_cut_what_only_a_repair_would_complete() -> None:
    """As printed: no completion of `Attach(Is(handle), _)` selects a handle that is labelled misc."""
    assert isinstance(run(misread(table(drawers=3), HANDLES, handle1="misc"), options=CONTACT), Miss)


def test_time_may_run_out_amid_relabelings() -> None:
    wanted = Diff(Is("leg"), Is("panel"))
    ticks = iter([0.0, 0.0, 0.0, 0.0] + [100.0] * 100)
    answer = PaperSearch(
        [misread(table(), wanted, leg1_low="panel")],
        LABELS,
        TimeBudget(60, clock=lambda: next(ticks)),
        Options(max_size=3),
    ).run()
    assert isinstance(answer, Unfinished)
    assert answer.nearest is not None
    assert answer.nearest.extractor == Is("panel")
