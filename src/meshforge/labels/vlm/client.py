"""The client: a question in, an answer out, from the disk where it is there, and else from the server, with retries."""

from __future__ import annotations

import base64
import threading
import time
from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

from meshforge.labels.vlm.cost import CostLimiter, Usage
from meshforge.labels.vlm.endpoint import EndError, Endpoint, QuestionError, RefusalError
from meshforge.labels.vlm.question import AnswerCache, Message, Reply, VlmQuestion
from meshforge.labels.vlm.server import Server, TransientError
from meshforge.rendering import encode_png

LONGEST = 60.0
"""The longest wait [s] between attempts that the server does not ask for."""
_LONGEST_DEMAND = 300.0  # seconds that a server may want to be left alone; where it wants more, the run ends
_POLL = 0.05  # seconds between looks at whether to stop
_DOWN = 2  # questions in a row, beyond those under way at once, that get no answer: then nobody is there
_LESS: Mapping[str, Mapping[str, Any]] = {
    "schema": {"schema": False},
    "response_format": {"schema": False},
    "temperature": {"temperature": False},
    "max_tokens": {"limit": "max_completion_tokens"},
    "image": {"pictures": False},
}
"""What is asked for no more, by the word with which servers complain about it; the first that can be spared first."""
_SIDE = 512  # pixels: one tile for those models that cut pictures up, so that it tells how they count them


@dataclass(frozen=True, slots=True)
class ServerFeatures:
    """What of a request is not refused. schema: the form of answers; temperature: can be set.

    limit: the name of the field for the room of an answer; pictures: are taken.
    """

    schema: bool = True
    temperature: bool = True
    limit: str = "max_tokens"
    pictures: bool = True

    def body(self, question: VlmQuestion, endpoint: Endpoint) -> dict[str, Any]:
        """Return the request that puts a question to the model."""
        body: dict[str, Any] = {
            "model": endpoint.settings.model,
            "messages": [{"role": m.role, "content": _format_content(m)} for m in question.messages],
            self.limit: question.limit,
        }
        if self.temperature:
            body["temperature"] = question.temperature
        if self.schema and question.schema is not None:
            form = {"name": "answer", "strict": True, "schema": question.schema}
            body["response_format"] = {"type": "json_schema", "json_schema": form}
        return body | dict(endpoint.settings.extra)

    def without(self, complaint: str) -> ServerFeatures | None:
        """Return these without the one that the server complains about, or else the next; None: none is left."""
        left = {word: less for word, change in _LESS.items() if (less := replace(self, **change)) != self}
        return next((less for word, less in left.items() if word in complaint.lower()), next(iter(left.values()), None))


def _format_content(message: Message) -> Any:
    """Plain text where there is nothing else, which every server takes."""
    if all(isinstance(part, str) for part in message.parts):
        return "\n".join(str(part) for part in message.parts)
    return [
        {"type": "text", "text": part}
        if isinstance(part, str)
        else {"type": "image_url", "image_url": {"url": f"data:image/png;base64,{base64.b64encode(part).decode()}"}}
        for part in message.parts
    ]


@cache
def probe_question(with_picture: bool) -> VlmQuestion:
    """Return a small question that is asked first: which colour is this?"""
    text = f"Which of these colours is {'this picture' if with_picture else 'a ripe tomato'}: red, green, blue?"
    schema = {
        "type": "object",
        "properties": {"colour": {"type": "string", "enum": ["red", "green", "blue"]}},
        "required": ["colour"],
        "additionalProperties": False,
    }
    if not with_picture:
        return VlmQuestion((Message.user(text),), schema)
    from PIL import Image  # lazy: only a probe of a server draws this picture

    picture = encode_png(Image.new("RGB", (_SIDE, _SIDE), (220, 30, 30)))
    return VlmQuestion((Message.user(text, picture),), schema)


