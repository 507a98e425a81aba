"""Questions asked, and what their answers say of hulls, read leniently."""

import json
import re
from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

from meshforge.common import join_names
from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.endpoint import QuestionError
from meshforge.labels.vlm.prompt import HullKey, HullQuestion, PromptConfig
from meshforge.symbolic import Label

_ENTRY = re.compile(r'"#?(\d{1,9})"\s*:\s*"((?:[^"\\]|\\.)*)"')
_UNANSWERED = "the question got no answer"
_NOT_KNOWN = "the model does not know"
_MOST_SHOWN = 60  # characters of a word that is no label
_CONFIDENCE = 0.71  # of a label that a model gives; not measured


def read_answer(text: str, asked: Iterable[int], words: Sequence[str]) -> tuple[dict[int, str], dict[int, str]]:
    """Return the labels that a text gives, and why it gives none, both by number; it may be JSON, JSON in chatter or
    code fences, or JSON that is cut off.

    words: that it may say. Numbers that were not asked about are passed over; one with two labels gets none.
    """
    forms = ((word, form) for word in reversed(words) for form in (word, json.dumps(word)[1:-1]))
    known = {_normalize(form): word for word, form in forms} | {word: word for word in words}
    found = defaultdict[int, dict[str, None]](dict)
    for number, word in _ENTRY.findall(text.rpartition('"hulls"')[2]):  # before it a model may think aloud
        found[int(number)][known.get(word) or known.get(_normalize(word), word[:_MOST_SHOWN])] = None
    labels, left = dict[int, str](), dict[int, str]()
    for number in asked:
        match [*found[number]]:
            case [word] if word in words:
                labels[number] = word
            case []:
                left[number] = "the model said nothing usable of it"
            case other:
                left[number] = f"the model said {join_names(other)}, which is no label"
    return labels, left


def _normalize(word: str) -> str:
    """A word without what models change at whim: case, spaces for underscores, marks about it."""
    return " ".join(re.sub(r"[\s_\-]+", " ", word.strip().strip("\"'`*.")).casefold().split())


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
    """Return what a model says of hulls, or of those that are wanted."""
    labels, left = defaultdict[str, dict[str, Label]](dict), defaultdict[str, dict[str, str]](dict)
    failed, words = dict[str, None](), (*config.vocabulary, config.unknown)
    for one in questions:
        try:
            reply = client.ask(one.question)
            answer, why = read_answer(reply.text, one.hulls, words)
            why = dict.fromkeys(why, "the answer was cut off: raise room in [vlm]") if reply.finish == "length" else why
        except QuestionError as error:
            failed[error.sentence] = None
            answer, why = {}, dict.fromkeys(one.hulls, _UNANSWERED)
        why |= {number: _NOT_KNOWN for number, label in answer.items() if label == config.unknown}
        for number, (asset, hull) in one.hulls.items():
            if number in answer and (wanted is None or (asset, hull) in wanted):
                labels[asset][hull] = Label(answer[number], _CONFIDENCE, "vlm")
            if number in why and (wanted is None or (asset, hull) in wanted):
                left[asset][hull] = why[number]
    return VlmAnswers(labels, left, tuple(failed))
