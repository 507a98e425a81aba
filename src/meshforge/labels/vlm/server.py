"""One attempt to get an answer from a server through the OpenAI SDK, and what goes wrong with one."""

from __future__ import annotations

import threading
import time
from collections.abc import Mapping
from email.utils import parsedate_to_datetime
from typing import TYPE_CHECKING, Any

from meshforge.common import UsageError
from meshforge.labels.vlm.endpoint import EndError, Endpoint, RefusalError, TokenCount
from meshforge.labels.vlm.question import Reply

if TYPE_CHECKING:
    from openai import APIConnectionError, APIStatusError, OpenAI

_TRANSIENT = frozenset({408, 409, 425, 429})
_NO_MONEY = ("insufficient_quota", "billing_hard_limit", "billing_not_active", "credit balance", "insufficient balance")
_LONG = 400  # characters of a server's complaint that are shown
_NO_KEY = "none"  # the SDK wants one even where the server does not


class TransientError(Exception):
    """A fault of one attempt, after which another one is worth it.

    after: what the server wants waited [s], None where it does not say; charged: whether the attempt may have been
    charged for all the same, and usage: what it cost, where that is known; unreachable: whether there was no server.
    """

    def __init__(
        self,
        problem: str,
        *,
        after: float | None = None,
        charged: bool = False,
        usage: TokenCount | None = None,
        unreachable: bool = False,
    ) -> None:
        super().__init__(problem)
        self.after, self.charged, self.usage, self.unreachable = after, charged, usage, unreachable


class Server:
    """The connection to a server. Safe to use from several threads."""

    def __init__(self, endpoint: Endpoint) -> None:
        self._endpoint, self._model = endpoint, endpoint.settings.model
        self._key = ""
        self._lock = threading.Lock()
        self._sdk: OpenAI | None = None

    def send(self, body: Mapping[str, Any]) -> Reply:
        """Ask once. Raises TransientError, RefusalError or EndError."""
        sdk = self._connect()
        import openai  # lazy: 0.5 s, and an extra: only asking a model needs it
        from openai.types.chat import ChatCompletion  # lazy: as openai

        try:  # nobody approved the host that a redirect names
            found = sdk.post(
                "/chat/completions", cast_to=ChatCompletion, body=dict(body), options={"follow_redirects": False}
            )
        except openai.APITimeoutError as error:
            problem = f"no answer within {self._endpoint.settings.timeout:g} seconds"
            raise TransientError(problem, charged=True) from error
        except openai.APIConnectionError as error:
            raise self._to_transient_error(error) from error
        except openai.APIStatusError as error:
            raise self._to_error(error) from error
        except ValueError as error:
            raise TransientError("the server sent something that is no JSON", charged=True) from error
        return read_reply(found)

    def close(self) -> None:
        """Close the connections; the server can be asked on."""
        with self._lock:
            if self._sdk:
                self._sdk.close()
            self._sdk = None

    def _connect(self) -> OpenAI:
        """The SDK's client, without its retries: which of these were charged for it does not say."""
        try:
            from openai import OpenAI  # lazy: 0.5 s, and an extra: only asking a model needs it
        except ImportError as error:
            remedy = "Install it: pip install 'meshforge[vlm]'."
            raise EndError("asking a model needs the package openai, which is not installed", remedy=remedy) from error
        settings = self._endpoint.settings
        with self._lock:
            if self._sdk is None:
                try:
                    self._key = self._endpoint.key()
                except UsageError as error:
                    raise EndError(error.problem, where=error.where, remedy=error.remedy) from error
                key = self._key or _NO_KEY
                self._sdk = OpenAI(base_url=settings.base_url, api_key=key, timeout=settings.timeout, max_retries=0)
            return self._sdk

    def _to_transient_error(self, error: APIConnectionError) -> TransientError:
        """A connection that never was, or that broke before the answer was there."""
        cause = error.__cause__
        unreachable = type(cause).__name__ in ("ConnectError", "UnsupportedProtocol")
        why = self._redact(str(cause)) if cause and str(cause) else "the connection broke"
        return TransientError(why, charged=not unreachable, unreachable=unreachable)

    def _to_error(self, error: APIStatusError) -> Exception:
        status, text = error.status_code, self._redact(_error_text(error))
        where, complaint = self._endpoint.place, text.lower()
        if status == 402 or (status in (400, 403, 429) and any(word in complaint for word in _NO_MONEY)):
            return EndError(f"the account has no money left: {text}", where=where)
        if status in _TRANSIENT or status >= 500:
            return TransientError(f"{status}: {text}", after=_retry_after(error))
        if status in (401, 403) or (status == 400 and "api key" in complaint):
            name = self._endpoint.key_name
            reserved = f"The key is what the environment variable {name} holds."
            remedy = reserved if name else "Name its key: key_env in [vlm]."
            return EndError(f"the server does not accept the key: {text}", where=where, remedy=remedy)
        if status == 404:
            remedy = "Look at base_url and model; a base_url mostly ends with /v1."
            return EndError(f"there is no model {self._model!r} here: {text}", where=where, remedy=remedy)
        return RefusalError(f"the server refused the question ({status}): {text}", where=where)

    def _redact(self, text: str) -> str:
        return text.replace(self._key, "...") if self._key else text


def read_reply(data: object) -> Reply:
    """Return the answer in what the SDK made of a response, which it does not verify. Raises TransientError."""
    found: Any = data
    usage = _read_usage(getattr(found, "usage", None))
    try:
        choice = found.choices[0]
        text = choice.message.content or choice.message.refusal or ""
        text = text if isinstance(text, str) else "".join(part["text"] for part in text if "text" in part)
    except (AttributeError, IndexError, KeyError, TypeError) as error:
        what = "no JSON" if isinstance(data, str) else "no answer"
        raise TransientError(f"the server sent something that is {what}", charged=True, usage=usage) from error
    finish = choice.finish_reason if isinstance(choice.finish_reason, str) else "stop"
    return Reply(text.encode(errors="replace").decode(), finish, usage)


def _read_usage(usage: Any) -> TokenCount | None:
    try:
        given, made = usage.prompt_tokens, usage.completion_tokens
        made = usage.total_tokens - given if made is None else made
        return TokenCount(given, made) if min(given, made) >= 0 else None
    except (AttributeError, TypeError):
        return None


def _error_text(error: APIStatusError) -> str:
    """What the server complains about, in one line: `message`, `detail` or `error`, however deep, with its code."""
    body: Any = error.body
    while isinstance(body, (list, dict)) and body:
        text = body[0] if isinstance(body, list) else body.get("message") or body.get("detail") or body.get("error")
        kind = body.get("code") or body.get("type") if isinstance(body, dict) else None
        if isinstance(kind, str) and isinstance(text, str) and kind not in text:
            text = f"{text} ({kind})"
        body = text
    words = " ".join(str(body or error.message).split())
    return words if len(words) <= _LONG else f"{words[:_LONG]} ..."


def _retry_after(error: APIStatusError) -> float | None:
    """How long the server wants to be left alone [s], None where it does not say."""
    text = error.response.headers.get("retry-after", "")
    try:
        wait = float(text) if text.strip()[:1].isdigit() else parsedate_to_datetime(text).timestamp() - time.time()
    except (TypeError, ValueError):
        return None
    return max(0.0, wait)
