"""One attempt to get an answer through the OpenAI SDK, and the answer parsed leniently from what the server sent."""

from __future__ import annotations

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
    """A token of an answer with its chance."""

    text: bytes
    chance: float


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


def read_reply(data: object) -> Reply:
    """The answer in what the SDK made of a response, which it does not verify. Raises NoReplyError."""
    found: Any = data
    usage = _read_usage(getattr(found, "usage", None))
    try:
        choice = found.choices[0]
        text = _read_text(choice.message)
    except (AttributeError, IndexError, KeyError, TypeError) as error:
        what = "no JSON" if isinstance(data, str) else "no answer"
        raise NoReplyError(f"the server sent something that is {what}", usage) from error
    finish = choice.finish_reason if isinstance(choice.finish_reason, str) else "stop"
    return Reply(text.encode(errors="replace").decode(), finish, usage, _read_tokens(choice))


def _read_text(message: Any) -> str:
    """The text of a message; some servers send it in parts, and a refusal in a field of its own."""
    content = message.content or message.refusal or ""
    return content if isinstance(content, str) else "".join(part["text"] for part in content if "text" in part)


def _read_usage(usage: Any) -> TokenCount | None:
    try:
        given, made = usage.prompt_tokens, usage.completion_tokens
        made = usage.total_tokens - given if made is None else made
        return TokenCount(given, made) if min(given, made) >= 0 else None
    except (AttributeError, TypeError):
        return None


def _read_tokens(choice: Any) -> tuple[Token, ...] | None:
    """The tokens with their chances, None where there are none or one is not of the usual form."""
    try:
        tokens = tuple(
            Token(bytes(row.bytes or row.token.encode(errors="surrogatepass")), math.exp(min(row.logprob, 0.0)))
            for row in choice.logprobs.content
        )
    except (AttributeError, TypeError, ValueError):
        return None
    return tokens or None


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
        from openai.types.chat import ChatCompletion  # lazy: as openai

        try:
            found: Any = client.post("/chat/completions", cast_to=ChatCompletion, body=dict(body))
        except openai.APITimeoutError as error:
            raise TransientError(f"no answer within {self._endpoint.timeout:g} seconds", charged=True) from error
        except openai.APIConnectionError as error:
            raise self._to_transient_error(error) from error
        except openai.APIStatusError as error:
            raise self._to_error(error) from error
        except ValueError as error:
            raise NoReplyError("the server sent something that is no JSON") from error
        return read_reply(found)

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
        status, answer_text = error.status_code, self._redact(_error_text(error))
        where = self._endpoint.place
        if status == 402 or (status in (400, 403, 429) and any(word in answer_text.lower() for word in _NO_MONEY)):
            return EndError(f"the account has no money left: {answer_text}", where=where)
        if status in _TRANSIENT or status >= 500:
            return TransientError(f"{status}: {answer_text}", _retry_after(error))
        if status == 403 and "logprobs" in answer_text.lower():  # not the key, but that field is not allowed
            return RefusalError(f"the server refused the question ({status}): {answer_text}", where=where)
        if status in (401, 403) or (status == 400 and "api key" in answer_text.lower()):
            name = self._endpoint.key_name
            holder = f"The key is what the environment variable {name} holds."
            remedy = holder if name else "Name its key: key_env in [vlm]."
            return EndError(f"the server does not accept the key: {answer_text}", where=where, remedy=remedy)
        if status == 404:
            remedy = "Look at base_url and model; a base_url mostly ends with /v1."
            return EndError(
                f"there is no model {self._endpoint.model!r} here: {answer_text}", where=where, remedy=remedy
            )
        return RefusalError(f"the server refused the question ({status}): {answer_text}", where=where)

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
    text = error.response.headers.get("retry-after", "")
    try:
        wait = float(text) if text.strip()[:1].isdigit() else parsedate_to_datetime(text).timestamp() - time.time()
    except (TypeError, ValueError):
        return None
    return max(0.0, wait)
