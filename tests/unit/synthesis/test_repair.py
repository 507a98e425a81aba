"""Which labels are proposed to be corrected, and which are left alone. How believable labels are, by their source,
their confidence and the hulls that are like theirs."""

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import pytest

from meshforge.geometry import Aabb, Box
from meshforge.label_model.odds import LabelBeliefs
from meshforge.language import Extractor, parse_extractor, select_mask, show
from meshforge.symbolic import Hull, Label, LabelSource, SymbolicMesh
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


def said(name: str, label: Label | None) -> SymbolicMesh:
    """A table whose labels come from a model, one hull's label given."""
    mesh = table()
    labels: dict[str, Label | None] = {hull.name: Label(hull.label or "", 0.9, "vlm") for hull in mesh.hulls}
    return mesh.with_labels({**labels, name: label})


def cost(label: Label | None, to: str, name: str = "leg0_low") -> float:
    mesh = said(name, label)
    return LabelBeliefs({"table": mesh}, {"a": table(), "b": table(legs=3)}, VOCABULARY).cost(
        "table", mesh.hull_of(name), to
    )


def test_a_label_that_similar_hulls_have_costs_less() -> None:
    assert cost(Label("drawer", 0.8, "vlm"), "leg") < cost(Label("drawer", 0.8, "vlm"), "panel")
    assert cost(Label("drawer", 0.8, "vlm"), "leg") < cost(Label("leg", 0.8, "vlm"), "drawer")


def test_a_surer_label_costs_more() -> None:
    costs = [cost(Label("drawer", sure, "vlm"), "leg") for sure in (0.5, 0.7, 0.9)]
    assert costs == sorted(costs)
    assert costs[0] < costs[-1]


@pytest.mark.parametrize("source", ["vlm", "propagated", "name", "file"])
def test_a_persons_label_costs_most(source: LabelSource) -> None:
    assert cost(Label("drawer", 1.0, "user"), "leg") > cost(Label("drawer", 1.0, source), "leg") + 2
    assert cost(Label("drawer", 1.0, "repair"), "leg") == cost(Label("drawer", 1.0, "user"), "leg")


def test_a_missing_label_is_filled_in_by_what_similar_hulls_have() -> None:
    assert 0 < cost(None, "leg") < cost(None, "panel")


def test_a_hull_that_a_rule_made_or_relabelled_has_no_standing() -> None:
    mesh = table()
    labels, hull = LabelBeliefs({"table": mesh}, {}, VOCABULARY), mesh.hulls[0]
    made = Hull(
        "leg0_low~1", "body", Box.of_bounds(Aabb([0, 0, 0], [1, 1, 1])), Label("leg", source="edit"), "leg0_low"
    )
    assert labels.cost("table", hull, "leg") < math.inf
    assert labels.cost("table", made, "panel") == math.inf
    assert labels.cost("table", hull.with_label(Label("leg")), "panel") == math.inf
    assert labels.cost("table", hull, "unheard of") == math.inf
    assert labels.cost("another", hull, "leg") == math.inf


def test_a_demonstrated_mesh_in_the_batch_is_not_asked_about_itself() -> None:
    mesh = table()
    alone, twice = (
        LabelBeliefs({"table": mesh}, {}, VOCABULARY),
        LabelBeliefs({"table": mesh}, {"again": mesh}, VOCABULARY),
    )
    for hull in mesh.hulls:
        assert alone.cost("table", hull, "misc") == twice.cost("table", hull, "misc")


def test_wrong_and_missing_labels_are_expected_where_look_alikes_disagree() -> None:
    others = {f"table {k}": said("leg1_low", Label("leg", 0.9, "vlm")) for k in range(4)}
    right, missing = said("leg0_low", Label("leg", 0.9, "vlm")), said("leg0_low", None)
    wrong = said("leg0_low", Label("drawer", 0.6, "vlm"))
    errors = LabelBeliefs({"shown": right}, {"wrong": wrong, "missing": missing, **others}, VOCABULARY).errors
    assert set(errors) == {"shown", "wrong", "missing", *others}
    assert errors["shown"] < 0.5 < errors["wrong"] < 1.5
    assert 1 <= errors["missing"] < 1.5
    persons = {name: mesh.with_labels({hull.name: Label(hull.label or "", 1.0, "user") for hull in mesh.hulls})
               for name, mesh in others.items()}  # fmt: skip
    assert max(LabelBeliefs({}, persons, VOCABULARY).errors.values()) < 0.05
