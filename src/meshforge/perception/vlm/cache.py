"""Answers on disk, by what was asked: to go on after an interruption, to ask for nothing again, and to look at."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from meshforge.files import write_atomically
from meshforge.perception.vlm.endpoint import Endpoint
from meshforge.perception.vlm.question import Question
from meshforge.perception.vlm.reply import Reply, Token, Usage

_ANY_BYTES = "latin-1"  # tokens may be parts of characters


class _Answer(BaseModel):
    """What came back, as it is kept; tokens: the text, the chance and the chances of others of each."""

    model_config = ConfigDict(frozen=True)

    text: str
    finish: str
    input_tokens: int
    output_tokens: int
    estimated: bool = False
    cost: float
    tokens: tuple[tuple[str, float, dict[str, float]], ...] | None = None


class Cache:
    """A folder of answers: `answers/DIGEST.json` holds what was sent and what came back, `pictures/` the pictures."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def read(self, question: Question, endpoint: Endpoint) -> Reply | None:
        """The answer to a question, None where there is none, or none that can be read."""
        try:
            data = json.loads(self.path(question, endpoint).read_bytes())
            answer = _Answer.model_validate(data["answered"] | {"tokens": data["tokens"]})
            return _reply(answer) if data["asked"] == _plain(question.document(endpoint)) else None
        except (OSError, ValueError, KeyError, TypeError, ValidationError):
            return None

    def write(self, question: Question, endpoint: Endpoint, reply: Reply) -> None:
        """Keep an answer. The pictures are written first, so that an answer that is there has them."""
        for digest, picture in zip(question.digests, question.pictures, strict=True):
            path = self.folder / "pictures" / f"{digest}.png"
            if not path.exists():
                write_atomically(path, picture)
        answer = _answer(reply).model_dump(exclude_defaults=True)
        tokens = json.dumps(answer.pop("tokens", None))  # hundreds of them, in one line
        asked, answered = (
            json.dumps(value, ensure_ascii=False, indent=1) for value in (question.document(endpoint), answer)
        )
        text = f'{{\n"asked": {asked},\n"answered": {answered},\n"tokens": {tokens}\n}}\n'
        write_atomically(self.path(question, endpoint), text)

    def path(self, question: Question, endpoint: Endpoint) -> Path:
        """The file of a question and its answer."""
        return self.folder / "answers" / f"{question.digest(endpoint)}.json"


def _plain(document: dict[str, Any]) -> Any:
    """A document as it comes back from JSON."""
    return json.loads(json.dumps(document))


def _answer(reply: Reply) -> _Answer:
    usage, tokens = reply.usage or Usage(), None
    if reply.tokens is not None:
        tokens = tuple(
            (_text(token.text), token.chance, {_text(other): chance for other, chance in token.others.items()})
            for token in reply.tokens
        )
    return _Answer(
        text=reply.text,
        finish=reply.finish,
        input_tokens=usage.input,
        output_tokens=usage.output,
        estimated=usage.estimated,
        cost=reply.cost,
        tokens=tokens,
    )


def _reply(answer: _Answer) -> Reply:
    usage, tokens = Usage(answer.input_tokens, answer.output_tokens, answer.estimated), None
    if answer.tokens is not None:
        tokens = tuple(
            Token(_bytes(text), chance, {_bytes(other): c for other, c in others.items()})
            for text, chance, others in answer.tokens
        )
    return Reply(answer.text, answer.finish, usage, tokens, answer.cost, cached=True)


def _text(token: bytes) -> str:
    return token.decode(_ANY_BYTES)


def _bytes(text: str) -> bytes:
    return text.encode(_ANY_BYTES)
