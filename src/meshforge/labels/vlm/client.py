"""The client: a question in, an answer out, from the disk where it is there, and else from the server; the OpenAI SDK
waits, times out, and tries again after faults that pass."""

from __future__ import annotations

import threading
from collections import defaultdict
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from meshforge.common import UsageError, pluralize
from meshforge.labels.vlm.cost import CostLimiter, Usage
from meshforge.labels.vlm.endpoint import EndError, Endpoint, QuestionError, RefusalError, TokenCount
from meshforge.labels.vlm.question import AnswerCache, Reply, VlmQuestion, build_body, find_refused, probe_question

if TYPE_CHECKING:
    from openai import APIStatusError, OpenAI

_DOWN = 2  # questions in a row, beyond those under way at once, that get no answer: then nobody is there
_PROBE_RETRIES = 2  # of the first question at most: a server that is not there is reported soon
_NO_MONEY = ("insufficient_quota", "billing_hard_limit", "billing_not_active", "credit balance", "insufficient balance")
_LONG = 400  # characters of a server's complaint that are shown
_SHORT = 60  # and of what it sends in place of JSON


class Client:
    """Asks a model. Safe to use from several threads.

    folder: where answers are kept, None for nowhere; max_cost: the most that may be spent [$]; stop: whether to ask no
    more. end: why no further question is asked, None as long as asking goes on; is_blind: the model took a red picture
    for another one; refused: what the server does not take of a request. Raises UsageError for a limit on the cost
    without prices.
    """

    def __init__(
        self,
        endpoint: Endpoint,
        folder: Path | None = None,
        *,
        max_cost: float | None = None,
        stop: Callable[[], bool] = lambda: False,
    ) -> None:
        self.endpoint = endpoint
        self.end: EndError | None = None
        self.is_blind = False
        self.refused = frozenset[str]()
        self._key = ""
        self._cache = AnswerCache(folder) if folder else None
        self._limiter = CostLimiter(endpoint, max_cost)
        self._stop = stop
        self._sdk: OpenAI | None = None
        self._probing = threading.Lock()
        self._lock = threading.Lock()
        self._turns = defaultdict[str, threading.Lock](threading.Lock)
        self._attempts: Any = threading.local()
        """Those at the question that a thread asks. count: so far; bound: what one costs at most [$]; is_open: whether
        the last is under way, and is_lost: whether it may have been charged for though no answer came."""
        self._unanswered, self._answered = 0, False

    @property
    def usage(self) -> Usage:
        """What was asked so far, and its cost."""
        return self._limiter.usage

    def probe(self) -> None:
        """Ask a first question, if none was asked: what the server refuses of it is left out of others, and it tells
        how pictures are charged. Raises EndError."""
        with self._probing:
            if not self._answered:
                try:
                    retries = min(_PROBE_RETRIES, self.endpoint.settings.retries)
                    self.is_blind = "red" not in self._ask_with_less(probe_question(), retries).text.lower()
                except QuestionError as error:
                    raise self._end_with(EndError(error.problem, where=error.where, remedy=error.remedy)) from error

    def find_answer(self, question: VlmQuestion) -> Reply | None:
        """Return the answer that was given earlier, None where there is none; never ask."""
        return self._cache.read(question, self.endpoint) if self._cache else None

    def ask(self, question: VlmQuestion) -> Reply:
        """Return the answer to a question; where it is kept, the same question at one time is asked once.

        Raises QuestionError where this one gets no answer, EndError where no further one would, among others where
        there is no key or no SDK.
        """
        with self._lock:
            turn = self._turns[question.digest(self.endpoint)]
        with turn:
            if known := self.find_answer(question):
                self._limiter.count(Usage(cached=1))
                return known
            self.probe()
            reply = self._ask_with_less(question, self.endpoint.settings.retries)
            if self._cache:
                self._cache.write(question, self.endpoint, reply)
            return reply

    def close(self) -> None:
        """Close the connections."""
        if self._sdk:
            self._sdk.close()

    def _ask_with_less(self, question: VlmQuestion, retries: int) -> Reply:
        """Ask with less as long as the request is refused."""
        refused = self.refused
        while True:
            try:
                reply = self._send(build_body(question, self.endpoint, refused), question, retries)
                self.refused = refused
                return reply
            except RefusalError as error:
                more = find_refused(error.problem, refused, is_first=not self._answered)
                if more is None:
                    raise
                refused |= {more}

    def _send(self, body: dict[str, Any], question: VlmQuestion, retries: int) -> Reply:
        """Ask, and count what it costs."""
        mine = self._attempts
        mine.count, mine.bound, mine.is_open, mine.is_lost = 0, self._limiter.upper_bound(question), False, False
        try:
            found = self._complete(body, retries)
            mine.is_lost = False
            usage, cost = self._limiter.charge(question, _read_usage(found))
            reply = replace(self._read_reply(found), usage=usage, cost=cost)
        except EndError as error:
            raise self._end_with(error) from error.__cause__
        finally:
            self._close_attempt()
        with self._lock:
            self._unanswered, self._answered = 0, True
        return reply

    def _complete(self, body: dict[str, Any], retries: int) -> Any:
        """What the SDK makes of the response, which it does not verify."""
        sdk = self._connect()
        import openai  # lazy: 0.5 s, and an extra: only asking a model needs it
        from openai.types.chat import ChatCompletion  # lazy: as openai

        options: Any = {"max_retries": retries, "follow_redirects": False}  # nobody approved where a redirect leads
        try:
            found: Any = sdk.post("/chat/completions", cast_to=ChatCompletion, body=body, options=options)
        except openai.APIConnectionError as error:
            cause, where = error.__cause__, self.endpoint.place
            why = self._redact(str(cause or "")) or "the connection broke"
            if isinstance(error, openai.APITimeoutError):
                why = f"no answer within {self.endpoint.settings.timeout:g} seconds"
            elif type(cause).__name__ in ("ConnectError", "UnsupportedProtocol"):
                self._attempts.is_lost = False
                if not self._answered:
                    remedy = "Is the server running, and base_url right?"
                    raise EndError(f"the server cannot be reached: {why}", where=where, remedy=remedy) from error
            raise self._give_up(why) from error
        except openai.APIStatusError as error:
            self._attempts.is_lost = False
            raise self._explain_status(error) from error
        except ValueError as error:
            raise self._explain_text(getattr(error, "doc", "")) from error
        if isinstance(found, str):
            raise self._explain_text(found)
        return found

    def _connect(self) -> OpenAI:
        try:
            from openai import OpenAI  # lazy: as openai
        except ImportError as error:
            remedy = "Install it: pip install 'meshforge[vlm]'."
            raise EndError("asking a model needs the package openai, which is not installed", remedy=remedy) from error
        begin, attempts = self._begin_attempt, self._attempts

        class CountedOpenAI(OpenAI):
            """Each attempt is allowed and counted before it is made."""

            def _prepare_request(self, request: Any) -> None:
                begin()

            def _should_retry(self, response: Any) -> bool:
                attempts.is_lost = False  # the server answered that it will not
                return super()._should_retry(response)

        settings = self.endpoint.settings
        with self._lock:
            if self._sdk is None:
                try:
                    self._key = self.endpoint.key()
                except UsageError as error:
                    raise EndError(error.problem, where=error.where, remedy=error.remedy) from error
                key = self._key or "none"  # the SDK wants one even where the server does not
                self._sdk = CountedOpenAI(base_url=settings.base_url, api_key=key, timeout=settings.timeout)
            return self._sdk

    def _begin_attempt(self) -> None:
        """Allow one more attempt. Raises EndError where no further one is to be made."""
        mine = self._attempts
        self._close_attempt()
        if mine.count:
            self._limiter.count(Usage(retries=1))
        if self.end:
            raise self.end
        if self._stop():
            raise EndError("stopped", remedy="What was answered is kept, and is not asked again.")
        self._limiter.reserve(mine.bound, self._stop)
        mine.count, mine.is_open, mine.is_lost = mine.count + 1, True, True

    def _close_attempt(self) -> None:
        mine = self._attempts
        if mine.is_open:
            self._limiter.release(mine.bound, is_lost=mine.is_lost)
        mine.is_open = False

    def _give_up(self, problem: str) -> QuestionError:
        """A question that got no answer; EndError where nobody seems to be there."""
        with self._lock:
            self._unanswered += 1
        where = self.endpoint.place
        problem = f"no answer after {pluralize(self._attempts.count, 'attempt')}, the last: {problem}"
        if self._unanswered > self.endpoint.settings.concurrency + _DOWN:
            remedy = "Try again later; what was answered is not asked again."
            return EndError(f"several questions in a row got {problem}", where=where, remedy=remedy)
        return QuestionError(problem, where=where)

    def _explain_text(self, text: str) -> EndError:
        begin = self._redact(" ".join(text.split()))[:_SHORT]
        problem = f"the server sent something that is no JSON: {begin or 'nothing'}"
        remedy = "Is base_url right? It mostly ends with /v1. What was answered is not asked again."
        return EndError(problem, where=self.endpoint.place, remedy=remedy)

    def _explain_status(self, error: APIStatusError) -> QuestionError:
        status, text = error.status_code, self._redact(_error_text(error))
        where, complaint = self.endpoint.place, text.lower()
        if status == 402 or (status in (400, 403, 429) and any(word in complaint for word in _NO_MONEY)):
            return EndError(f"the account has no money left: {text}", where=where)
        if status in (408, 409, 425, 429) or status >= 500:
            return self._give_up(f"{status}: {text}")
        if status in (401, 403) or (status == 400 and "api key" in complaint):
            name = self.endpoint.key_name
            named = f"The key is what the environment variable {name} holds."
            remedy = named if name else "Name its key: key_env in [vlm]."
            return EndError(f"the server does not accept the key: {text}", where=where, remedy=remedy)
        if status == 400 and "image" in complaint:
            return EndError(f"this model takes no pictures: {text}", where=self.endpoint.settings.model)
        if status == 404:
            problem = f"there is no model {self.endpoint.settings.model!r} here: {text}"
            return EndError(problem, where=where, remedy="Look at base_url and model; a base_url mostly ends with /v1.")
        return RefusalError(f"the server refused the question ({status}): {text}", where=where)

    def _read_reply(self, found: Any) -> Reply:
        try:
            choice = found.choices[0]
            text = choice.message.content or choice.message.refusal or ""
            text = text if isinstance(text, str) else "".join(part["text"] for part in text if "text" in part)
        except (AttributeError, IndexError, KeyError, TypeError) as error:
            raise self._give_up("the server sent something that is no answer") from error
        finish = choice.finish_reason if isinstance(choice.finish_reason, str) else "stop"
        return Reply(text.encode(errors="replace").decode(), finish)

    def _redact(self, text: str) -> str:
        return text.replace(self._key, "...") if self._key else text

    def _end_with(self, error: EndError) -> EndError:
        """The first error after which there is nothing to ask; later questions get the same."""
        self.end = self.end or error
        return self.end


def _read_usage(found: Any) -> TokenCount | None:
    usage = getattr(found, "usage", None)
    counts = [getattr(usage, name, None) for name in ("prompt_tokens", "completion_tokens")]
    known = [count for count in counts if isinstance(count, int) and count >= 0]
    return TokenCount(known[0], known[1]) if len(known) == 2 else None


def _error_text(error: APIStatusError) -> str:
    """What the server complains about, in one line, with its code."""
    body: Any = error.body
    if isinstance(body, list) and body and isinstance(body[0], dict):
        body = body[0].get("error", body[0])
    fields = body if isinstance(body, dict) else {"message": body}
    text, kind = str(fields.get("message") or fields.get("detail") or error.message), fields.get("code", error.type)
    words = " ".join(f"{text} ({kind})".split() if kind and str(kind) not in text else text.split())
    return words if len(words) <= _LONG else f"{words[:_LONG]} ..."
