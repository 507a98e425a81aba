"""Labels that the paper strategy suspects: found, asked about, refused, and never more than allowed."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping

import pytest

from meshforge.language import Attach, Diff, Extractor, Is, select_mask
from meshforge.symbolic import Label, SymbolicMesh
from meshforge.synthesis.demonstration import Example, LabelFix
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.paper.search import HitWithFixes, PaperSearch
from meshforge.synthesis.search.smallest import Miss, SearchResult, Unfinished
from tests.synthesis_boxes import table

LABELS = ("panel", "leg", "drawer", "handle", "misc")
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
