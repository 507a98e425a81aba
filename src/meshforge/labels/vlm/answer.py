"""Questions asked, once more where something is open, and what their answers say of hulls, read leniently."""

import json
import re
from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from meshforge.common import join_names
from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.endpoint import QuestionError
from meshforge.labels.vlm.prompt import HullKey, HullQuestion, PromptConfig
from meshforge.labels.vlm.question import Message, Reply, VlmQuestion
from meshforge.symbolic import Label

_OBJECT = re.compile(r"\{[^{}]*\}")
_NUMBER = re.compile(r"#?\s*(\d{1,9})(?:\.0)?")
_AGAIN = """\
That answer leaves something open{why}. Answer again in the same form, for these numbers only: {numbers}."""
_UNANSWERED = "the question got no answer"
_NOT_KNOWN = "the model does not know"
_QUOTED = 4000  # characters of an answer that are put before the model when it is asked again
_MOST_SHOWN = 60  # characters of a word that is no label
_CONFIDENCE = 0.71  # of a label that a model gives; not measured


@dataclass(frozen=True, slots=True)
class HullAnswer:
    """What was said of the hulls asked about. labels: by number, among them that for unknown.

    odd: words that are no labels; open: numbers asked about of which nothing usable was said, in their order.
    """

    labels: Mapping[int, str]
    unrecognised: tuple[str, ...]
    open: tuple[int, ...]

    @property
    def problem(self) -> str:
        """Why hulls are left open, in words; empty where none is."""
        if not self.open:
            return ""
        if self.unrecognised:
            return f"the model said {join_names(self.unrecognised)}, which is no label"
        return "the model said nothing usable of it"


def read_answer(text: str, asked: Collection[int], words: Sequence[str]) -> HullAnswer:
    """Return what a text says, be it JSON, JSON in chatter or code fences, or JSON that is cut off.

    words: that it may say. Numbers that were not asked about are passed over; one with two labels is left open.
    """
    known, found = {_normalize(word): word for word in reversed(words)}, dict[int, set[str]]()
    unrecognised = dict[str, None]()
    for number, word in _entries(text):
        if number not in asked:
            continue
        if label := word if word in words else known.get(_normalize(word)):
            found.setdefault(number, set()).add(label)
        else:
            unrecognised[word[:_MOST_SHOWN]] = None
    labels = {number: labels.pop() for number, labels in sorted(found.items()) if len(labels) == 1}
    return HullAnswer(labels, tuple(unrecognised), tuple(number for number in sorted(asked) if number not in labels))


def _normalize(word: str) -> str:
    """A word without what models change at whim: case, spaces for underscores, marks about it."""
    return " ".join(re.sub(r"[\s_\-]+", " ", word.strip().strip("\"'`*.")).casefold().split())


def _entries(text: str) -> Iterator[tuple[int, str]]:
    """The numbers with their words in the last list of hulls: before it a model may think aloud."""
    _, _, last = text.rpartition('"hulls"')
    for part in _OBJECT.findall(last):
        try:
            found = json.loads(part)
        except ValueError:
            continue
        rows = [(found["number"], found.get("label"))] if "number" in found else found.items()
        for number, word in rows:
            if isinstance(word, str) and (match := _NUMBER.fullmatch(str(number).strip())):
                yield int(match[1]), word


def ask_again(question: VlmQuestion, reply: Reply, answer: HullAnswer) -> VlmQuestion:
    """Return the question with its answer, and words that ask for what that left open; with more room if it was cut."""
    odd = ", ".join(json.dumps(word, ensure_ascii=False) for word in answer.unrecognised)
    why = f" ({odd} {'is no label' if len(answer.unrecognised) == 1 else 'are no labels'})" if odd else ""
    text = _AGAIN.format(why=why, numbers=", ".join(map(str, answer.open)))
    messages = *question.messages, Message.assistant(reply.text[:_QUOTED] or "-"), Message.user(text)
    return replace(question, messages=messages, limit=question.limit * (2 if reply.is_cut else 1))


@dataclass(frozen=True, slots=True)
class VlmAnswers:
    """What a model said of hulls. labels: by asset and hull, also that for unknown; open: why hulls that were asked
    about have none, or that.

    failed: complaints about questions that got no answer, in their order, each once.
    """

    labels: Mapping[str, Mapping[str, Label]]
    open: Mapping[str, Mapping[str, str]]
    failed: tuple[str, ...]


def ask_questions(
    client: Client, config: PromptConfig, questions: Iterable[HullQuestion], wanted: Collection[HullKey] | None = None
) -> VlmAnswers:
    """Return what a model says of hulls, or of those that are wanted; what an answer leaves open is asked once more."""
    said, why, failed = dict[HullKey, str](), dict[HullKey, str](), dict[str, None]()
    words = (*config.vocabulary, config.unknown)
    for one in questions:
        question, left = one.question, tuple(one.hulls)
        why |= dict.fromkeys(one.hulls.values(), _UNANSWERED)
        for _ in range(2):
            try:
                reply = client.ask(question)
            except QuestionError as error:
                failed[error.sentence] = None
                break
            answer = read_answer(reply.text, left, words)
            said |= {one.hulls[number]: label for number, label in answer.labels.items()}
            left = answer.open
            cause = "the answer was cut off" if reply.is_cut and not answer.unrecognised else answer.problem
            why |= {one.hulls[number]: cause for number in left}
            if not left:
                break
            question = ask_again(question, reply, answer)
    why |= {key: _NOT_KNOWN for key, label in said.items() if label == config.unknown}
    labels, left_open = defaultdict[str, dict[str, Label]](dict), defaultdict[str, dict[str, str]](dict)
    for asset, hull in why if wanted is None else filter(wanted.__contains__, why):
        label = said.get((asset, hull), config.unknown)
        if (asset, hull) in said:
            labels[asset][hull] = Label(label, _CONFIDENCE, "vlm")
        if label == config.unknown:
            left_open[asset][hull] = why[asset, hull]
    return VlmAnswers(dict(labels), dict(left_open), tuple(failed))
