"""Where a model is asked: the address, the model, the place of the key, prices; and what can go wrong."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from ipaddress import ip_address
from typing import Any
from urllib.parse import urlsplit

from meshforge.common import MeshForgeError, UsageError
from meshforge.store import VlmSettings

OPENAI = "https://api.openai.com/v1"
_KEYS = {
    "api.openai.com": "OPENAI_API_KEY",
    "generativelanguage.googleapis.com": "GEMINI_API_KEY",
    "api.anthropic.com": "ANTHROPIC_API_KEY",
}
"""The environment variable of the key of each host that is known; no key is ever sent to another host unasked."""
_KEY_SUFFIX = "_API_KEY"
_MILLION = 1_000_000


class QuestionError(MeshForgeError):
    """A question that got no answer; others may get one."""


class RefusalError(QuestionError):
    """A question that the server does not take as it stands."""


class EndError(QuestionError):
    """No further question would get an answer: a wrong key, no such model, nobody there, no money left, or stopped."""


class TransientError(Exception):
    """A fault of one attempt, after which another one is worth it.

    after: what the server wants waited [s], None where it does not say; charged: whether the attempt may have been
    charged for all the same; unreachable: whether there was no server at all.
    """

    def __init__(
        self, problem: str, after: float | None = None, *, charged: bool = False, unreachable: bool = False
    ) -> None:
        super().__init__(problem)
        self.after = after
        self.charged = charged
        self.unreachable = unreachable


@dataclass(frozen=True, slots=True)
class Endpoint:
    """An OpenAI-compatible server and a model on it. Raises UsageError for values that do not fit.

    key_env: the environment variable that holds the key, empty for none; None takes that of a host that is known.
    input_price, output_price: in dollars a million tokens, None where they are not known.
    concurrency: questions under way at once; timeout [s] for one attempt; retries: further attempts after a fault that
    passes; wait [s]: before the first of them, doubled each time.
    extra: further fields of every request, for what a server wants besides.
    """

    base_url: str = OPENAI
    model: str = ""
    key_env: str | None = None
    input_price: float | None = None
    output_price: float | None = None
    concurrency: int = 4
    timeout: float = 120.0
    retries: int = 5
    wait: float = 1.0
    extra: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        parts = urlsplit(self.base_url)
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise UsageError(f"{self.base_url!r} is no address", remedy=f"Give it like {OPENAI}.")
        if parts.username or parts.password or parts.query:
            remedy = "Put the key into an environment variable, and name that as key_env."
            raise UsageError("a base_url holds no key, name or query", where=self.place, remedy=remedy)
        if self.key_name and not self.key_name.endswith(_KEY_SUFFIX):
            remedy = f"Name a variable that ends in {_KEY_SUFFIX}: no other one is ever sent."
            raise UsageError(f"key_env names {self.key_name}", where=self.place, remedy=remedy)
        if self.key_name and parts.scheme == "http" and not self.is_loopback:
            problem = f"the key in {self.key_name} would be sent where others can read it"
            raise UsageError(problem, where=self.place, remedy='Give an https address, or key_env = "" for no key.')
        if not self.model:
            raise UsageError("no model is named", where=self.place, remedy="Name one: --model NAME, or model in [vlm].")

    @property
    def host(self) -> str:
        """The name of the machine, with the port where one is given."""
        parts = urlsplit(self.base_url)
        return f"{parts.hostname}:{parts.port}" if parts.port else parts.hostname or ""

    @property
    def is_loopback(self) -> bool:
        """Whether the host is this machine."""
        name = urlsplit(self.base_url).hostname or ""
        try:
            return name == "localhost" or ip_address(name).is_loopback
        except ValueError:
            return False

    @property
    def place(self) -> str:
        """The address without anything secret."""
        parts = urlsplit(self.base_url)
        return f"{parts.scheme}://{self.host}{parts.path.rstrip('/')}"

    @property
    def key_name(self) -> str:
        """The environment variable of the key, empty where the server wants none."""
        return _KEYS.get(urlsplit(self.base_url).hostname or "", "") if self.key_env is None else self.key_env

    def key(self) -> str:
        """The key, empty where the server wants none. Raises UsageError where its variable is not set."""
        name = self.key_name
        key = os.environ.get(name, "").strip() if name else ""
        if name and not key:
            remedy = f'Set it: export {name}=...; for a server that wants no key write key_env = "" in [vlm].'
            raise UsageError(f"the environment variable {name}, which holds the key, is not set", remedy=remedy)
        return key

    @property
    def has_key(self) -> bool:
        """Whether the key is there, or none is wanted."""
        return not self.key_name or bool(os.environ.get(self.key_name, "").strip())

    @property
    def is_priced(self) -> bool:
        return self.input_price is not None and self.output_price is not None

    def price(self, usage: TokenCount) -> float:
        """What so many tokens cost, in dollars; a price that is not known counts as none."""
        return ((self.input_price or 0) * usage.input + (self.output_price or 0) * usage.output) / _MILLION


def endpoint_of(settings: VlmSettings) -> Endpoint:
    """The endpoint that the table [vlm] names. Raises UsageError: no address, or no model named."""
    return Endpoint(**{field.name: getattr(settings, field.name) for field in fields(Endpoint)})


@dataclass(frozen=True, slots=True)
class TokenCount:
    """Tokens that went in and came out; estimated: the server named no number."""

    input: int = 0
    output: int = 0
    estimated: bool = False

    def __add__(self, other: TokenCount) -> TokenCount:
        return TokenCount(self.input + other.input, self.output + other.output, self.estimated or other.estimated)
