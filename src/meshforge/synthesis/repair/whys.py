"""Why a label is thought to be wrong, in a sentence for the user."""

from __future__ import annotations

from meshforge.language import Extractor, show
from meshforge.symbolic import Hull
from meshforge.synthesis.repair.standing import Standing, is_human

_UNSURE = 0.8  # a confidence below is worth mentioning


def why(standing: Standing, to: str, extractor: Extractor, alone: bool) -> str:
    """One sentence on the label itself, and what its correction makes possible.

    alone: whether it is the only correction.
    """
    evidence = "; ".join([*_evidence(standing, to), _effect(extractor, alone)])
    return evidence[0].upper() + evidence[1:]


def _evidence(standing: Standing, to: str) -> list[str]:
    similar, hull = standing.similar, standing.hull
    agreeing, of = similar.count(to), len(similar)
    said = []
    if agreeing > similar.count(hull.label or ""):
        said.append(f"{agreeing} of the {of} most similar hulls are labelled {to}")
    return [*said, *_doubts(hull)]


def _doubts(hull: Hull) -> list[str]:
    if hull.annotation is None:
        return ["it has no label"]
    if is_human(hull):
        return [f"a person labelled it {hull.annotation.name}"]
    if hull.annotation.confidence < _UNSURE:
        return [f"{hull.annotation.name} has a confidence of {hull.annotation.confidence:.2f} only"]
    return []


def _effect(extractor: Extractor, alone: bool) -> str:
    return f"with {'it' if alone else 'all corrections'}, {show(extractor)} selects what was shown"
