"""What `review`, `status`, `apply` and reports say of how sure results are."""

from __future__ import annotations

import json
import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from meshforge.common import join_names, pluralize
from meshforge.signoff import AssetConfidence, ReviewQuestion

if TYPE_CHECKING:
    from meshforge.project import AssetStatus, ProjectReview, Status

MOST_HELD = 12
"""Held assets that are named."""


def format_counts(signed_off: int, total: int, held: int, aside: int, bar: float) -> str:
    """The sentence that says how far a family is signed off."""
    if not total:
        return "There is no asset."
    are, were = ("is", "was") if signed_off == 1 else ("are", "were")
    some = f"{signed_off} of {total} {are} at least {100 * bar:g}% sure, or {were} looked at"
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
    if names and one.question is None:
        lines.append(
            "Nothing is left to ask: show the edit on one of these (meshforge demonstrate), or mend its result."
        )
    return "\n".join(lines)


def format_status(found: Status) -> str:
    """How far a project is signed off by its last review, and what is not, the least sure first."""
    waits = found.count(lambda asset: asset.sign_off == "sure")
    done = waits + found.count(lambda asset: asset.sign_off == "signed off")
    aside = found.count(lambda asset: asset.sign_off == "set aside")
    lines = [format_counts(done, len(found.assets), len(found.open_assets), aside, found.bar)]
    if waits:
        lines.append(f"  {waits} of them will be signed off when their outputs are up to date (meshforge apply)")
    for asset in found.open_assets[:MOST_HELD]:
        if asset.probability is None or asset.void:
            lines.append(f"  {asset.id}: {format_standing(asset)}")
        else:
            lines.append(f"  {format_asset(AssetConfidence(asset.id, asset.probability, asset.doubts))}")
    more = len(found.open_assets) - MOST_HELD
    return "\n".join([*lines, *([f"  and {more} more"] if more > 0 else [])])


def format_standing(asset: AssetStatus) -> str:
    """How one asset stands: how sure its result is, and whether it is signed off, and by whom."""
    if asset.sign_off == "void":
        return f"void, {join_names(asset.void)} changed since it was signed off"
    if asset.sign_off == "unknown":
        return "not looked at as it is now (meshforge review)"
    share = "" if asset.probability is None else f"{format_share(asset.probability)} sure, "
    if asset.sign_off == "sure":
        return f"{share}signed off when its output is up to date (meshforge apply)"
    who = {"tool": " by MeshForge", "person": " by a person", None: ""}[asset.signed_by]
    return f"{share}{asset.sign_off}{who}"


def format_asset(one: AssetConfidence) -> str:
    """One asset with its weightiest doubt."""
    doubt = f": {one.doubts[0].text}" if one.doubts else ""
    return f"{one.asset} ({format_share(one.probability)}){doubt}"


def format_share(share: float) -> str:
    """A probability in whole percent, rounded down, so that none below the bar looks as if it were at it."""
    return f"{int(share * 100)}%"


def format_question(question: ReviewQuestion, pictures: Sequence[Path]) -> str:
    """A question as it is asked, with its numbered choices, the hulls in question, and where its pictures lie."""
    lines = [f"{question.text}  [{question.id}, about {question.seconds:.0f} s]"]
    each = len(pictures) == len(question.choices) > 1
    for number, choice in enumerate(question.choices, 1):
        selected = "" if choice.select is None else f": {pluralize(len(choice.select), 'hull')}"
        selected += f", {join_names(choice.select)}" if choice.select else ""
        lines += [f"  {number} {choice.text}{selected}", *([f"    picture: {pictures[number - 1]}"] if each else [])]
    if len(question.hulls) > 1:
        lines.append("  hulls:")
        lines += [f"    {letter_of(k)} {hull.hull} of {hull.asset}" for k, hull in enumerate(question.hulls)]
    lines += [] if each else [f"  picture: {path}" for path in pictures]
    return "\n".join(lines)


def letter_of(place: int) -> str:
    """What the hull at a place is called where exceptions are typed: a, b, ..., z, aa, ab, ..."""
    return (letter_of(place // 26 - 1) if place >= 26 else "") + chr(ord("a") + place % 26)


def format_prompt(question: ReviewQuestion) -> str:
    """What can be typed."""
    count = len(question.choices)
    if not count:
        return "l later, q stop: "
    numbers = ", ".join(map(str, range(1, count + 1)))
    but = " (what is something else after it: 1 b=LABEL)" if len(question.hulls) > 1 else ""
    return f"{numbers}{but}, n for none, l later, q stop; Enter: 1: "


def format_reply_help(question: ReviewQuestion, folder: str) -> str:
    """How to reply where nobody can be asked; folder: of the project, as one types it."""
    if not question.choices:
        return f"Show it: meshforge demonstrate {folder} {shlex.quote(question.asset)} 'HULLS => ACTION' ..."
    entry = json.dumps([{"id": question.id, "choice": 0}])
    return (
        f"Reply in a terminal: meshforge review {folder}\n"
        f"  or in a script: meshforge review {folder} --answers FILE, where FILE holds {entry}\n"
        '  (the first choice; null in place of 0: none of them; "later": true puts it off)'
    )
