"""The client: a question in, an answer out, from the disk where it is there, and else from the server, with retries."""

from __future__ import annotations

import hashlib
import json
import threading
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from meshforge.labels.vlm.cache import AnswerCache
from meshforge.labels.vlm.endpoint import EndError, Endpoint, QuestionError, RefusalError, TransientError
from meshforge.labels.vlm.limits import Backoff, CostLimiter, Usage
from meshforge.labels.vlm.request import ServerFeatures, VlmQuestion, probe_features, read_features, write_features
from meshforge.labels.vlm.transport import NoReplyError, Reply, Transport

_DOWN = 2  # questions in a row, beyond those under way at once, that get no answer: then nobody is there


class Client:
    """Asks a model. Safe to use from several threads; at most `endpoint.concurrency` questions are under way at once.

    folder: where answers are kept, None for nowhere; max_cost: the most that may be spent [$]; stop: whether to ask no
    more. Raises UsageError for a limit on the cost without prices.
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
        self._cache = AnswerCache(folder) if folder else None
        self._limiter = CostLimiter(endpoint, max_cost)
        self._stop = stop
        self._backoff = Backoff(endpoint.wait, stop)
        self._transport = Transport(endpoint)
        self._slots = threading.BoundedSemaphore(endpoint.concurrency)
        self._lock = threading.Lock()
        self._probing = threading.Lock()
        self._features: ServerFeatures | None = None
        self._in_flight: dict[str, Future[Reply]] = {}
        self._end: EndError | None = None
        self._unanswered, self._answered = 0, False

    @property
    def usage(self) -> Usage:
        """What was asked so far, and its cost."""
        return self._limiter.usage

    @property
    def end(self) -> EndError | None:
        """Why no further question is asked; None as long as asking goes on."""
        return self._end

    @property
    def is_blind(self) -> bool:
        """Whether the model took a red picture for another one; False where it was not asked."""
        return self._features is not None and not self._features.sees

    def features(self) -> ServerFeatures:
        """What the server can do, asked for when it is first needed. Raises EndError."""
        with self._probing:
            if self._features is None:
                path = self._features_path()
                self._features = read_features(path) if path else None
            if self._features is None:
                try:
                    self._features = probe_features(partial(self._ask_with_retries, is_probe=True))
                except QuestionError as error:
                    raise self._end_with(EndError(error.problem, where=error.where, remedy=error.remedy)) from error
                if path:
                    write_features(path, self._features, self.endpoint)
            return self._features

    def find_answer(self, question: VlmQuestion) -> Reply | None:
        """The answer that was given earlier, None where there is none; never asks."""
        return self._cache.read(question, self.endpoint) if self._cache else None

    def ask(self, question: VlmQuestion) -> Reply:
        """The answer to a question; the same question asked at one time is asked once.

        Raises QuestionError where this one gets no answer, EndError where no further one would, among others where
        there is no key or no SDK.
        """
        key = question.digest(self.endpoint)
        with self._lock:
            earlier = self._in_flight.get(key)
            if earlier is None:
                mine = self._in_flight[key] = Future[Reply]()
        if earlier is not None:
            reply = earlier.result()
            self._limiter.count(cached=1)
            return replace(reply, cached=True)
        try:
            mine.set_result(self._find_or_ask(question))
        except BaseException as error:
            mine.set_exception(error)
            raise
        finally:
            with self._lock:
                del self._in_flight[key]
        return mine.result()

    def close(self) -> None:
        """Close the connections."""
        self._transport.close()

    def _find_or_ask(self, question: VlmQuestion) -> Reply:
        known = self.find_answer(question)
        if known:
            self._limiter.count(cached=1)
            return known
        features = self.features()
        if not features.pictures and any(question.pictures):
            raise self._end_with(EndError("this model takes no pictures", where=self.endpoint.model))
        try:
            reply = self._ask_with_retries(question, features)
        except RefusalError:  # of all that a server may dislike, a schema can be done without
            if question.schema is None or not features.schema:
                raise
            reply = self._ask_with_retries(question, replace(features, schema=False))
        if self._cache:
            self._cache.write(question, self.endpoint, reply)
        return reply

    def _ask_with_retries(self, question: VlmQuestion, features: ServerFeatures, *, is_probe: bool = False) -> Reply:
        body, key = features.body(question, self.endpoint), question.digest(self.endpoint)
        with self._slots:
            try:
                for attempt in range(self.endpoint.retries + 1):
                    self._raise_if_ended()
                    self._backoff.wait()
                    try:
                        return self._ask_once(question, body, is_probe)
                    except TransientError as fault:
                        self._give_up(fault, attempt)
                        self._limiter.count(retries=1)
                        self._backoff.back_off(attempt, fault.after, _jitter(key, attempt))
            except EndError as error:
                raise self._end_with(error) from None
        raise AssertionError("the last attempt gives an answer or raises")

    def _ask_once(self, question: VlmQuestion, body: Mapping[str, Any], is_probe: bool) -> Reply:
        """Ask once, and count what it costs. Raises TransientError, RefusalError or EndError."""
        bound = self._limiter.upper_bound(question)
        with self._limiter.reserve(bound, self._stop):
            self._backoff.raise_if_stopped()
            try:
                reply = self._transport.send(body)
            except NoReplyError as error:
                if error.usage:
                    self._limiter.charge(question, error.usage, is_probe=is_probe)
                else:
                    self._limiter.count_lost(bound)
                raise TransientError(str(error)) from error
            except TransientError as fault:
                if fault.charged:
                    self._limiter.count_lost(bound)
                raise
            usage, cost = self._limiter.charge(question, reply.usage, is_probe=is_probe)
        with self._lock:
            self._unanswered, self._answered = 0, True
        return replace(reply, usage=usage, cost=cost)

    def _give_up(self, fault: TransientError, attempt: int) -> None:
        """Raises QuestionError after the last attempt, EndError where nobody seems to be there."""
        where = self.endpoint.place
        if fault.unreachable and not self._answered and attempt:
            remedy = "Is the server running, and base_url right?"
            raise self._end_with(EndError(f"the server cannot be reached: {fault}", where=where, remedy=remedy))
        if attempt < self.endpoint.retries:
            return
        with self._lock:
            self._unanswered += 1
        tried = f"no answer after {attempt + 1} attempts, the last: {fault}"
        if self._unanswered > self.endpoint.concurrency + _DOWN:
            remedy = "Try again later; what was answered is not asked again."
            raise self._end_with(EndError(f"several questions in a row got {tried}", where=where, remedy=remedy))
        raise QuestionError(tried, where=where)

    def _raise_if_ended(self) -> None:
        """Raises EndError where one came up before, or a stop is wanted."""
        if self._end:
            raise self._end
        self._backoff.raise_if_stopped()

    def _end_with(self, error: EndError) -> EndError:
        """The first error after which there is nothing to ask; later questions get the same."""
        self._end = self._end or error
        return self._end

    def _features_path(self) -> Path | None:
        if self._cache is None:
            return None
        what = json.dumps([self.endpoint.place, self.endpoint.model, dict(self.endpoint.extra)], sort_keys=True)
        return self._cache.folder / "servers" / f"{hashlib.blake2b(what.encode(), digest_size=16).hexdigest()}.json"


def _jitter(key: str, attempt: int) -> float:
    """A number in 0..1 that differs from question to question, always the same for the same one."""
    return int(key[2 * attempt % 24 :][:8], 16) / 0xFFFFFFFF
