"""How believable readings are, and which one a program takes. What the batch says about a reading: idle, strange; and
operands and limits that nothing was shown of."""

import math
from collections.abc import Sequence

import pytest

from meshforge.language import parse_extractor, select_mask
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.candidates.belief import (
    FEW,
    LARGER,
    NO_EVIDENCE,
    STRANGE_LABEL,
    CandidateEvidence,
    choose_candidate,
    compute_beliefs,
    count_idle,
    count_untested,
    measure_evidence,
)
from meshforge.synthesis.search.observation_table import ObservationTable
from meshforge.synthesis.search.terms import Term
from tests.synthesis_boxes import boxes

FIELD = ObservationTable(
    [
        boxes(
            ("top", "panel", (0, 0, 1), (9, 1, 1)),
            ("left", "leg", (0, 0, 0), (1, 1, 1)),
            ("right", "leg", (8, 0, 0), (1, 1, 1)),
        )
    ],
    ("leg", "panel", "misc"),
)
SHOWN = (1 << FIELD.width) - 1


def terms(*texts: str) -> list[Term]:
    return [FIELD.term(parse_extractor(text)) for text in texts]


def believed(*texts: str, found: Sequence[CandidateEvidence] = (), assets: int = 0) -> tuple[float, ...]:
    return compute_beliefs(terms(*texts), found or [NO_EVIDENCE] * len(texts), SHOWN, assets)


@pytest.mark.parametrize("texts", [["All"], ["Is(leg)", "Attach(Is(leg), Is(panel))", "Diff(Is(leg), Is(misc))"]])
def test_beliefs_are_shares_of_a_whole(texts: list[str]) -> None:
    shares = believed(*texts)
    assert math.fsum(shares) == pytest.approx(1.0)
    assert all(0 < share <= 1 for share in shares)


@pytest.mark.parametrize(
    ("likely", "unlikely"),
    [
        ("Is(leg)", "All"),
        ("Is(leg)", "Geo(Is(leg), -Z)"),
        ("Is(leg)", "Attach(Is(leg), Is(panel))"),
        ("Geo(Is(leg), +Z)", "Geo(Is(leg), +X)"),
        ("Geo(Is(leg), -Z)", "Geo(All, -Z)"),
        ("Attach(Is(leg), Is(panel))", "Attach(Is(leg), Is(leg))"),
        ("Attach(Is(leg), Is(panel))", "Attach(Is(leg), All)"),
        ("Attach(Is(leg), All)", "Attach(All, All)"),
        ("Union(Is(leg), Is(panel))", "Union(Is(leg), Is(misc))"),
        ("Union(Is(leg), Is(panel))", "Union(Is(leg), Geo(Is(panel), +X))"),
    ],
)
def test_what_people_rather_mean_is_believed_more(likely: str, unlikely: str) -> None:
    more, less = believed(likely, unlikely)
    assert more > less


@pytest.mark.parametrize("worse", [CandidateEvidence(1.0, 0.0), CandidateEvidence(0.0, 4.0)])
def test_every_kind_of_evidence_counts_and_the_more_the_larger_the_batch(worse: CandidateEvidence) -> None:
    shares = [
        believed("Is(leg)", "Is(panel)", found=[NO_EVIDENCE, worse], assets=assets)[1] for assets in (0, 1, FEW, 1000)
    ]
    assert shares[0] == pytest.approx(0.5)
    assert shares == sorted(shares, reverse=True)
    assert len(set(shares)) == 4


def test_what_leaves_nothing_out_where_it_was_shown_is_believed_less() -> None:
    rows = terms("Is(leg)", "Geo(Is(leg), -Z)")
    needed, idle = (compute_beliefs(rows, [NO_EVIDENCE] * 2, SHOWN, 0, None, [0, count])[1] for count in (0, 1))
    assert idle < needed


def test_evidence_however_strange_leaves_numbers_that_can_be_compared() -> None:
    worst = CandidateEvidence(1.0, 1e300)
    shares = believed("Is(leg)", "All", found=[NO_EVIDENCE, worst], assets=10**6)
    assert all(map(math.isfinite, shares))
    assert math.fsum(shares) == pytest.approx(1.0)
    assert 0 < shares[1] < 0.02
    assert math.fsum(believed("Is(leg)", "All", found=[worst, worst], assets=10**6)) == pytest.approx(1.0)


def test_the_smallest_is_taken_unless_a_larger_one_is_believed_twice_as_much() -> None:
    rows = terms("Is(leg)", "Attach(Is(leg), Is(panel))")
    assert choose_candidate(rows, [0.5, 0.5 * LARGER - 1e-9]) == 0
    assert choose_candidate(rows, [0.5, 0.5 * LARGER]) == 1


def test_of_the_smallest_the_most_believed_is_taken_and_of_equals_the_first() -> None:
    assert choose_candidate(terms("Is(leg)", "Is(panel)", "All"), [0.3, 0.5, 0.2]) == 1
    assert choose_candidate(terms("Is(leg)", "Is(panel)"), [0.5, 0.5]) == 0
    assert choose_candidate(terms("Is(leg)"), [1.0]) == 0


def test_a_larger_one_is_held_against_the_smallest_that_is_believed_most() -> None:
    rows = terms("Is(leg)", "Is(panel)", "Geo(Is(leg), -Z)")
    assert choose_candidate(rows, [0.1, 0.4, 0.5]) == 1
    assert choose_candidate(rows, [0.05, 0.15, 0.8]) == 2


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
