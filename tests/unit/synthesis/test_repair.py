"""Which labels are proposed to be corrected, and which are left alone."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import pytest

from meshforge.label_model.odds import LabelBeliefs
from meshforge.language import Extractor, parse_extractor, select_mask, show
from meshforge.symbolic import Label, LabelSource, SymbolicMesh
from meshforge.synthesis.demonstration import Example, LabelFix
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.repair.explain import Explanation, FixSearch
from meshforge.synthesis.search.smallest import Hit, Search
from tests.synthesis_boxes import boxes, table

VOCABULARY = ("drawer", "handle", "leg", "misc", "panel")
OPTIONS = Options(max_size=9)
FAMILY = [
    table(legs, drawers, knob, litter)
    for legs in (3, 4)
    for drawers in (1, 2)
    for knob in (None, 0.1)
    for litter in (0, 1)
]
FIRST, SECOND = table(), table(drawers=2)

Wrong = Mapping[str, str | None]


def labelled(mesh: SymbolicMesh, wrong: Wrong, confidence: float = 0.6, source: LabelSource = "vlm") -> SymbolicMesh:
    """The mesh with labels of a model that is sure of all but the wrong ones."""
    labels: dict[str, Label | None] = {hull.name: Label(hull.label, 0.95, "vlm") for hull in mesh.hulls if hull.label}
    for name, label in wrong.items():
        labels[name] = Label(label, confidence, source) if label else None
    return mesh.with_labels(labels)


def examples_of(rule: str, *wrongs: Wrong, confidence: float = 0.6, source: LabelSource = "vlm") -> list[Example]:
    """What a rule selects on the tables with their true labels, shown on wrong ones."""
    hidden = parse_extractor(rule)
    return [
        Example(f"table {k}", labelled(mesh, wrong, confidence, source), select_mask(hidden, mesh))
        for k, (mesh, wrong) in enumerate(zip((FIRST, SECOND), wrongs, strict=False), 1)
    ]


def explained(
    examples: Sequence[Example],
    rejected: Collection[LabelFix] = (),
    spent: Mapping[str, int] | None = None,
    options: Options = OPTIONS,
    batch: Sequence[SymbolicMesh] = FAMILY,
) -> Explanation | None:
    others = {f"other {k}": labelled(mesh, {}) for k, mesh in enumerate(batch)}
    labels = LabelBeliefs({example.name: example.mesh for example in examples}, others, VOCABULARY)
    exact = exact_of(examples)
    return FixSearch(
        examples,
        VOCABULARY,
        labels,
        options,
        TimeBudget(60),
        exact=exact,
        spent=spent or {},
        rejected=frozenset(rejected),
    ).run()


def exact_of(examples: Sequence[Example]) -> Extractor | None:
    answer = Search(examples, VOCABULARY, TimeBudget(60), OPTIONS).run()
    return answer.extractor if isinstance(answer, Hit) else None


def asked(explanation: Explanation | None) -> dict[tuple[str, str], tuple[str | None, str]]:
    assert explanation
    return {(row.asset, row.hull): (row.was, row.to) for row in explanation.fixes}


def test_a_mislabelled_hull_that_was_selected_is_found() -> None:
    said = explained(examples_of("Is(leg)", {"leg0_low": "drawer"}, {}))
    assert asked(said) == {("table 1", "leg0_low"): ("drawer", "leg")}
    assert said
    assert show(said.extractor) == "Is(leg)"
    assert said.beliefs[0] > 0.85


def chest(far: float) -> SymbolicMesh:
    """A chest with a drawer and bars in front and at the back; no direction tells handles and bars apart."""
    sides = {"front": (-0.1, -0.2, -0.2), "back": (1.0, 1.1, 1.0)}
    return boxes(
        ("chest", "panel", (0, 0, 0), (far, 1, 1)),
        *((f"drawer_{side}", "drawer", (0.2, y, 0.1), (0.3, 0.1, 0.3)) for side, (y, _, _) in sides.items()),
        *((f"handle_{side}", "handle", (0.3, y, 0.2), (0.1, 0.1, 0.1)) for side, (_, y, _) in sides.items()),
        *((f"left_{side}", "handle", (0, y, 0.2), (0.1, 0.2, 0.1)) for side, (_, _, y) in sides.items()),
        *((f"right_{side}", "handle", (far - 0.1, y, 0.2), (0.1, 0.2, 0.1)) for side, (_, _, y) in sides.items()),
    )


def test_a_mislabelled_landmark_is_found_though_it_is_never_selected() -> None:
    meshes, hidden = [chest(1.0), chest(1.2)], parse_extractor("Attach(Is(handle), Is(drawer))")
    shown = [labelled(meshes[0], {"drawer_front": "panel"}), labelled(meshes[1], {})]
    examples = [Example(f"chest {k}", shown[k], select_mask(hidden, meshes[k])) for k in (0, 1)]
    said = explained(examples, batch=[chest(0.9 + 0.05 * k) for k in range(8)])
    assert asked(said) == {("chest 0", "drawer_front"): ("panel", "drawer")}
    assert said
    assert said.extractor == hidden


@pytest.mark.parametrize(
    "wrongs",
    [
        ({"leg0_low": "drawer", "leg3_high": "panel"}, {}),
        ({"leg0_low": "drawer"}, {"leg1_high": "handle"}),
        ({"leg0_low": None}, {}),
    ],
)
def test_several_wrong_labels_are_found_together_and_a_missing_one_is_filled_in(wrongs: Sequence[Wrong]) -> None:
    wanted = {(f"table {k}", hull): (was, "leg") for k, wrong in enumerate(wrongs, 1) for hull, was in wrong.items()}
    assert asked(explained(examples_of("Is(leg)", *wrongs))) == wanted


@pytest.mark.parametrize(
    "rule",
    [
        "Is(leg)",
        "Geo(Is(panel), +Z)",
        "Attach(Is(handle), Is(drawer))",
        "Diff(Is(handle), Attach(Is(handle), Is(drawer)))",
        "Diff(Is(leg), Attach(Is(leg), Is(panel)))",
        "Diff(Is(drawer), Geo(Is(drawer), -Z))",
        "Union(Is(misc), Diff(Is(handle), Attach(Is(handle), Is(drawer))))",
    ],
)
def test_right_labels_are_left_alone_however_large_the_program(rule: str) -> None:
    assert explained(examples_of(rule, {}, {})) is None
    assert explained(examples_of(rule, {})) is None


def test_a_wrong_label_that_the_program_does_not_meet_is_left_alone() -> None:
    assert explained(examples_of("Is(leg)", {"drawer0_left": "handle"}, {})) is None


def test_a_label_that_is_not_to_be_corrected_stands_whatever_else_it_might_be() -> None:
    examples = examples_of("Is(leg)", {"leg0_low": "drawer"}, {})
    first = explained(examples)
    assert first
    (right,) = first.fixes
    assert right.to == "leg"
    other = replace(right, to="handle")
    again = explained(examples, rejected=[other])
    assert again is None or right.hull not in {correction.hull for correction in again.fixes}
    assert explained(examples, rejected=[replace(other, was="misc")]) == first, "it had another label then"


def test_corrections_for_earlier_rules_count() -> None:
    examples = examples_of("Is(leg)", {"leg0_low": "drawer"}, {})
    assert explained(examples, spent={"table 1": 1})
    assert explained(examples, spent={"table 1": 2}) is None
    assert explained(examples, options=Options(max_size=9, eta=0)) is None


def test_a_persons_label_is_believed_most() -> None:
    doubtful = explained(examples_of("Is(leg)", {"leg0_low": "drawer"}, {}))
    human = explained(examples_of("Is(leg)", {"leg0_low": "drawer"}, {}, confidence=1.0, source="user"))
    assert doubtful
    assert human is None or max(human.beliefs) <= 0.5 < min(doubtful.beliefs)


def test_the_reason_names_similar_hulls_confidence_and_the_program() -> None:
    said = explained(examples_of("Is(leg)", {"leg0_low": "drawer"}, {}))
    assert said
    assert said.whys == (
        "6 of the 6 most similar hulls are labelled leg; drawer has a confidence of 0.60 only; "
        "with it, Is(leg) selects what was shown",
    )
