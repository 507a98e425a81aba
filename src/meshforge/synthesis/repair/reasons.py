"""Why a label is proposed to be corrected, in words for the user."""

from __future__ import annotations

from meshforge.label_model import LabelOdds, is_human
from meshforge.language import Extractor, show
from meshforge.symbolic import Hull

_LOW_CONFIDENCE = 0.8  # a confidence below is worth mentioning


def explain_fix(odds: LabelOdds, to: str, extractor: Extractor, alone: bool) -> str:
    """Return one sentence on the label itself, and what its correction makes possible.

    alone: whether it is the only correction.
    """
    evidence = "; ".join([*list_evidence(odds, to), describe_effect(extractor, alone)])
    return evidence[0].upper() + evidence[1:]


def list_evidence(odds: LabelOdds, to: str) -> list[str]:
    """Return what speaks against a label and for another one."""
    similar, hull = odds.similar, odds.hull
    agreeing, of = similar.count(to), len(similar)
    reasons = []
    if agreeing > similar.count(hull.label or ""):
        reasons.append(f"{agreeing} of the {of} most similar hulls are labelled {to}")
    return [*reasons, *_label_reasons(hull)]


def _label_reasons(hull: Hull) -> list[str]:
    if hull.annotation is None:
        return ["it has no label"]
    if is_human(hull):
        return [f"a person labelled it {hull.annotation.name}"]
    if hull.annotation.confidence < _LOW_CONFIDENCE:
        return [f"{hull.annotation.name} has a confidence of {hull.annotation.confidence:.2f} only"]
    return []


def describe_effect(extractor: Extractor, alone: bool) -> str:
    """Return what corrections make possible. alone: whether there is only one."""
    return f"with {'it' if alone else 'all corrections'}, {show(extractor)} selects what was shown"
