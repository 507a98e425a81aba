"""The client: a question in, an answer out, from the disk where it is there, and else from the server; the OpenAI SDK
waits, times out, and tries again after faults that pass."""

from __future__ import annotations

import threading
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from meshforge.labels.vlm.cost import CostLimiter, Usage
from meshforge.labels.vlm.endpoint import EndError, Endpoint, QuestionError, RefusalError
from meshforge.labels.vlm.question import AnswerCache, Reply, VlmQuestion, probe_question

if TYPE_CHECKING:
    from openai import APIStatusError, OpenAI

_DOWN = 2  # questions in a row, beyond those under way at once, that get no answer: then nobody is there
_PROBE_RETRIES = 2  # of the first question at most: a server that is not there is reported soon
_NO_MONEY = ("insufficient_quota", "billing_hard_limit", "billing_not_active", "credit balance", "insufficient balance")
_LONG = 400  # characters of a server's complaint that are shown
_SHORT = 60  # and of what it sends in place of JSON
_SCHEMA, _MANNER = frozenset({"response_format"}), frozenset({"temperature", "max_tokens"})
"""What servers may refuse: some a schema; models that think the others, the last of which has another name there."""


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
        self._thread: Any = threading.local()
        self._probing, self._lock = threading.Lock(), threading.Lock()
        self._turns = defaultdict[str, threading.Lock](threading.Lock)
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
                    self.end = self.end or EndError(error.problem, where=error.where, remedy=error.remedy)
                    raise self.end from error

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
                self._limiter.count(cached=1)
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
        """Ask, with less where the request is refused; after the first question only the schema can be spared."""
        first = self.refused, self.refused | _SCHEMA
        for refused in first if self._answered else (*first, _MANNER, _MANNER | _SCHEMA):
            try:
                reply = self._send(question, refused, retries)
                self.refused = refused
                return reply
            except RefusalError as error:
                refusal = error
            except EndError as error:  # the first after which there is nothing to ask; later questions get the same
                self.end = self.end or error
                raise self.end from error.__cause__
        raise refusal

    def _send(self, question: VlmQuestion, refused: frozenset[str], retries: int) -> Reply:
        """Ask, and count what it costs."""
        if self.end:
            raise self.end
        if self._stop():
            raise EndError("stopped", remedy="What was answered is kept, and is not asked again.")
        sdk = self._connect().with_options(max_retries=retries)
        import openai  # lazy: 0.5 s, and an extra: only asking a model needs it

        body, mine = question.to_body(self.endpoint, refused), self._thread
        mine.sent = mine.silent = 0
        with self._limiter.reserve(question, self._stop) as bound:
            try:
                found: Any = sdk.chat.completions.create(model="", messages=[], extra_body=body)
                mine.silent -= 1
            except openai.APIConnectionError as error:
                why = self._redact(str(error.__cause__ or "")) or "the connection broke"
                if isinstance(error, openai.APITimeoutError):
                    why = f"no answer within {self.endpoint.settings.timeout:g} seconds"
                raise self._give_up(why) from error
            except openai.APIStatusError as error:
                raise self._explain_status(error) from error
            except ValueError as error:
                found = getattr(error, "doc", "")
            finally:
                self._limiter.count(retries=max(mine.sent - 1, 0), perhaps=bound * mine.silent)
            if isinstance(found, str):
                begin = self._redact(" ".join(found.split()))[:_SHORT]
                problem = f"the server sent something that is no JSON: {begin or 'nothing'}"
                remedy = "Is base_url right? It mostly ends with /v1. What was answered is not asked again."
                raise EndError(problem, where=self.endpoint.place, remedy=remedy)
            reply = self._limiter.charge(question, _read_reply(found))
        if not reply.finish:
            raise self._give_up("the server sent something that is no answer")
        self._unanswered, self._answered = 0, True
        return reply

    def _connect(self) -> OpenAI:
        try:
            from openai import DefaultHttpxClient, OpenAI  # lazy: as openai
        except ImportError as error:
            remedy = "Install it: pip install 'meshforge[vlm]'."
            raise EndError("asking a model needs the package openai, which is not installed", remedy=remedy) from error
        settings = self.endpoint.settings
        with self._lock:
            if self._sdk is None:
                self._key = self.endpoint.key()
                key = self._key or "none"  # the SDK wants one even where the server does not
                hooks: Any = {"request": [self._note_request], "response": [self._note_response]}
                http = DefaultHttpxClient(follow_redirects=False, event_hooks=hooks)  # no host but the approved one
                self._sdk = OpenAI(base_url=settings.base_url, api_key=key, timeout=settings.timeout, http_client=http)
            return self._sdk

    def _note_request(self, request: Any) -> None:
        self._thread.sent, self._thread.silent = self._thread.sent + 1, self._thread.silent + 1

    def _note_response(self, response: Any) -> None:
        """Where a response says that there will be no answer, an attempt costs nothing."""
        self._thread.silent -= not response.is_success

    def _give_up(self, problem: str) -> QuestionError:
        """A question that got no answer; EndError where nobody seems to be there."""
        with self._lock:
            self._unanswered += 1
        where = self.endpoint.place
        if not self._answered:
            remedy = "Is the server running, and base_url right?"
            return EndError(f"the server cannot be reached: {problem}", where=where, remedy=remedy)
        if self._unanswered > self.endpoint.settings.concurrency + _DOWN:
            remedy = "Try again later; what was answered is not asked again."
            return EndError(
                f"several questions in a row got no answer, the last: {problem}", where=where, remedy=remedy
            )
        return QuestionError(f"no answer: {problem}", where=where)

    def _explain_status(self, error: APIStatusError) -> QuestionError:
        status, where, fields = error.status_code, self.endpoint.place, error.body
        text = fields.get("message") if isinstance(fields, dict) else None
        text = self._redact(" ".join(str(text or error.message).split()))[:_LONG]
        complaint = f"{text} {fields}".lower()
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

    def _redact(self, text: str) -> str:
        return text.replace(self._key, "...") if self._key else text


def _read_reply(found: Any) -> Reply:
    """What the SDK read, which may be of any form; without `finish` where it is no answer."""
    usage = getattr(found, "usage", None)
    counts = [getattr(usage, name, None) for name in ("prompt_tokens", "completion_tokens")]
    known = [count for count in counts if isinstance(count, int) and count >= 0]
    given, made = known if len(known) == 2 else (0, 0)
    try:
        choice = found.choices[0]
        text = choice.message.content or choice.message.refusal or ""
        text = text if isinstance(text, str) else "".join(part["text"] for part in text if "text" in part)
        finish = str(choice.finish_reason or "stop")
    except (AttributeError, IndexError, KeyError, TypeError):
        text = finish = ""
    return Reply(text.encode(errors="replace").decode(), finish, given, made, len(known) < 2)
