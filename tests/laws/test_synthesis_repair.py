"""Whatever is proposed explains what was shown, within the limits, and every correction of it is needed."""

from collections import Counter

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

from meshforge.label_model.odds import LabelBeliefs
from meshforge.language import Extractor, HullTable, select_mask, size_of
from meshforge.symbolic import Label, SymbolicMesh
from meshforge.synthesis.demonstration import Example, LabelFix
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.repair.explain import Explanation, FixSearch
from meshforge.synthesis.repair.relabelings import Relabeling, build_hull_table, relabel
from meshforge.synthesis.search.observation_table import select_all
from meshforge.synthesis.search.smallest import Hit, Search
from meshforge.synthesis.search.terms import enumerate_leaves
from tests.examples import examples
from tests.strategies import extractors, grid_boxes, meshes

LABELS = ("a", "b", "c")
batches = st.lists(meshes(grid_boxes(), vocabulary=LABELS, max_size=6), min_size=1, max_size=3)
OPTIONS = Options(max_size=6)
Shown = tuple[list[Example], LabelBeliefs]


@st.composite
def spoilt(draw: st.DrawFn) -> Shown:
    """What a hidden extractor selects, shown on meshes of which some labels were changed or taken away."""
    hidden, true = draw(extractors(LABELS, max_leaves=2)), draw(batches)
    examples = []
    for k, mesh in enumerate(true):
        wrong = draw(st.lists(st.sampled_from(mesh.hulls), max_size=2))
        names: list[str | None] = [draw(st.sampled_from((*LABELS, None))) for _ in wrong]
        labels = {hull.name: Label(to, 0.5, "vlm") if to else None for hull, to in zip(wrong, names, strict=True)}
        examples.append(Example(f"mesh {k}", mesh.with_labels(labels), select_mask(hidden, mesh)))
    assume(any(example.selection for example in examples))
    shown, rest = {one.name: one.mesh for one in examples}, {f"other {k}": mesh for k, mesh in enumerate(true)}
    return examples, LabelBeliefs(shown, rest, LABELS)


def proposed(
    shown: Shown,
    exact: Extractor | None = None,
    spent: dict[str, int] | None = None,
    rejected: frozenset[LabelFix] = frozenset(),
) -> Explanation | None:
    examples, labels = shown
    return FixSearch(
        examples, LABELS, labels, OPTIONS, TimeBudget(600), exact=exact, spent=spent or {}, rejected=rejected
    ).run()


def corrected(example: Example, rows: list[LabelFix]) -> SymbolicMesh:
    return example.mesh.with_labels({row.hull: Label(row.to) for row in rows if row.asset == example.name})


def matches(extractor: Extractor, examples: list[Example], rows: list[LabelFix]) -> bool:
    return all(select_mask(extractor, corrected(example, rows)) == example.selection for example in examples)


@examples(80)
@given(spoilt())
def test_the_extractor_selects_what_was_shown_on_the_corrected_meshes(shown: Shown) -> None:
    said = proposed(shown)
    if said is None:
        return
    rows = list(said.fixes)
    assert rows
    assert matches(said.extractor, shown[0], rows)
    for row in rows:
        assert not matches(said.extractor, shown[0], [other for other in rows if other != row])


@examples(60)
@given(spoilt(), st.integers(0, 2))
def test_a_proposal_is_in_order_and_within_its_limits(shown: Shown, before: int) -> None:
    spent = {example.name: before for example in shown[0][1:]}
    said = proposed(shown, spent=spent)
    if said is None:
        return
    counts = Counter(row.asset for row in said.fixes)
    assert all(count <= OPTIONS.eta - spent.get(asset, 0) for asset, count in counts.items())
    assert list(said.fixes) == sorted(said.fixes, key=lambda row: (row.asset, row.hull))
    assert len(said.fixes) == len(said.beliefs) == len(said.whys)
    assert all(0 < belief <= 1 for belief in said.beliefs)
    by_name = {example.name: example for example in shown[0]}
    for row in said.fixes:
        assert by_name[row.asset].mesh.hull_of(row.hull).label == row.was != row.to
        assert row.to in LABELS


@examples(60)
@given(spoilt())
def test_what_was_rejected_is_never_proposed_again(shown: Shown) -> None:
    rejected: frozenset[LabelFix] = frozenset()
    for _ in range(4):
        said = proposed(shown, rejected=rejected)
        if said is None:
            return
        assert not rejected & set(said.fixes)
        rejected |= set(said.fixes)


@examples(60)
@given(spoilt())
def test_beside_an_exact_extractor_only_smaller_ones_are_proposed(shown: Shown) -> None:
    answer = Search(shown[0], LABELS, TimeBudget(600), OPTIONS).run()
    exact = answer.extractor if isinstance(answer, Hit) else None
    said = proposed(shown, exact)
    assert said is None or exact is None or size_of(said.extractor) < size_of(exact)


@examples(60)
@given(spoilt(), st.data())
def test_relabelled_hulls_are_selected_as_on_relabelled_meshes(shown: Shown, data: st.DataObject) -> None:
    examples, _ = shown
    ways = []
    for example in examples:
        hulls = st.integers(0, len(example.mesh.hulls) - 1)
        changes = st.lists(st.tuples(hulls, st.sampled_from(LABELS)), max_size=2, unique_by=lambda change: change[0])
        some = data.draw(st.lists(changes, min_size=1, max_size=3))
        ways.append([Relabeling(changes=tuple(sorted(one))) for one in some])
    made = [relabel(e, way.changes).mesh for e, some in zip(examples, ways, strict=True) for way in some]
    chosen = enumerate_leaves(tuple(LABELS))
    table = build_hull_table(examples, ways, 0.05)
    assert np.array_equal(select_all(chosen, table), select_all(chosen, HullTable(made)))
