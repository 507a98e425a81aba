"""The paper strategy finds the smallest, its bounds hold, and its repairs are the smallest there are."""

from collections.abc import Iterator, Sequence
from itertools import combinations, product

from hypothesis import assume, given
from hypothesis import strategies as st

from meshforge.language import Extractor, labels_of, select_mask, size_of
from meshforge.symbolic import Label, SymbolicMesh, bits_of
from meshforge.synthesis.demonstration import Example, LabelFix
from meshforge.synthesis.options import LAYERS, Layers, Options, TimeBudget
from meshforge.synthesis.paper.partial import ExampleMasks
from meshforge.synthesis.paper.search import Abduction, HitWithFixes, PaperSearch
from meshforge.synthesis.search.smallest import Hit, Miss, Search
from tests.examples import examples
from tests.strategies import extractors, grid_boxes, meshes

LABELS = ("a", "b", "c")
batches = st.lists(meshes(grid_boxes(), vocabulary=LABELS), min_size=1, max_size=3)
small_batches = st.lists(meshes(grid_boxes(), vocabulary=LABELS, max_size=3), min_size=1, max_size=2)


def examples_of(batch: Sequence[SymbolicMesh], selected: Sequence[int]) -> list[Example]:
    assume(any(selected))
    return [Example(f"mesh {k}", mesh, mask) for k, (mesh, mask) in enumerate(zip(batch, selected, strict=True))]


def shown(batch: Sequence[SymbolicMesh], extractor: Extractor) -> list[Example]:
    return examples_of(batch, [select_mask(extractor, mesh) for mesh in batch])


@examples(60)
@given(batches, extractors(LABELS, max_leaves=3), st.sampled_from(LAYERS))
def test_the_size_is_that_of_the_other_strategy(batch: list[SymbolicMesh], hidden: Extractor, layers: Layers) -> None:
    examples = shown(batch, hidden)
    options = Options(layers=layers, repair=False, max_size=5)
    answer = PaperSearch(examples, LABELS, TimeBudget(600), options).run()
    other = Search(examples, LABELS, TimeBudget(600), options).run()
    assert isinstance(answer, Hit | Miss) and isinstance(other, Hit | Miss)
    assert isinstance(answer, Hit) == isinstance(other, Hit)
    if isinstance(answer, Hit) and isinstance(other, Hit):
        assert size_of(answer.extractor) == size_of(other.extractor)
        assert [select_mask(answer.extractor, e.mesh) for e in examples] == [e.selection for e in examples]


def corrected(example: Example, corrections: Sequence[LabelFix]) -> Example:
    example.mesh.contacts  # noqa: B018 (measured now, and taken over by the relabelled mesh)
    labels = {c.hull: Label(c.to, 1.0, "repair") for c in corrections if c.asset == example.name}
    return Example(example.name, example.mesh.with_labels(labels), example.selection)


def matches(extractor: Extractor, examples: Sequence[Example]) -> bool:
    return all(select_mask(extractor, example.mesh) == example.selection for example in examples)


def naive_repairs(extractor: Extractor, examples: Sequence[Example], eta: int) -> Iterator[tuple[LabelFix, ...]]:
    """All relabelings of at most eta suspects a mesh by labels relevant to the extractor, over all meshes at once."""
    mentioned = labels_of(extractor)
    labels = [hull.label for example in examples for hull in example.mesh.hulls]
    outside = sorted((label for label in LABELS if label not in mentioned), key=lambda label: -labels.count(label))
    relevant = (*mentioned, *outside[:1])
    ways = []
    for example in examples:
        wrong = bits_of(select_mask(extractor, example.mesh) ^ example.selection)
        suspects = [example.mesh.hulls[index] for index in sorted(wrong)]
        one = [[LabelFix(example.name, h.name, h.label, to) for to in relevant if to != h.label] for h in suspects]
        ways.append([way for k in range(eta + 1) for chosen in combinations(one, k) for way in product(*chosen)])
    for parts in product(*ways):
        yield tuple(correction for part in parts for correction in part)


@examples(150)
@given(small_batches, extractors(LABELS, max_leaves=2), st.integers(0, 2**6 - 1), st.integers(0, 2))
def test_a_repair_is_the_smallest_of_all_relabelings_of_suspects(
    batch: list[SymbolicMesh], extractor: Extractor, selections: int, eta: int
) -> None:
    examples = examples_of(batch, [(selections >> 3 * k) % (1 << len(mesh.hulls)) for k, mesh in enumerate(batch)])
    allowed = {example.name: eta for example in examples}
    found = Abduction([ExampleMasks(example) for example in examples], LABELS, allowed, TimeBudget(600)).infer(
        extractor
    )
    sizes = [
        len(repair)
        for repair in naive_repairs(extractor, examples, eta)
        if matches(extractor, [corrected(example, repair) for example in examples])
    ]
    assert (None if found is None else len(found)) == min(sizes, default=None)
    if found is not None:
        assert matches(extractor, [corrected(example, found) for example in examples])


@examples(40)
@given(batches, st.integers(0, 2**24 - 1), st.integers(0, 2))
def test_what_is_explained_matches_once_corrected(batch: list[SymbolicMesh], selections: int, eta: int) -> None:
    examples = examples_of(batch, [(selections >> 8 * k) % (1 << len(mesh.hulls)) for k, mesh in enumerate(batch)])
    answer = PaperSearch(examples, LABELS, TimeBudget(600), Options(max_size=3, eta=eta)).run()
    assume(isinstance(answer, HitWithFixes))
    assert isinstance(answer, HitWithFixes)
    assert matches(answer.extractor, [corrected(example, answer.fixes) for example in examples])
    for example in examples:
        assert sum(correction.asset == example.name for correction in answer.fixes) <= eta