class Client:
    """Asks a model. Safe to use from several threads; at most `concurrency` questions are under way at once.

    folder: where answers are kept, None for nowhere; max_cost: the most that may be spent [$]; stop: whether to ask no
    more. end: why no further question is asked, None as long as asking goes on; is_blind: the model took a red picture
    for another one. Raises UsageError for a limit on the cost without prices.
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
        self._cache = AnswerCache(folder) if folder else None
        self._limiter = CostLimiter(endpoint, max_cost)
        self._stop = stop
        self._server = Server(endpoint)
        self._slots = threading.BoundedSemaphore(endpoint.settings.concurrency)
        self._probing = threading.Lock()
        self._features: ServerFeatures | None = None
        self._lock = threading.Lock()
        self._turns = defaultdict[str, threading.Lock](threading.Lock)
        self._closed_until = 0.0
        self._unanswered, self._answered = 0, False

    @property
    def usage(self) -> Usage:
        """What was asked so far, and its cost."""
        return self._limiter.usage

    def features(self) -> ServerFeatures:
        """Return what the server takes, asked for when it is first needed. Raises EndError."""
        with self._probing:
            if self._features is None:
                try:
                    self._features = self._probe()
                except QuestionError as error:
                    raise self._end_with(EndError(error.problem, where=error.where, remedy=error.remedy)) from error
            return self._features

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
            reply = self._ask_server(question)
            if self._cache:
                self._cache.write(question, self.endpoint, reply)
            return reply

    def close(self) -> None:
        """Close the connections."""
        self._server.close()

    def _probe(self) -> ServerFeatures:
        """Ask with everything, and with less as long as the server refuses; it also tells how pictures are charged."""
        features = ServerFeatures()
        while True:
            try:
                reply = self._ask_with_retries(probe_question(features.pictures), features, is_probe=True)
            except RefusalError as error:
                less = features.without(error.problem)
                if less is None:
                    raise
                features = less
                continue
            self.is_blind = features.pictures and "red" not in reply.text.lower()
            return features

    def _ask_server(self, question: VlmQuestion) -> Reply:
        features = self.features()
        if not features.pictures and any(question.pictures):
            raise self._end_with(EndError("this model takes no pictures", where=self.endpoint.settings.model))
        try:
            return self._ask_with_retries(question, features)
        except RefusalError:  # of all that a server may dislike, a schema can be done without
            if question.schema is None or not features.schema:
                raise
            return self._ask_with_retries(question, replace(features, schema=False))

    def _ask_with_retries(self, question: VlmQuestion, features: ServerFeatures, *, is_probe: bool = False) -> Reply:
        body, attempt = features.body(question, self.endpoint), 0
        with self._slots:
            try:
                while True:
                    self._wait(min(self.endpoint.settings.wait * 2 ** (attempt - 1), LONGEST) if attempt else 0.0)
                    try:
                        return self._ask_once(question, body, is_probe)
                    except TransientError as fault:
                        attempt += 1
                        self._give_up(fault, attempt)
                        self._limiter.count(Usage(retries=1))
            except EndError as error:
                raise self._end_with(error) from None

    def _ask_once(self, question: VlmQuestion, body: Mapping[str, Any], is_probe: bool) -> Reply:
        """Ask once, and count what it costs. Raises TransientError, RefusalError or EndError."""
        bound = self._limiter.upper_bound(question)
        with self._limiter.reserve(bound, self._stop):
            self._wait(0.0)
            try:
                reply = self._server.send(body)
            except TransientError as fault:
                if fault.usage:
                    self._limiter.charge(question, fault.usage, is_probe=is_probe)
                elif fault.charged:
                    self._limiter.count(Usage(perhaps=bound, lost=1))
                raise
            usage, cost = self._limiter.charge(question, reply.usage, is_probe=is_probe)
        with self._lock:
            self._unanswered, self._answered = 0, True
        return replace(reply, usage=usage, cost=cost)

    def _give_up(self, fault: TransientError, attempts: int) -> None:
        """Raise QuestionError after the last attempt, EndError where nobody seems to be there."""
        where = self.endpoint.place
        if fault.after is not None and fault.after > _LONGEST_DEMAND:
            remedy = "Go on then; what was answered is not asked again."
            raise EndError(f"the server wants to be left alone for {fault.after / 60:.0f} minutes", remedy=remedy)
        if fault.unreachable and not self._answered and attempts > 1:
            remedy = "Is the server running, and base_url right?"
            raise EndError(f"the server cannot be reached: {fault}", where=where, remedy=remedy)
        with self._lock:
            self._closed_until = max(self._closed_until, time.monotonic() + (fault.after or 0.0))
            if attempts <= self.endpoint.settings.retries:
                return
            self._unanswered += 1
        problem = f"no answer after {attempts} attempts, the last: {fault}"
        if self._unanswered > self.endpoint.settings.concurrency + _DOWN:
            remedy = "Try again later; what was answered is not asked again."
            raise EndError(f"several questions in a row got {problem}", where=where, remedy=remedy)
        raise QuestionError(problem, where=where)

    def _wait(self, seconds: float) -> None:
        """Wait so long [s], and as long as the server wants no question at all. Raises EndError: asking has ended."""
        until = time.monotonic() + seconds
        while True:
            if self.end:
                raise self.end
            if self._stop():
                raise EndError("stopped", remedy="What was answered is kept, and is not asked again.")
            left = max(until, self._closed_until) - time.monotonic()
            if left <= 0:
                return
            time.sleep(min(left, _POLL))

    def _end_with(self, error: EndError) -> EndError:
        """The first error after which there is nothing to ask; later questions get the same."""
        self.end = self.end or error
        return self.end
