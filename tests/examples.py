"""How many examples a law tries."""

from __future__ import annotations

from typing import Any

from hypothesis import settings


def examples(count: int, **more: Any) -> settings:
    """Return settings for a law that tries a fifth of `count` examples, and twice as many where they are new ones.

    more: other settings of hypothesis. By default there is no deadline, see `tests/slow_tests.py`.
    """
    return settings(max_examples=-(-count * settings().max_examples // 100), **more)
