"""What the batch says about a reading: idle, strange; and operands and limits that nothing was shown of."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from meshforge.language import parse_extractor, select_mask
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.candidates.belief import (
    NO_EVIDENCE,
    STRANGE_LABEL,
    CandidateEvidence,
    count_idle,
    count_untested,
    measure_evidence,
)
from meshforge.synthesis.search.observation_table import ObservationTable
from tests.synthesis_boxes import boxes

LABELS = ("leg", "panel", "misc")
NONE_AT_ALL = SymbolicMesh(())


def row(legs: int, misc: int = 0) -> SymbolicMesh:
    """Legs in a row under a panel, all alike, and litter."""
    return boxes(
        ("top", "panel", (0, 0, 1), (9, 1, 1)),
        *((f"leg{k}", "leg", (2 * k, 0, 0), (1, 1, 1)) for k in range(legs)),
        *((f"bit{k}", "misc", (2 * k, 5, 0), (1, 1, 1)) for k in range(misc)),
    )


def said(
    texts: Sequence[str], shown: Sequence[SymbolicMesh], batch: Sequence[SymbolicMesh], rule: str = "Is(leg)"
) -> tuple[CandidateEvidence, ...]:
    """The evidence on some extractors, where a rule was demonstrated."""
    field = ObservationTable([*shown, *batch], LABELS)
    selections = [select_mask(parse_extractor(rule), mesh) for mesh in shown]
    return measure_evidence(field, selections, [field.bits(parse_extractor(text)) for text in texts])


@pytest.mark.parametrize("batch", [[], [NONE_AT_ALL], [NONE_AT_ALL, NONE_AT_ALL]])
def test_without_other_hulls_there_is_no_evidence(batch: list[SymbolicMesh]) -> None:
    assert said(["Is(leg)", "All"], [row(2)], batch) == (NO_EVIDENCE, NO_EVIDENCE)


def test_a_reading_is_idle_on_the_share_of_assets_where_it_selects_nothing() -> None:
    (legs,) = said(["Is(leg)"], [row(2)], [row(0), row(2), row(2), row(2)])
    assert legs.idle == 0.25


def test_a_reading_that_never_selects_is_idle_and_nothing_else() -> None:
    assert said(["Is(misc)"], [row(2, 1)], [row(2), row(3)]) == (CandidateEvidence(1.0, 0.0),)


def test_hulls_like_those_demonstrated_are_not_strange_and_others_are_the_more_the_less_alike() -> None:
    alike, label, both = said(["Is(leg)", "Is(misc)", "All"], [row(2, 1)], [row(2, 1)])
    assert alike.strange == pytest.approx(0.0, abs=1e-9)
    assert label.strange >= STRANGE_LABEL**2
    assert alike.strange < both.strange


def test_the_evidence_does_not_depend_on_the_unit_of_length() -> None:
    def scaled(mesh: SymbolicMesh, factor: float) -> SymbolicMesh:
        pieces = [(h.name, h.label, h.aabb.min * factor, (h.aabb.max - h.aabb.min) * factor) for h in mesh.hulls]
        return boxes(*((name, label, low.tolist(), size.tolist()) for name, label, low, size in pieces))

    meshes = [row(2, 1), row(3, 2), row(4)]
    (metres,) = said(["All"], meshes[:1], meshes[1:])
    (microns,) = said(["All"], [scaled(meshes[0], 1e6)], [scaled(mesh, 1e6) for mesh in meshes[1:]])
    assert microns.strange == pytest.approx(metres.strange)
    assert microns.idle == metres.idle


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("Is(leg)", 0),
        ("Union(Is(leg), Is(panel))", 0),
        ("Union(Is(leg), Is(misc))", 1),
        ("Union(Is(leg), Is(leg))", 1),
        ("Intersect(Is(leg), All)", 1),
        ("Intersect(All, Geo(All, +Z))", 1),
        ("Intersect(Is(leg), Geo(Is(leg), -X))", 1),
        ("Diff(Is(leg), Geo(Is(leg), -X))", 0),
        ("Diff(Is(leg), Is(misc))", 1),
        ("Diff(Is(leg), Is(panel))", 1),
        ("Union(Is(panel), Diff(Is(leg), Is(misc)))", 1),
        ("Union(Union(Is(misc), Is(leg)), Diff(Is(leg), Is(misc)))", 3),
    ],
)
def test_operands_that_make_no_difference_where_it_was_shown_are_untried(text: str, count: int) -> None:
    field = ObservationTable([row(2), row(2, 2)], LABELS)
    assert count_untested(field.term(parse_extractor(text)), (1 << field.width_of(1)) - 1) == count


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("Is(leg)", 0),
        ("Geo(Is(leg), -Z)", 1),
        ("Geo(Is(leg), +X)", 0),
        ("Diff(Is(leg), Geo(Is(leg), -Z))", 1),
        ("Geo(All, -Z)", 0),
    ],
)
def test_a_limit_that_leaves_nothing_out_where_it_was_shown_is_unneeded(text: str, count: int) -> None:
    field = ObservationTable([row(2, 1), row(3, 2)], ("leg", "panel", "misc"))
    assert count_idle(field.term(parse_extractor(text)), (1 << field.width_of(1)) - 1, field) == count
