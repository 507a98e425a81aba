"""Asking a server on loopback as the benchmark asks a model: what answers by turn, and how it is set up."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.endpoint import Endpoint
from meshforge.store import VlmSettings
from tests.loopback import Asked, Server, serving
from tests.loopback.server import KEY, MODEL

VARIABLE = "MESHFORGE_TEST_API_KEY"
PRICES = (2.0, 10.0)
_TOKEN, _PICTURE = 4, 800  # as the server counts


@pytest.fixture
def key(monkeypatch: pytest.MonkeyPatch) -> None:
    """The key, where an endpoint looks for it."""
    monkeypatch.setenv(VARIABLE, KEY)


@contextmanager
def asking(
    answer: Callable[[Asked], str], folder: Path | None = None, **how: object
) -> Iterator[tuple[Server, Client]]:
    """A server and a client of it."""
    with serving(answer, **how) as server:
        where = VlmSettings(base_url=server.base_url, model=MODEL, key_env=VARIABLE, retries=1)
        where = where.model_copy(update={"input_price": PRICES[0], "output_price": PRICES[1]})
        one = Client(Endpoint(where), folder)
        try:
            yield server, one
        finally:
            one.close()


def settings_file(server: Server, path: Path, more: str = "") -> Path:
    """A file with the table [vlm] for a server."""
    path.write_text(
        f'[vlm]\nbase_url = "{server.base_url}"\nmodel = "{MODEL}"\nkey_env = "{VARIABLE}"\nretries = 1\n'
        f"input_price = {PRICES[0]}\noutput_price = {PRICES[1]}\n{more}",
        "utf-8",
    )
    return path


def by_turn(*answers: str) -> Callable[[Asked], str]:
    """One answer after the other, by the turn of the conversation; the last one for good."""
    return lambda asked: answers[min(turn(asked), len(answers) - 1)]


def turn(asked: Asked) -> int:
    """How many answers were given before in the conversation."""
    return sum(message["role"] == "assistant" for message in asked.body["messages"])


def tokens_in(server: Server) -> int:
    """Of all questions but probes."""
    return sum(len(asked.text) // _TOKEN + _PICTURE * len(asked.pictures) for asked in server.answered)


def tokens_out(*answers: str) -> int:
    return sum(len(answer) // _TOKEN + 1 for answer in answers)


def cost(given: int, made: int) -> float:
    """What so many tokens cost [$]."""
    return (PRICES[0] * given + PRICES[1] * made) / 1e6


def block(text: str) -> str:
    """A text as models answer it."""
    return f"Here it is:\n\n```\n{text}\n```\nIt does as was shown."
