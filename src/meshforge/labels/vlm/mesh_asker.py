"""The hulls of a mesh asked about in threads, once more where something is open, and the answers added up."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from importlib.resources import files
from pathlib import Path
from typing import Any

from meshforge.common import relative_name, write_atomically
from meshforge.labels.vlm import prompt
from meshforge.labels.vlm.answer import LabelVote, decide_label, read_answer
from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.endpoint import QuestionError
from meshforge.labels.vlm.prompt import HullQuestion, PromptConfig
from meshforge.labels.vlm.question import Message
from meshforge.symbolic import Label, SymbolicMesh

_WAITING = 4  # questions for each thread that are under way or wait; asking more blocks until there is room
_UNANSWERED = "the question got no answer"
_QUOTED = 4000  # characters of an answer that are put before the model when it is asked again


@dataclass(frozen=True, slots=True)
class VlmAnswers:
    """What a model said of a mesh. labels: by hull; open: why others that were asked about have none, by hull.

    failed: complaints about questions that got no answer, in their order, each once; asked: the digests of all
    questions that got one.
    """

    labels: Mapping[str, Label] = field(default_factory=dict)
    open: Mapping[str, str] = field(default_factory=dict)
    failed: tuple[str, ...] = ()
    asked: tuple[str, ...] = ()


@dataclass(slots=True)
class _Response:
    """What came of one question: votes by hull, and why others have none."""

    votes: dict[str, LabelVote] = field(default_factory=dict)
    open: dict[str, str] = field(default_factory=dict)
    failed: str | None = None
    asked: list[str] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class OpenAnswers:
    """A mesh whose questions are under way."""

    names: Sequence[str]
    vocabulary: Sequence[str]
    responses: Sequence[Future[_Response]]

    def is_done(self) -> bool:
        return all(response.done() for response in self.responses)

    def result(self) -> VlmAnswers:
        """Return what the model said, when all of it is there."""
        responses = [response.result() for response in self.responses]
        failed = tuple(dict.fromkeys(one.failed for one in responses if one.failed))
        missing = "it was not asked about" if failed else "no picture shows it"
        labels, left = dict[str, Label](), dict[str, str]()
        for hull in self.names:
            votes = [one.votes[hull] for one in responses if hull in one.votes]
            if found := decide_label(votes, self.vocabulary):
                labels[hull] = Label(*found, "vlm")
            else:
                unknown = ["the model does not know"] if votes else []
                left[hull] = next(iter((*unknown, *(one.open[hull] for one in responses if hull in one.open))), missing)
        return VlmAnswers(labels, left, failed, tuple(digest for one in responses for digest in one.asked))


class MeshAsker:
    """Asks about meshes through a client; the answers come out the same however many questions are under way at once.

    examples: labelled meshes to be shown as examples.
    """

    def __init__(self, client: Client, config: PromptConfig, examples: Iterable[SymbolicMesh] = ()) -> None:
        self.config, self._client = config, client
        self._examples = tuple(m for mesh in examples for m in prompt.example_messages(mesh, config))
        concurrency = client.endpoint.settings.concurrency
        self._threads = ThreadPoolExecutor(concurrency, "asking")
        self._room = threading.BoundedSemaphore(_WAITING * concurrency)

    def close(self) -> None:
        """Ask no more; what is under way is kept when its answer comes, yet not waited for."""
        self._threads.shutdown(wait=False, cancel_futures=True)

    def ask(self, names: Sequence[str], questions: Iterable[HullQuestion]) -> OpenAnswers:
        """Ask about some hulls of a mesh, as they come. Waits where many questions are under way already."""
        responses = []
        for hull_question in questions:
            self._room.acquire()
            responses.append(self._threads.submit(self._ask_about, self.add_examples(hull_question)))
            responses[-1].add_done_callback(lambda _: self._room.release())
            if self._client.end:  # what is drawn from here on would not be asked
                break
        return OpenAnswers(names, self.config.vocabulary, responses)

    def add_examples(self, hull_question: HullQuestion) -> HullQuestion:
        """Return a question as it is sent, behind the examples."""
        return hull_question.show_examples(self._examples) if self._examples else hull_question

    def _ask_about(self, hull_question: HullQuestion) -> _Response:
        """The votes of one question; what its answer leaves open is asked once more."""
        found, hulls, question = _Response(), hull_question.hulls, hull_question.question
        left: Sequence[int] = list(hulls)
        for _ in range(2):
            try:
                reply = self._client.ask(question)
            except QuestionError as error:
                found.failed = error.sentence
                return found if found.asked else replace(found, open=dict.fromkeys(hulls.values(), _UNANSWERED))
            found.asked.append(question.digest(self._client.endpoint))
            answer = read_answer(reply.text, left, self.config.vocabulary, self.config.unknown)
            found.votes |= {hulls[n]: (label, hull_question.weights[n]) for n, label in answer.labels.items()}
            why = "the answer was cut off" if reply.is_cut and not answer.unrecognised else answer.problem
            left, found.open = answer.open, {hulls[number]: why for number in answer.open}
            if not left:
                break
            back = Message.assistant(reply.text[:_QUOTED] or "-"), prompt.retry_message(left, answer.unrecognised)
            limit = question.limit * 2 if reply.is_cut else question.limit
            question = replace(question, messages=(*question.messages, *back), limit=limit)
        return found


def write_page(folder: Path, name: str, answers: VlmAnswers) -> None:
    """Write `pages/NAME.html` into a folder of answers; name: that of the mesh, maybe with folders."""
    from jinja2 import Environment, StrictUndefined  # lazy: 0.05 s, only answers of a model need it

    path = folder / "pages" / f"{name}.html"
    kept = [_read_kept(folder / "answers" / f"{digest}.json") for digest in answers.asked]
    source = (files("meshforge.labels.vlm") / "page.html.j2").read_text("utf-8")
    template = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True).from_string(source)
    pictures = relative_name(folder / "pictures", path.parent)
    write_atomically(path, template.render(name=name, answers=answers, kept=kept, pictures=pictures))


def _read_kept(file: Path) -> Any:
    """A question with its answer, None where it cannot be read."""
    try:
        return json.loads(file.read_bytes())
    except (OSError, ValueError):
        return None
