"""One attempt to get an answer through the OpenAI SDK, and the answer parsed leniently from what the server sent."""

from __future__ import annotations

import json
import math
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass
from email.utils import parsedate_to_datetime
from typing import TYPE_CHECKING, Any

from meshforge.common import UsageError
from meshforge.labels.vlm.endpoint import EndError, Endpoint, RefusalError, TokenCount, TransientError

if TYPE_CHECKING:
    from openai import APIConnectionError, APIStatusError, OpenAI


_TRANSIENT = frozenset({408, 409, 425, 429})
_NO_MONEY = ("insufficient_quota", "billing_hard_limit", "billing_not_active", "credit balance", "insufficient balance")
_LONG = 400  # characters of a server's complaint that are shown
_NO_KEY = "none"  # the SDK wants one even where the server does not


@dataclass(frozen=True, slots=True)
class Token:
    """A token of an answer with its chance, and the chances of those that were likeliest in its place."""

    text: bytes
    chance: float
    others: Mapping[bytes, float]


@dataclass(frozen=True, slots=True)
class Reply:
    """An answer. finish: why it ends, `stop` or `length` mostly; usage: None where the server names none.

    tokens: None where the server gives no log-probabilities; cost: what it cost when it was given [$]; cached: that was
    earlier, and this time it cost nothing.
    """

    text: str
    finish: str = "stop"
    usage: TokenCount | None = None
    tokens: tuple[Token, ...] | None = None
    cost: float = 0.0
    cached: bool = False

    @property
    def is_cut(self) -> bool:
        """Whether the answer ends where its room ended."""
        return self.finish == "length"


class NoReplyError(ValueError):
    """Something came back that is no answer. usage: what it cost all the same, where that is known."""

    def __init__(self, problem: str, usage: TokenCount | None = None) -> None:
        super().__init__(problem)
        self.usage = usage


def read_reply(data: Any) -> Reply:
    """The answer in a response of `chat/completions`. Raises NoReplyError."""
    usage = _parse_usage(data.get("usage")) if isinstance(data, Mapping) else None
    match data:
        case {"choices": [{"message": {**message}, **choice}, *_]}:
            finish = choice.get("finish_reason")
            tokens = _parse_tokens(choice.get("logprobs"))
            # half a surrogate pair cannot be written to a file
            text = _message_text(message).encode(errors="replace").decode()
            return Reply(text, finish if isinstance(finish, str) else "stop", usage, tokens)
    raise NoReplyError("the server sent something that is no answer", usage)


def _message_text(message: Mapping[Any, Any]) -> str:
    """The text of a message; some servers send it in parts, and a refusal in a field of its own."""
    match message.get("content"):
        case str(text) if text:
            return text
        case [*parts]:
            return "".join(
                part["text"] for part in parts if isinstance(part, dict) and isinstance(part.get("text"), str)
            )
    refusal = message.get("refusal")
    return refusal if isinstance(refusal, str) else ""


def _parse_usage(data: Any) -> TokenCount | None:
    match data:
        case {"prompt_tokens": int(given), "completion_tokens": int(made)} if given >= 0 and made >= 0:
            return TokenCount(given, made)
        case {"prompt_tokens": int(given), "total_tokens": int(total)} if 0 <= given <= total:
            return TokenCount(given, total - given)
    return None


def _parse_tokens(data: Any) -> tuple[Token, ...] | None:
    """The tokens with their chances, None where there are none or one is not of the usual form."""
    match data:
        case {"content": [_, *_] as rows}:
            tokens = tuple(token for row in rows if (token := _parse_token(row)))
            return tokens if len(tokens) == len(rows) else None
    return None


def _parse_token(row: Any) -> Token | None:
    match row:
        case {"token": str(), "logprob": float() | int() as logprob}:
            top = row.get("top_logprobs")
            others = [_parse_token({**other, "top_logprobs": None}) for other in top or () if isinstance(other, dict)]
            chance = 0.0 if math.isnan(logprob) else math.exp(min(logprob, 0.0))
            return Token(_token_bytes(row), chance, {other.text: other.chance for other in others if other})
    return None


def _token_bytes(row: Mapping[Any, Any]) -> bytes:
    raw = row.get("bytes")
    if isinstance(raw, list) and raw and all(isinstance(b, int) and 0 <= b < 256 for b in raw):
        return bytes(raw)
    return str(row["token"]).encode("utf-8", "surrogatepass")


