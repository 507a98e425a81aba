"""The hulls of a mesh asked about in threads, once more where something is open, and the answers added up."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field, replace

from meshforge.labels.vlm import prompt
from meshforge.labels.vlm.answer import LabelVote, VlmAnswers, decide_label, label_chances, read_answer
from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.endpoint import QuestionError
from meshforge.labels.vlm.prompt import HullQuestion, PromptConfig
from meshforge.labels.vlm.request import Message, VlmQuestion
from meshforge.rendering import draw_labeling_pictures
from meshforge.symbolic import Label, SymbolicMesh

_WAITING = 4  # questions for each thread that are under way or wait; asking more blocks until there is room
_QUOTED = 4000  # characters of an answer that are put before the model when it is asked again
_UNSEEN, _UNASKED = "no picture shows it", "it was not asked about"


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


class MeshAsker:
    """Asks about meshes through a client; the answers come out the same however many questions are under way at once.

    examples: labelled meshes to be shown as examples.
    """

    def __init__(self, client: Client, config: PromptConfig, examples: Iterable[SymbolicMesh] = ()) -> None:
        self.config, self._client = config, client
        self._examples = tuple(m for mesh in examples for m in example_messages(mesh, config))
        self._threads = ThreadPoolExecutor(client.endpoint.concurrency, "asking")
        self._room = threading.BoundedSemaphore(_WAITING * client.endpoint.concurrency)

    def close(self) -> None:
        """Ask no more; what is under way is kept when its answer comes, yet not waited for."""
        self._threads.shutdown(wait=False, cancel_futures=True)

    def ask(self, names: Sequence[str], questions: Iterable[HullQuestion]) -> OpenAnswers:
        """Ask about some hulls of a mesh, as they come. Waits where many questions are under way already."""
        answers = []
        for hull_question in questions:
            self._room.acquire()
            answers.append(self._threads.submit(self._ask_about, self.add_examples(hull_question)))
            answers[-1].add_done_callback(lambda _: self._room.release())
            if self._client.end:  # what is drawn from here on would not be asked
                break
        return OpenAnswers(names, self.config.vocabulary, answers)

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
        vocabulary, unknown = self.config.vocabulary, self.config.unknown
        answer = read_answer(reply.text, hull_question.hulls.keys(), vocabulary, unknown)
        sure = label_chances(reply, answer, vocabulary, unknown)
        votes = {
            (hull := hull_question.hulls[number]): LabelVote(label, hull_question.weights[hull], sure.get(number))
            for number, label in answer.given.items()
        }
        if not answer.open:
            return votes, {}, None
        why = "the answer was cut off" if reply.is_cut and not answer.unrecognised else answer.problem
        back = (Message.assistant(reply.text[:_QUOTED] or "-"), prompt.retry_message(answer.open, answer.unrecognised))
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
    given = {number: mesh.hull_of(hull).label or config.unknown for hull, number in numbers.items()}
    return prompt.question_message(taken, 0, numbers), prompt.example_answer(given)
