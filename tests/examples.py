"""How many examples a law tries."""

from __future__ import annotations

from typing import Any

from hypothesis import settings

from tests.slow_tests import ALL_EXAMPLES


def examples(count: int, **more: Any) -> settings:
    """Settings for a law that tries `count` examples where all tests are run, and a fifth of them in a quick run.

    more: other settings of hypothesis. By default there is no deadline, see `tests/slow_tests.py`.
    """
    return settings(max_examples=-(-count * settings().max_examples // ALL_EXAMPLES), **more)
