"""One attempt to get an answer, through the OpenAI SDK; what goes wrong becomes one of our faults."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Mapping
from email.utils import parsedate_to_datetime
from typing import TYPE_CHECKING, Any

from meshforge.errors import UsageError
from meshforge.perception.vlm.endpoint import Endpoint
from meshforge.perception.vlm.faults import EndError, PassingError, RefusedError
from meshforge.perception.vlm.reply import NoReplyError, Reply, read_reply

if TYPE_CHECKING:
    from openai import APIConnectionError, APIStatusError, OpenAI

_PASSING = frozenset({408, 409, 425, 429})
_NO_MONEY = ("insufficient_quota", "billing_hard_limit", "billing_not_active", "credit balance", "insufficient balance")
_LONG = 400  # characters of a server's complaint that are shown
_NO_KEY = "none"  # the SDK wants one even where the server does not


class Transport:
    """The connection to a server. Safe to use from several threads."""

    def __init__(self, endpoint: Endpoint) -> None:
        self._endpoint = endpoint
        self._key = ""
        self._lock = threading.Lock()
        self._made: OpenAI | None = None

    def send(self, body: Mapping[str, Any]) -> Reply:
        """Ask once. Raises PassingError, RefusedError or EndError; NoReplyError where something else came back."""
        client = self._client()
        import openai

        try:
            text = client.post("/chat/completions", cast_to=str, body=dict(body))
        except openai.APITimeoutError as error:
            seconds = f"{self._endpoint.timeout:g}"
            raise PassingError(f"no answer within {seconds} seconds", charged=True) from error
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
            if self._made:
                self._made.close()
            self._made = None

    def _client(self) -> OpenAI:
        with self._lock:
            if self._made is None:
                try:
                    self._key = self._endpoint.key()
                except UsageError as error:
                    raise EndError(error.problem, where=error.where, remedy=error.remedy) from error
                self._made = _client(self._endpoint, self._key)
            return self._made

    def _to_transient_error(self, error: APIConnectionError) -> PassingError:
        """A connection that never was, or that broke before the answer was there."""
        cause = error.__cause__
        unreachable = type(cause).__name__ in ("ConnectError", "UnsupportedProtocol")
        why = self._redact(str(cause)) if cause and str(cause) else "the connection broke"
        return PassingError(why, charged=not unreachable, unreachable=unreachable)

    def _to_error(self, error: APIStatusError) -> Exception:
        status, said = error.status_code, self._redact(_said(error))
        where = self._endpoint.place
        if status == 402 or (status in (400, 403, 429) and any(word in said.lower() for word in _NO_MONEY)):
            return EndError(f"the account has no money left: {said}", where=where)
        if status in _PASSING or status >= 500:
            return PassingError(f"{status}: {said}", _wait(error))
        if status == 403 and "logprobs" in said.lower():  # not the key, but that field is not allowed
            return RefusedError(f"the server refused the question ({status}): {said}", where=where)
        if status in (401, 403) or (status == 400 and "api key" in said.lower()):
            name = self._endpoint.key_name
            remedy = (
                f"The key is what the environment variable {name} holds." if name else "Name its key: key_env in [vlm]."
            )
            return EndError(f"the server does not accept the key: {said}", where=where, remedy=remedy)
        if status == 404:
            remedy = "Look at base_url and model; a base_url mostly ends with /v1."
            return EndError(f"there is no model {self._endpoint.model!r} here: {said}", where=where, remedy=remedy)
        return RefusedError(f"the server refused the question ({status}): {said}", where=where)

    def _redact(self, text: str) -> str:
        """A text of the server's without the key, should it repeat that."""
        return text.replace(self._key, "...") if self._key else text


def _client(endpoint: Endpoint, key: str) -> OpenAI:
    try:
        from openai import OpenAI
    except ImportError as error:
        remedy = "Install it: pip install 'meshforge[vlm]'."
        raise EndError("asking a model needs the package openai, which is not installed", remedy=remedy) from error
    return OpenAI(base_url=endpoint.base_url, api_key=key or _NO_KEY, timeout=endpoint.timeout, max_retries=0)


def _said(error: APIStatusError) -> str:
    """The server's own words, in one line."""
    found = _message(error.body)
    words = " ".join((found or str(error.body or error.message)).split())
    return words if len(words) <= _LONG else f"{words[:_LONG]} ..."


def _message(body: object) -> str | None:
    match body:
        case {"message": str(text)} | {"detail": str(text)} | {"error": str(text)}:
            kind = body.get("code") or body.get("type") if isinstance(body, dict) else None
            return f"{text} ({kind})" if isinstance(kind, str) and kind not in text else text
        case {"error": dict(inner)}:
            return _message(inner)
        case [first, *_]:
            return _message(first)
    return None


def _wait(error: APIStatusError) -> float | None:
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
