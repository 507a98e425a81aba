"""cvc5 finds extractors that select what was shown, and ends in time."""

import time

import pytest

from benchmark.learning.sygus import cvc5_problem, state_problem
from meshforge.language import All, Attach, Diff, Extractor, Geo, Intersect, Is, Union, select_mask
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.demonstration import Example
from tests.synthesis_boxes import table

LABELS = ("panel", "leg", "drawer", "handle", "misc")
TABLES = (table(), table(legs=5, drawers=3, knob=0.9))


def shown(extractor: Extractor, *meshes: SymbolicMesh) -> list[Example]:
    return [Example(f"table {k}", mesh, select_mask(extractor, mesh)) for k, mesh in enumerate(meshes)]


def test_a_problem_has_a_row_for_each_demonstrated_hull_and_no_leaf_that_tells_nothing() -> None:
    problem = state_problem(shown(Is("leg"), *TABLES), (*LABELS, "door"))
    assert len(problem.rows) == sum(len(mesh.hulls) for mesh in TABLES)
    assert {len(values) for values, _ in problem.rows} == {len(problem.leaves)}
    assert All() in problem.leaves
    assert Is("door") not in problem.leaves
    leg = problem.leaves.index(Is("leg"))
    assert all(values[leg] == selected for values, selected in problem.rows)


@pytest.mark.parametrize(
    "wanted",
    [
        All(),
        Is("leg"),
        Diff(All(), Is("misc")),
        Union(Is("leg"), Is("misc")),
        Intersect(Geo(Is("panel"), "+Z"), Attach(Is("panel"), Is("leg"))),
        Diff(Is("drawer"), Geo(Is("drawer"), "-Z")),
        Union(Diff(Is("drawer"), Geo(Is("drawer"), "-Z")), Attach(Is("handle"), Is("drawer"))),
    ],
)
def test_what_cvc5_finds_selects_what_was_shown(wanted: Extractor) -> None:
    pytest.importorskip("cvc5", reason="cvc5, the rival, is not installed")
    examples = shown(wanted, *TABLES)
    found = cvc5_problem(examples, LABELS, seconds=30)()
    assert found is not None
    assert [select_mask(found, example.mesh) for example in examples] == [example.selection for example in examples]


def test_cvc5_ends_when_its_time_is_out() -> None:
    pytest.importorskip("cvc5", reason="cvc5, the rival, is not installed")
    examples = [
        Example(f"table {k}", mesh, sum(1 << hull for hull in range(0, 20, 2))) for k, mesh in enumerate(TABLES)
    ]
    solve = cvc5_problem(examples, LABELS, seconds=0.3)
    start = time.perf_counter()
    assert solve() is None
    assert time.perf_counter() - start < 5.0
