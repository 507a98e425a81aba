"""What a model answered, read leniently from what the server sent."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class Usage:
    """Tokens that went in and came out; estimated: not told by the server."""

    input: int = 0
    output: int = 0
    estimated: bool = False

    def __add__(self, other: Usage) -> Usage:
        estimated = self.estimated or other.estimated
        return Usage(self.input + other.input, self.output + other.output, estimated)


@dataclass(frozen=True, slots=True)
class Token:
    """A token of an answer with its chance, and the chances of those that were likeliest in its place."""

    text: bytes
    chance: float
    others: Mapping[bytes, float]


@dataclass(frozen=True, slots=True)
class Reply:
    """An answer. finish: why it ends, `stop` or `length` mostly; usage: None where the server does not tell.

    tokens: None where the server gives no log-probabilities; cost: what it cost when it was given [$]; cached: that was
    earlier, and this time it cost nothing.
    """

    text: str
    finish: str = "stop"
    usage: Usage | None = None
    tokens: tuple[Token, ...] | None = None
    cost: float = 0.0
    cached: bool = False

    @property
    def is_cut(self) -> bool:
        """Whether the answer ends where its room ended."""
        return self.finish == "length"


class NoReplyError(ValueError):
    """Something came back that is no answer. usage: what it cost all the same, where that is told."""

    def __init__(self, problem: str, usage: Usage | None = None) -> None:
        super().__init__(problem)
        self.usage = usage


def read_reply(data: Any) -> Reply:
    """The answer in a response of `chat/completions`. Raises NoReplyError."""
    usage = _usage(data.get("usage")) if isinstance(data, Mapping) else None
    match data:
        case {"choices": [{"message": {**message}, **choice}, *_]}:
            finish = choice.get("finish_reason")
            tokens = _tokens(choice.get("logprobs"))
            text = _text(message).encode(errors="replace").decode()  # half a surrogate pair cannot be written to a file
            return Reply(text, finish if isinstance(finish, str) else "stop", usage, tokens)
    raise NoReplyError("the server sent something that is no answer", usage)


def _text(message: Mapping[Any, Any]) -> str:
    """The text of a message; some servers send it in parts, and a refusal in a field of its own."""
    match message.get("content"):
        case str(text) if text:
            return text
        case [*parts]:
            return "".join(
                part["text"] for part in parts if isinstance(part, dict) and isinstance(part.get("text"), str)
            )
    refusal = message.get("refusal")
    return refusal if isinstance(refusal, str) else ""


def _usage(data: Any) -> Usage | None:
    match data:
        case {"prompt_tokens": int(given), "completion_tokens": int(made)} if given >= 0 and made >= 0:
            return Usage(given, made)
        case {"prompt_tokens": int(given), "total_tokens": int(total)} if 0 <= given <= total:
            return Usage(given, total - given)
    return None


def _tokens(data: Any) -> tuple[Token, ...] | None:
    """The tokens with their chances, None where there are none or one is not of the usual form."""
    match data:
        case {"content": [_, *_] as rows}:
            made = [_token(row) for row in rows]
            tokens = tuple(token for token in made if token)
            return tokens if len(tokens) == len(rows) else None
    return None


def _token(row: Any) -> Token | None:
    match row:
        case {"token": str(), "logprob": float() | int() as logprob}:
            top = row.get("top_logprobs")
            others = [_token({**other, "top_logprobs": None}) for other in top or () if isinstance(other, dict)]
            return Token(_bytes(row), _chance(logprob), {other.text: other.chance for other in others if other})
    return None


def _bytes(row: Mapping[Any, Any]) -> bytes:
    raw = row.get("bytes")
    if isinstance(raw, list) and raw and all(isinstance(b, int) and 0 <= b < 256 for b in raw):
        return bytes(raw)
    return str(row["token"]).encode("utf-8", "surrogatepass")


def _chance(logprob: float) -> float:
    return math.exp(min(logprob, 0.0)) if not math.isnan(logprob) else 0.0
