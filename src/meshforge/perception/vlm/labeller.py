"""Labels of hulls from a vision-language model: shown, asked, asked once more, and added up."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field, replace
from functools import partial

from meshforge.perception.vlm.answer import read_answer
from meshforge.perception.vlm.certainty import chances
from meshforge.perception.vlm.client import Client
from meshforge.perception.vlm.evidence import Vote, verdict
from meshforge.perception.vlm.faults import AskingError
from meshforge.perception.vlm.looks import Look, looks
from meshforge.perception.vlm.manner import Manner
from meshforge.perception.vlm.prompt import again, example, request
from meshforge.perception.vlm.question import Message, Question
from meshforge.perception.vlm.workers import Workers
from meshforge.symbolic import Label, SymbolicMesh

_QUOTED = 4000  # characters of an answer that are put before the model when it is asked again
_UNSEEN, _UNASKED = "no picture shows it", "it was not asked about"


@dataclass(frozen=True, slots=True)
class Said:
    """What a model said of a mesh. labels: by hull; open: why others that were asked about have none, by hull.

    failed: complaints about questions that got no answer, in their order, each once; asked: the digests of all
    questions that got one.
    """

    labels: Mapping[str, Label] = field(default_factory=dict)
    open: Mapping[str, str] = field(default_factory=dict)
    failed: tuple[str, ...] = ()
    asked: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class _Heard:
    """What came of one look: votes by hull, or why there are none."""

    votes: Mapping[str, Vote] = field(default_factory=dict)
    open: Mapping[str, str] = field(default_factory=dict)
    failed: str | None = None
    asked: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Pending:
    """A mesh whose questions are under way."""

    names: Sequence[str]
    vocabulary: Sequence[str]
    answers: Sequence[Future[_Heard]]

    def is_done(self) -> bool:
        return all(answer.done() for answer in self.answers)

    def result(self) -> Said:
        """What the model said, when all of it is there."""
        heard = [answer.result() for answer in self.answers]
        labels, left = dict[str, Label](), dict[str, str]()
        for hull in self.names:
            found = verdict([h.votes[hull] for h in heard if hull in h.votes], self.vocabulary)
            if found:
                labels[hull] = Label(*found, "vlm")
            else:
                left[hull] = _why(hull, heard)
        failed = tuple(dict.fromkeys(h.failed for h in heard if h.failed))
        return Said(labels, left, failed, tuple(digest for h in heard for digest in h.asked))


class Labeller:
    """Labels meshes through a client; the answers come out the same however many questions are under way at once.

    examples: labelled meshes to be shown as examples.
    """

    def __init__(self, client: Client, manner: Manner, examples: Iterable[SymbolicMesh] = ()) -> None:
        self._client, self._manner = client, manner
        self._examples = tuple(m for mesh in examples for m in shown_as_example(mesh, manner))
        self._workers = Workers(client.endpoint.concurrency)

    def close(self) -> None:
        """Ask no more; what is under way is kept when its answer comes, yet not waited for."""
        self._workers.close()

    def build_questions(self, mesh: SymbolicMesh, wanted: Collection[str] | None = None, name: str = "") -> Iterator[Look]:
        """The questions that `begin` asks at first; nothing is sent."""
        return looks(mesh, mesh.index.keys() if wanted is None else wanted, self._manner, name)

    def begin(self, mesh: SymbolicMesh, wanted: Collection[str] | None = None, name: str = "") -> Pending:
        """Draw a mesh and ask about some hulls, by default all. Questions that get no answer leave their hulls open.

        name: that of the asset, told where the manner says so. All else as of `ask`.
        """
        names = [hull for hull in mesh.index if wanted is None or hull in wanted]
        return self.ask(names, self.build_questions(mesh, names, name))

    def ask(self, names: Sequence[str], asked: Iterable[Look]) -> Pending:
        """Ask about some hulls of a mesh, as its looks come. Waits where many questions are under way already."""
        answers = []
        for look in asked:
            answers.append(self._workers.submit(partial(self._ask_about, self.add_examples(look))))
            if self._client.end:  # what is drawn from here on would not be asked
                break
        return Pending(names, self._manner.vocabulary, answers)

    def add_examples(self, look: Look) -> Look:
        """A look as it is asked, behind the examples."""
        return look.show_examples(self._examples) if self._examples else look

    def label(self, mesh: SymbolicMesh, wanted: Collection[str] | None = None, name: str = "") -> Said:
        """What the model says of a mesh; all as of `begin`."""
        return self.begin(mesh, wanted, name).result()

    def _ask_about(self, look: Look) -> _Heard:
        """What a look brings; what the answer leaves open is asked once more."""
        asked: tuple[str, ...] = (self._digest(look.question),)
        try:
            votes, left, second = self._collect_votes(look, look.question)
        except AskingError as error:
            return _Heard(open=dict.fromkeys(look.hulls.values(), "the question got no answer"), failed=error.sentence)
        failed = None
        if second:
            try:
                more, left, _ = self._collect_votes(replace(look, hulls={n: look.hulls[n] for n in left}), second)
                votes, asked = votes | more, (*asked, self._digest(second))
            except AskingError as error:
                failed = error.sentence
        return _Heard(votes, {look.hulls[n]: why for n, why in left.items()}, failed, asked)

    def _digest(self, question: Question) -> str:
        return question.digest(self._client.endpoint)

    def _collect_votes(self, look: Look, question: Question) -> tuple[dict[str, Vote], dict[int, str], Question | None]:
        """The votes of an answer by hull, why numbers are left open, and the question that asks for these again."""
        reply = self._client.ask(question)
        vocabulary, unknown = self._manner.vocabulary, self._manner.unknown
        answer = read_answer(reply.text, look.hulls.keys(), vocabulary, unknown)
        sure = chances(reply, answer, vocabulary, unknown)
        votes = {
            look.hulls[number]: Vote(label, look.weights[look.hulls[number]], sure.get(number))
            for number, label in answer.said.items()
        }
        if not answer.open:
            return votes, {}, None
        why = "the answer was cut off" if reply.is_cut and not answer.odd else answer.problem
        back = (Message.assistant(reply.text[:_QUOTED] or "-"), again(answer.open, answer.odd))
        limit = question.limit * 2 if reply.is_cut else question.limit
        second = replace(question, messages=(*question.messages, *back), limit=limit)
        return votes, dict.fromkeys(answer.open, why), second


def _why(hull: str, heard: Sequence[_Heard]) -> str:
    if any(hull in h.votes for h in heard):
        return "the model does not know"
    failed = any(h.failed for h in heard)
    return next((h.open[hull] for h in heard if hull in h.open), _UNASKED if failed else _UNSEEN)


def shown_as_example(mesh: SymbolicMesh, manner: Manner) -> tuple[Message, ...]:
    """A labelled mesh as a question with its answer; nothing where no hull has a label of the vocabulary."""
    from meshforge.views import shots

    labelled = [hull.name for hull in mesh.hulls if hull.label in manner.vocabulary][: manner.how.hulls]
    if not labelled:
        return ()
    taken = shots(mesh, hulls=labelled, most=min(2, manner.how.pictures), size=manner.how.size)
    shown = frozenset[str]().union(*(shot.numbered for shot in taken))
    numbers = {hull: mesh.index[hull] for hull in labelled if hull in shown}
    said = {number: mesh.hull_of(hull).label or manner.unknown for hull, number in numbers.items()}
    return request(taken, 0, numbers), example(said)
