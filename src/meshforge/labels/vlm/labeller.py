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

from meshforge.labels.vlm.answer import LabelVote, VlmAnswers, decide_label, label_chances, read_answer
from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.endpoint import QuestionError
from meshforge.labels.vlm.prompt import HullQuestion, PromptConfig, example_answer, question_message, retry_message
from meshforge.labels.vlm.prompt import build_questions as looks
from meshforge.labels.vlm.request import Message, VlmQuestion
from meshforge.symbolic import Label, SymbolicMesh

Result = TypeVar("Result")
_WAITING = 3  # tasks for each thread that wait in line; handing in more takes until there is room

_QUOTED = 4000  # characters of an answer that are put before the model when it is asked again
_UNSEEN, _UNASKED = "no picture shows it", "it was not asked about"


class RequestThreads:
    """So many threads, which work on tasks in the order they are handed in."""

    def __init__(self, count: int) -> None:
        self._line: Queue[Callable[[], None] | None] = Queue(_WAITING * count)
        self._threads = [threading.Thread(target=self._work, name=f"asking-{k}", daemon=True) for k in range(count)]
        for thread in self._threads:
            thread.start()

    def submit(self, task: Callable[[], Result]) -> Future[Result]:
        """Hand in a task, as soon as there is room in the line."""
        future: Future[Result] = Future()

        def run() -> None:
            try:
                future.set_result(task())
            except BaseException as error:  # it is raised where the result is asked for
                future.set_exception(error)

        self._line.put(run)
        return future

    def close(self) -> None:
        """End each thread after the task that it is at; tasks that wait in line are dropped, and never done."""
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
    """What came of one look: votes by hull, or why there are none."""

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
        heard = [answer.result() for answer in self.answers]
        labels, left = dict[str, Label](), dict[str, str]()
        for hull in self.names:
            found = decide_label([h.votes[hull] for h in heard if hull in h.votes], self.vocabulary)
            if found:
                labels[hull] = Label(*found, "vlm")
            else:
                left[hull] = _explain_gap(hull, heard)
        failed = tuple(dict.fromkeys(h.failed for h in heard if h.failed))
        return VlmAnswers(labels, left, failed, tuple(digest for h in heard for digest in h.asked))


class Labeller:
    """Labels meshes through a client; the answers come out the same however many questions are under way at once.

    examples: labelled meshes to be shown as examples.
    """

    def __init__(self, client: Client, manner: PromptConfig, examples: Iterable[SymbolicMesh] = ()) -> None:
        self._client, self._manner = client, manner
        self._examples = tuple(m for mesh in examples for m in example_messages(mesh, manner))
        self._workers = RequestThreads(client.endpoint.concurrency)

    def close(self) -> None:
        """Ask no more; what is under way is kept when its answer comes, yet not waited for."""
        self._workers.close()

    def build_questions(
        self, mesh: SymbolicMesh, wanted: Collection[str] | None = None, name: str = ""
    ) -> Iterator[HullQuestion]:
        """The questions that `begin` asks at first; nothing is sent."""
        return looks(mesh, mesh.index.keys() if wanted is None else wanted, self._manner, name)

    def begin(self, mesh: SymbolicMesh, wanted: Collection[str] | None = None, name: str = "") -> OpenAnswers:
        """Draw a mesh and ask about some hulls, by default all. Questions that get no answer leave their hulls open.

        name: that of the asset, told where the manner says so. All else as of `ask`.
        """
        names = [hull for hull in mesh.index if wanted is None or hull in wanted]
        return self.ask(names, self.build_questions(mesh, names, name))

    def ask(self, names: Sequence[str], asked: Iterable[HullQuestion]) -> OpenAnswers:
        """Ask about some hulls of a mesh, as its looks come. Waits where many questions are under way already."""
        answers = []
        for look in asked:
            answers.append(self._workers.submit(partial(self._ask_about, self.add_examples(look))))
            if self._client.end:  # what is drawn from here on would not be asked
                break
        return OpenAnswers(names, self._manner.vocabulary, answers)

    def add_examples(self, look: HullQuestion) -> HullQuestion:
        """A look as it is asked, behind the examples."""
        return look.show_examples(self._examples) if self._examples else look

    def label(self, mesh: SymbolicMesh, wanted: Collection[str] | None = None, name: str = "") -> VlmAnswers:
        """What the model says of a mesh; all as of `begin`."""
        return self.begin(mesh, wanted, name).result()

    def _ask_about(self, look: HullQuestion) -> _Response:
        """What a look brings; what the answer leaves open is asked once more."""
        asked: tuple[str, ...] = (self._digest(look.question),)
        try:
            votes, left, second = self._collect_votes(look, look.question)
        except QuestionError as error:
            return _Response(
                open=dict.fromkeys(look.hulls.values(), "the question got no answer"), failed=error.sentence
            )
        failed = None
        if second:
            try:
                more, left, _ = self._collect_votes(replace(look, hulls={n: look.hulls[n] for n in left}), second)
                votes, asked = votes | more, (*asked, self._digest(second))
            except QuestionError as error:
                failed = error.sentence
        return _Response(votes, {look.hulls[n]: why for n, why in left.items()}, failed, asked)

    def _digest(self, question: VlmQuestion) -> str:
        return question.digest(self._client.endpoint)

    def _collect_votes(
        self, look: HullQuestion, question: VlmQuestion
    ) -> tuple[dict[str, LabelVote], dict[int, str], VlmQuestion | None]:
        """The votes of an answer by hull, why numbers are left open, and the question that asks for these again."""
        reply = self._client.ask(question)
        vocabulary, unknown = self._manner.vocabulary, self._manner.unknown
        answer = read_answer(reply.text, look.hulls.keys(), vocabulary, unknown)
        sure = label_chances(reply, answer, vocabulary, unknown)
        votes = {
            look.hulls[number]: LabelVote(label, look.weights[look.hulls[number]], sure.get(number))
            for number, label in answer.said.items()
        }
        if not answer.open:
            return votes, {}, None
        why = "the answer was cut off" if reply.is_cut and not answer.odd else answer.problem
        back = (Message.assistant(reply.text[:_QUOTED] or "-"), retry_message(answer.open, answer.odd))
        limit = question.limit * 2 if reply.is_cut else question.limit
        second = replace(question, messages=(*question.messages, *back), limit=limit)
        return votes, dict.fromkeys(answer.open, why), second


def _explain_gap(hull: str, heard: Sequence[_Response]) -> str:
    if any(hull in h.votes for h in heard):
        return "the model does not know"
    failed = any(h.failed for h in heard)
    return next((h.open[hull] for h in heard if hull in h.open), _UNASKED if failed else _UNSEEN)


def example_messages(mesh: SymbolicMesh, manner: PromptConfig) -> tuple[Message, ...]:
    """A labelled mesh as a question with its answer; nothing where no hull has a label of the vocabulary."""
    from meshforge.rendering import draw_labeling_pictures

    labelled = [hull.name for hull in mesh.hulls if hull.label in manner.vocabulary][: manner.how.hulls]
    if not labelled:
        return ()
    taken = draw_labeling_pictures(mesh, hulls=labelled, most=min(2, manner.how.pictures), size=manner.how.size)
    shown = frozenset[str]().union(*(shot.numbered for shot in taken))
    numbers = {hull: mesh.index[hull] for hull in labelled if hull in shown}
    said = {number: mesh.hull_of(hull).label or manner.unknown for hull, number in numbers.items()}
    return question_message(taken, 0, numbers), example_answer(said)
