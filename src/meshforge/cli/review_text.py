"""What `review`, `status` and `apply` say of how sure results are."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from meshforge.common import pluralize
from meshforge.project import ProjectReview
from meshforge.signoff import AssetConfidence, ReviewQuestion

MOST_HELD = 12
"""Held assets that are named."""


def format_counts(signed_off: int, total: int, held: int, aside: int, bar: float) -> str:
    """The sentence that says how far a family is signed off."""
    if not total:
        return "There is no asset."
    some = f"{signed_off} of {total} are at least {bar:.0%} sure, or were looked at"
    aside_text = f"; {aside} set aside" if aside else ""
    if held:
        return f"{some}{aside_text}; look at {'this one' if held == 1 else f'these {held}'}:"
    return f"{some}{aside_text}: signed off."


def format_review(found: ProjectReview, folder: Path, held: int = MOST_HELD) -> str:
    """How the family stands: the counts, then the assets that are held, the least probable first."""
    one = found.assessment
    names = one.held
    lines = [format_counts(len(one.signed_off), len(one.assets), len(names), len(one.aside), one.bar)]
    lines += [f"  {format_asset(one.assets[name])}" for name in names[:held]]
    lines += [f"  and {len(names) - held} more (all with --json)"] if len(names) > held else []
    lines += [f"  {name} cannot be read: {why}" for name, why in found.lost.items()]
    if names and one.question is None:
        lines.append(
            "Nothing is left to ask: show the edit on one of these (meshforge demonstrate), or mend its result."
        )
    return "\n".join(lines)


def format_asset(one: AssetConfidence) -> str:
    """One asset with its weightiest doubt."""
    doubt = f": {one.doubts[0].text}" if one.doubts else ""
    return f"{one.asset} ({format_share(one.probability)}){doubt}"


def format_share(share: float) -> str:
    """A probability in whole percent, rounded down, so that none below the bar looks as if it were at it."""
    return f"{int(share * 100)}%"


def format_question(question: ReviewQuestion, pictures: Sequence[Path]) -> str:
    """A question as it is asked, with where its pictures lie."""
    lines = [f"{question.text}  [{question.id}, about {question.seconds:.0f} s]"]
    by_asset: dict[str, list[str]] = {}
    for place in question.hulls:
        by_asset.setdefault(place.asset, []).append(place.hull)
    lines += [f"  {asset}: {', '.join(hulls)}" for asset, hulls in by_asset.items()]
    for number, choice in enumerate(question.choices, 1):
        selected = "" if choice.select is None else f": {pluralize(len(choice.select), 'hull')}"
        selected += f", {', '.join(choice.select)}" if choice.select else ""
        lines.append(f"  {number} {choice.text}{selected}")
    lines += [f"  picture: {path}" for path in pictures]
    return "\n".join(lines)
