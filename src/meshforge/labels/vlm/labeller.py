"""Labels of the hulls of a mesh from a model: asked in threads, asked once more where something is open, and added
up."""

from __future__ import annotations

import threading
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from queue import Empty, Queue
from typing import TypeVar

from meshforge.labels.vlm import prompt
from meshforge.labels.vlm.answer import LabelVote, VlmAnswers, decide_label, label_chances, read_answer
from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.endpoint import QuestionError
from meshforge.labels.vlm.prompt import HullQuestion, PromptConfig
from meshforge.labels.vlm.request import Message, VlmQuestion
from meshforge.rendering import draw_labeling_pictures
from meshforge.symbolic import Label, SymbolicMesh

Result = TypeVar("Result")
_WAITING = 3  # tasks for each thread that wait in the queue; submitting more blocks until there is room

_QUOTED = 4000  # characters of an answer that are put before the model when it is asked again
_UNSEEN, _UNASKED = "no picture shows it", "it was not asked about"


class RequestThreads:
    """A number of threads that work on tasks in the order in which they are submitted."""

    def __init__(self, count: int) -> None:
        self._line: Queue[Callable[[], None] | None] = Queue(_WAITING * count)
        self._threads = [threading.Thread(target=self._work, name=f"asking-{k}", daemon=True) for k in range(count)]
        for thread in self._threads:
            thread.start()

    def submit(self, task: Callable[[], Result]) -> Future[Result]:
        """Submit a task, as soon as there is room in the queue."""
        future: Future[Result] = Future()

        def run() -> None:
            try:
                future.set_result(task())
            except BaseException as error:  # it is raised where the result is asked for
                future.set_exception(error)

        self._line.put(run)
        return future

    def close(self) -> None:
        """End each thread after the task that it works on; tasks that wait are dropped."""
        with suppress(Empty):
            while True:
                self._line.get_nowait()
        for _ in self._threads:
            self._line.put(None)

    def _work(self) -> None:
        while (task := self._line.get()) is not None:
            task()


@dataclass(frozen=True, slots=True)
class _Response:
    """What came of one question: votes by hull, or why there are none."""

    votes: Mapping[str, LabelVote] = field(default_factory=dict)
    open: Mapping[str, str] = field(default_factory=dict)
    failed: str | None = None
    asked: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class OpenAnswers:
    """A mesh whose questions are under way."""

    names: Sequence[str]
    vocabulary: Sequence[str]
    answers: Sequence[Future[_Response]]

    def is_done(self) -> bool:
        return all(answer.done() for answer in self.answers)

    def result(self) -> VlmAnswers:
        """What the model said, when all of it is there."""
        responses = [answer.result() for answer in self.answers]
        labels, left = dict[str, Label](), dict[str, str]()
        for hull in self.names:
            found = decide_label([one.votes[hull] for one in responses if hull in one.votes], self.vocabulary)
            if found:
                labels[hull] = Label(*found, "vlm")
            else:
                left[hull] = _explain_gap(hull, responses)
        failed = tuple(dict.fromkeys(response.failed for response in responses if response.failed))
        return VlmAnswers(labels, left, failed, tuple(digest for response in responses for digest in response.asked))


