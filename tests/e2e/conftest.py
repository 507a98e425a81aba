"""What all tests of the studio in a browser share."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser

from tests.e2e.hand import chromium


@pytest.fixture(scope="package")
def browser() -> Iterator[Browser]:
    """One browser for all tests here; `windows` closes what a test opens in it."""
    with chromium() as running:
        yield running
