"""Versions of SDF, and what changed its meaning from one to the next."""

from __future__ import annotations

import re

Version = tuple[int, int]
OLDEST: Version = (1, 2)
"""The first with elements as they are now; 1.0 had attributes."""
NEWEST: Version = (1, 12)
AXIS_IN_JOINT: Version = (1, 5)
"""From here on the axis of a joint is told in the joint's frame, not in the model's."""
RELATIVE: Version = (1, 7)
"""From here on `relative_to` counts; before, `frame` said the same, and few readers took notice of it."""
ROUND: Version = (1, 8)
"""From here on there are capsules and ellipsoids."""

_VERSION = re.compile(r"\s*(\d{1,4})\.(\d{1,4})\s*")


def version_of(text: str) -> Version | None:
    """The version that a text tells, None where it tells none."""
    found = _VERSION.fullmatch(text)
    return (int(found[1]), int(found[2])) if found else None
