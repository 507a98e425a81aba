"""A client of the loopback server, and a small question, for tests."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.endpoint import Endpoint
from meshforge.labels.vlm.question import Message, VlmQuestion, make_object_schema
from meshforge.store import VlmSettings
from tests.loopback import KEY, Server

VARIABLE = "MESHFORGE_TEST_API_KEY"
SCHEMA = make_object_schema(word={"type": "string"})
_OPEN: list[Client] = []


def client(
    server: Server, folder: Path | None = None, *, max_cost: float | None = None, stop: Any = None, **how: Any
) -> Client:
    """A client that does not wait long; how: fields of its settings."""
    told: dict[str, Any] = {"model": server.model, "key_env": VARIABLE, "timeout": 5.0, "retries": 4} | how
    endpoint = Endpoint(VlmSettings(base_url=server.base_url, **told))
    _OPEN.append(Client(endpoint, folder, max_cost=max_cost, stop=stop or (lambda: False)))
    return _OPEN[-1]


def endpoint(address: str, key: str | None = "") -> Endpoint:
    return Endpoint(VlmSettings(base_url=address, model="m", key_env=key))


def question(text: str = "Say a word.", *pictures: bytes, **how: Any) -> VlmQuestion:
    return VlmQuestion((Message("system", ("Be brief.",)), Message("user", (text, *pictures))), **how)


@pytest.fixture
def key(monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """The right key, in its environment variable; in the end all clients are closed."""
    monkeypatch.setenv(VARIABLE, KEY)
    yield KEY
    while _OPEN:
        _OPEN.pop().close()
