"""How believable labels are, by their source, their confidence and the hulls that are like theirs."""

from __future__ import annotations

import math

import pytest

from meshforge.geometry import Aabb, Box
from meshforge.label_model.odds import LabelBeliefs
from meshforge.symbolic import Hull, Label, LabelSource, SymbolicMesh
from tests.synthesis_boxes import table

VOCABULARY = ("drawer", "handle", "leg", "misc", "panel")


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