class Transport:
    """The connection to a server. Safe to use from several threads."""

    def __init__(self, endpoint: Endpoint) -> None:
        self._endpoint = endpoint
        self._key = ""
        self._lock = threading.Lock()
        self._sdk: OpenAI | None = None

    def send(self, body: Mapping[str, Any]) -> Reply:
        """Ask once. Raises TransientError, RefusalError or EndError; NoReplyError where something else came back."""
        client = self._client()
        import openai  # lazy: 0.5 s, and an extra: only asking a model needs it

        try:
            text = client.post("/chat/completions", cast_to=str, body=dict(body))
        except openai.APITimeoutError as error:
            raise TransientError(f"no answer within {self._endpoint.timeout:g} seconds", charged=True) from error
        except openai.APIConnectionError as error:
            raise self._to_transient_error(error) from error
        except openai.APIStatusError as error:
            raise self._to_error(error) from error
        try:
            data = json.loads(text)
        except ValueError as error:
            raise NoReplyError("the server sent something that is no JSON") from error
        return read_reply(data)

    def close(self) -> None:
        """Close the connections; the transport can be used on."""
        with self._lock:
            if self._sdk:
                self._sdk.close()
            self._sdk = None

    def _client(self) -> OpenAI:
        with self._lock:
            if self._sdk is None:
                try:
                    self._key = self._endpoint.key()
                except UsageError as error:
                    raise EndError(error.problem, where=error.where, remedy=error.remedy) from error
                self._sdk = _make_client(self._endpoint, self._key)
            return self._sdk

    def _to_transient_error(self, error: APIConnectionError) -> TransientError:
        """A connection that never was, or that broke before the answer was there."""
        cause = error.__cause__
        unreachable = type(cause).__name__ in ("ConnectError", "UnsupportedProtocol")
        why = self._redact(str(cause)) if cause and str(cause) else "the connection broke"
        return TransientError(why, charged=not unreachable, unreachable=unreachable)

    def _to_error(self, error: APIStatusError) -> Exception:
        status, said = error.status_code, self._redact(_error_text(error))
        where = self._endpoint.place
        if status == 402 or (status in (400, 403, 429) and any(word in said.lower() for word in _NO_MONEY)):
            return EndError(f"the account has no money left: {said}", where=where)
        if status in _TRANSIENT or status >= 500:
            return TransientError(f"{status}: {said}", _retry_after(error))
        if status == 403 and "logprobs" in said.lower():  # not the key, but that field is not allowed
            return RefusalError(f"the server refused the question ({status}): {said}", where=where)
        if status in (401, 403) or (status == 400 and "api key" in said.lower()):
            name = self._endpoint.key_name
            held = f"The key is what the environment variable {name} holds."
            remedy = held if name else "Name its key: key_env in [vlm]."
            return EndError(f"the server does not accept the key: {said}", where=where, remedy=remedy)
        if status == 404:
            remedy = "Look at base_url and model; a base_url mostly ends with /v1."
            return EndError(f"there is no model {self._endpoint.model!r} here: {said}", where=where, remedy=remedy)
        return RefusalError(f"the server refused the question ({status}): {said}", where=where)

    def _redact(self, text: str) -> str:
        return text.replace(self._key, "...") if self._key else text


def _make_client(endpoint: Endpoint, key: str) -> OpenAI:
    try:
        from openai import OpenAI  # lazy: 0.5 s, and an extra: only asking a model needs it
    except ImportError as error:
        remedy = "Install it: pip install 'meshforge[vlm]'."
        raise EndError("asking a model needs the package openai, which is not installed", remedy=remedy) from error
    sdk = OpenAI(base_url=endpoint.base_url, api_key=key or _NO_KEY, timeout=endpoint.timeout, max_retries=0)
    sdk._client.follow_redirects = False  # nobody approved the host that a redirect names
    return sdk


def _error_text(error: APIStatusError) -> str:
    words = " ".join((_error_message(error.body) or str(error.body or error.message)).split())
    return words if len(words) <= _LONG else f"{words[:_LONG]} ..."


def _error_message(body: object) -> str | None:
    match body:
        case {"message": str(text)} | {"detail": str(text)} | {"error": str(text)}:
            kind = body.get("code") or body.get("type") if isinstance(body, dict) else None
            return f"{text} ({kind})" if isinstance(kind, str) and kind not in text else text
        case {"error": dict(inner)}:
            return _error_message(inner)
        case [first, *_]:
            return _error_message(first)
    return None


def _retry_after(error: APIStatusError) -> float | None:
    """How long the server wants to be left alone [s], None where it does not say."""
    headers = error.response.headers
    for name, unit in (("retry-after-ms", 0.001), ("retry-after", 1.0)):
        try:
            return max(0.0, float(headers[name]) * unit)
        except (KeyError, ValueError):
            continue
    try:
        return max(0.0, parsedate_to_datetime(headers.get("retry-after", "")).timestamp() - time.time())
    except (TypeError, ValueError):
        return None