class Labeller:
    """Labels meshes through a client; the answers come out the same however many questions are under way at once.

    examples: labelled meshes to be shown as examples.
    """

    def __init__(self, client: Client, config: PromptConfig, examples: Iterable[SymbolicMesh] = ()) -> None:
        self._client, self._config = client, config
        self._examples = tuple(m for mesh in examples for m in example_messages(mesh, config))
        self._workers = RequestThreads(client.endpoint.concurrency)

    def close(self) -> None:
        """Ask no more; what is under way is kept when its answer comes, yet not waited for."""
        self._workers.close()

    def build_questions(
        self, mesh: SymbolicMesh, wanted: Collection[str] | None = None, name: str = ""
    ) -> Iterator[HullQuestion]:
        """The questions that `begin` asks at first; nothing is sent."""
        return prompt.build_questions(mesh, mesh.index.keys() if wanted is None else wanted, self._config, name)

    def begin(self, mesh: SymbolicMesh, wanted: Collection[str] | None = None, name: str = "") -> OpenAnswers:
        """Draw a mesh and ask about some hulls, by default all. Questions that get no answer leave their hulls open.

        name: that of the asset, which the model is given where the config says so.
        """
        names = [hull for hull in mesh.index if wanted is None or hull in wanted]
        return self.ask(names, self.build_questions(mesh, names, name))

    def ask(self, names: Sequence[str], questions: Iterable[HullQuestion]) -> OpenAnswers:
        """Ask about some hulls of a mesh, as they come. Waits where many questions are under way already."""
        answers = []
        for hull_question in questions:
            answers.append(self._workers.submit(partial(self._ask_about, self.add_examples(hull_question))))
            if self._client.end:  # what is drawn from here on would not be asked
                break
        return OpenAnswers(names, self._config.vocabulary, answers)

    def add_examples(self, hull_question: HullQuestion) -> HullQuestion:
        """A question as it is sent, behind the examples."""
        return hull_question.show_examples(self._examples) if self._examples else hull_question

    def _ask_about(self, hull_question: HullQuestion) -> _Response:
        """The votes of one question; what its answer leaves open is asked once more."""
        endpoint = self._client.endpoint
        asked: tuple[str, ...] = (hull_question.question.digest(endpoint),)
        try:
            votes, left, second = self._collect_votes(hull_question, hull_question.question)
        except QuestionError as error:
            gaps = dict.fromkeys(hull_question.hulls.values(), "the question got no answer")
            return _Response(open=gaps, failed=error.sentence)
        failed = None
        if second:
            try:
                rest = replace(hull_question, hulls={n: hull_question.hulls[n] for n in left})
                more, left, _ = self._collect_votes(rest, second)
                votes, asked = votes | more, (*asked, second.digest(endpoint))
            except QuestionError as error:
                failed = error.sentence
        return _Response(votes, {hull_question.hulls[n]: why for n, why in left.items()}, failed, asked)

    def _collect_votes(
        self, hull_question: HullQuestion, question: VlmQuestion
    ) -> tuple[dict[str, LabelVote], dict[int, str], VlmQuestion | None]:
        """The votes of an answer by hull, why numbers are left open, and the question that asks for these again."""
        reply = self._client.ask(question)
        vocabulary, unknown = self._config.vocabulary, self._config.unknown
        answer = read_answer(reply.text, hull_question.hulls.keys(), vocabulary, unknown)
        sure = label_chances(reply, answer, vocabulary, unknown)
        votes = {
            (hull := hull_question.hulls[number]): LabelVote(label, hull_question.weights[hull], sure.get(number))
            for number, label in answer.said.items()
        }
        if not answer.open:
            return votes, {}, None
        why = "the answer was cut off" if reply.is_cut and not answer.odd else answer.problem
        back = (Message.assistant(reply.text[:_QUOTED] or "-"), prompt.retry_message(answer.open, answer.odd))
        limit = question.limit * 2 if reply.is_cut else question.limit
        second = replace(question, messages=(*question.messages, *back), limit=limit)
        return votes, dict.fromkeys(answer.open, why), second


def _explain_gap(hull: str, responses: Sequence[_Response]) -> str:
    if any(hull in response.votes for response in responses):
        return "the model does not know"
    failed = any(response.failed for response in responses)
    return next((one.open[hull] for one in responses if hull in one.open), _UNASKED if failed else _UNSEEN)


def example_messages(mesh: SymbolicMesh, config: PromptConfig) -> tuple[Message, ...]:
    """A labelled mesh as a question with its answer; nothing where no hull has a label of the vocabulary."""
    labelled = [hull.name for hull in mesh.hulls if hull.label in config.vocabulary][: config.picture_mode.hulls]
    if not labelled:
        return ()
    taken = draw_labeling_pictures(
        mesh, hulls=labelled, most=min(2, config.picture_mode.pictures), size=config.picture_mode.size
    )
    shown = frozenset[str]().union(*(shot.numbered for shot in taken))
    numbers = {hull: mesh.index[hull] for hull in labelled if hull in shown}
    said = {number: mesh.hull_of(hull).label or config.unknown for hull, number in numbers.items()}
    return prompt.question_message(taken, 0, numbers), prompt.example_answer(said)
