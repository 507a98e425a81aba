"""A person's time by the keystroke-level model (Card, Moran and Newell 1980); never measured, never mixed with what is.

K a key 0.28 s, P pointing 1.1 s, B a press or release 0.1 s, H between mouse and keys 0.4 s, M a thought 1.35 s.
"""

from __future__ import annotations

from benchmark.study.condition import SEEN
from benchmark.study.session import Session

KEY, POINT, PRESS, HOME, THINK = 0.28, 1.1, 0.1, 0.4, 1.35
_CLICK = POINT + 2 * PRESS
DEMONSTRATION = THINK + _CLICK
"""Opening a mesh and seeing what it is."""
HULL = _CLICK
"""Selecting a hull."""
RULE = THINK + _CLICK
"""Choosing what is done with a selection."""
ANSWER = 2 * THINK + _CLICK
"""Comparing pictures, and taking one."""
CONFIRMATION = THINK + _CLICK
LOOK = SEEN * THINK
"""A glance at each result of a sample."""
INSPECTION = THINK
"""Looking whether the label of one hull is right."""
LABEL = _CLICK + THINK + 2 * KEY + HOME
"""Selecting a hull and giving it another label by its key."""


def model_seconds(session: Session, rules: int) -> dict[str, float]:
    """Seconds by what they are spent on."""
    return {
        "demonstrating": len(session.shown) * (DEMONSTRATION + rules * RULE) + session.hulls_shown * HULL,
        "answering": session.answers * ANSWER,
        "confirming": (session.confirmed + session.refused) * CONFIRMATION + session.typed * LABEL,
        "looking at results": session.looked * LOOK,
    }
