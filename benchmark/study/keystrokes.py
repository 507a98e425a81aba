"""A person's time by the keystroke-level model (Card, Moran and Newell 1980); never measured, never mixed with what is.

K a key 0.28 s, P pointing 1.1 s, B a press or release 0.1 s, H between mouse and keys 0.4 s, M a thought 1.35 s.
Two prices: by the mouse, each hull by itself; and by keys, as the studio has it, with look-alikes, one hand at the
mouse and the other at the keys, so that H is never paid.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from benchmark.study.session import Session

KEY, POINT, PRESS, HOME, THINK = 0.28, 1.1, 0.1, 0.4, 1.35
CLICK = POINT + 2 * PRESS
DEMONSTRATION = THINK + CLICK
"""Opening a mesh and seeing what it is."""
HULL = CLICK
"""Selecting a hull."""
RULE = THINK + CLICK
"""Choosing what is done with a selection."""
ANSWER = 2 * THINK + CLICK
"""Comparing pictures, and taking one."""
CONFIRMATION = THINK + CLICK
"""Yes or no; also taking something back."""
GLANCE = THINK
"""A look at one result."""
APPROVAL = CLICK
"""Reporting a result that was looked at as right."""
INSPECTION = THINK
"""Looking whether the label of one hull is right."""
STROKE, PAINT = KEY, CLICK
"""Labels are painted: the key of a label, then a click a hull."""
GROUP_HULL = 0.5
"""A look at one more hull of a group of look-alikes."""

PRICES = {
    "opening a mesh to demonstrate": DEMONSTRATION,
    "a step of an edit": RULE,
    "selecting a hull": HULL,
    "an answer between pictures": ANSWER,
    "yes or no to a correction; taking something back": CONFIRMATION,
    "a look at a result": GLANCE,
    "reporting it as right": APPROVAL,
    "looking whether a label is right": INSPECTION,
    "painting a label: the key, and each hull": STROKE + PAINT,
    "a group of ten look-alike hulls, confirmed": THINK + 10 * GROUP_HULL + CLICK,
}
"""Seconds, as the page lists them."""


def price_group(hulls: int, exceptions: int = 0) -> float:
    """Seconds for a group of look-alike hulls that is shown and confirmed, but for some that are clicked."""
    return THINK + GROUP_HULL * hulls + CLICK * (1 + exceptions)


BY_KEYS = {
    "an answer between pictures: its digit": 2 * THINK + KEY,
    "yes or no to a correction; taking something back: a letter": THINK + KEY,
    "a look at a result, and reporting it as right: a letter": GLANCE + KEY,
    "a group of ten look-alike hulls, confirmed: a letter": THINK + 10 * GROUP_HULL + KEY,
    "selecting: a click on one hull, the key for its look-alikes, a look at each of them": CLICK + KEY,
    "… a click on each that is not meant, or one that leaves them all": CLICK,
    "painting a label: selecting its hulls, and the key of the label": STROKE,
    "looking whether labels are right, a label: a click that selects its hulls, and a look at each": THINK + CLICK,
}
"""Seconds of the acts that keys or look-alikes make shorter; the other prices stay."""


def price_group_by_keys(hulls: int, exceptions: int = 0) -> float:
    """Seconds for a group of look-alike hulls that is confirmed by a letter, but for some that are clicked."""
    return THINK + GROUP_HULL * hulls + CLICK * exceptions + KEY


def price_selection(wanted: Iterable[str], alike: Callable[[str], frozenset[str]]) -> float:
    """Seconds to select hulls of one mesh by keys. alike: the look-alikes of a hull, itself included.

    While any is left a person clicks one of them, and while more are left presses the key that adds its look-alikes;
    where most of these are wrong, one click leaves them all.
    """
    meant, seconds = frozenset(wanted), 0.0
    left = sorted(meant)
    while left:
        taken, seconds = {left[0]}, seconds + CLICK
        if len(left) > 1:
            found = alike(left[0])
            more, wrong = found.intersection(left[1:]), found - meant
            seconds += KEY + GROUP_HULL * len(more | wrong) + CLICK * (len(wrong) if len(wrong) <= len(more) else 1)
            if len(wrong) <= len(more):
                taken |= more
        left = [hull for hull in left if hull not in taken]
    return seconds


def model_seconds(session: Session) -> dict[str, float]:
    """Seconds by what they are spent on."""
    return {
        "demonstrating": len(session.shown) * DEMONSTRATION + session.steps_shown * RULE + session.hulls_shown * HULL,
        "labelling": session.inspected * INSPECTION + session.strokes * STROKE + session.typed * PAINT,
        "answering": session.answers * ANSWER,
        "confirming": (session.confirmed + session.refused + session.taken_back + session.set_aside) * CONFIRMATION,
        "looking": session.glances * GLANCE,
        "approving": session.approvals * APPROVAL,
    }


def count_acts(session: Session) -> int:
    """All that a person did, one by one: meshes opened, steps, hulls, labels, answers, confirmations, looks, approvals;
    not the labels that were only looked at."""
    done = len(session.shown) + session.steps_shown + session.hulls_shown + session.typed + session.strokes
    said = session.answers + session.confirmed + session.refused + session.taken_back + session.set_aside
    return done + said + session.glances + session.approvals
