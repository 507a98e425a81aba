"""A question to a model, the answer to it, and the folder that keeps both, so that none is paid for twice."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

from meshforge.common import write_atomically
from meshforge.labels.vlm.endpoint import Endpoint, TokenCount

Part = str | bytes
"""A text, or a picture as a PNG file."""


def _digest(data: bytes) -> str:
    return hashlib.blake2b(data, digest_size=16).hexdigest()


@dataclass(frozen=True, slots=True)
class Message:
    """What one side says."""

    role: Literal["system", "user", "assistant"]
    parts: tuple[Part, ...]

    @staticmethod
    def system(text: str) -> Message:
        return Message("system", (text,))

    @staticmethod
    def user(*parts: Part) -> Message:
        return Message("user", parts)

    @staticmethod
    def assistant(text: str) -> Message:
        return Message("assistant", (text,))


@dataclass(frozen=True)
class VlmQuestion:
    """Messages that end with one of the user's.

    schema: the JSON schema of the answer, None for plain text; limit: tokens that the answer may have; repeat: a number
    that tells apart the same question asked several times.
    """

    messages: tuple[Message, ...]
    schema: Mapping[str, Any] | None = None
    limit: int = 2000
    temperature: float = 0.0
    repeat: int = 0

    @property
    def pictures(self) -> Iterator[bytes]:
        """All pictures, in their order."""
        return (part for message in self.messages for part in message.parts if isinstance(part, bytes))

    @property
    def text(self) -> str:
        """All texts, one after the other."""
        return "\n".join(part for message in self.messages for part in message.parts if isinstance(part, str))

    @cached_property
    def digests(self) -> tuple[str, ...]:
        """Thirty-two hexadecimal digits of each picture file."""
        return tuple(map(_digest, self.pictures))

    def document(self, endpoint: Endpoint) -> dict[str, Any]:
        """Return all that the answer depends on, with digests in place of pictures; there is no key in it."""
        names = iter(self.digests)
        return {
            "base_url": endpoint.place,
            "model": endpoint.settings.model,
            "extra": dict(endpoint.settings.extra),
            "temperature": self.temperature,
            "limit": self.limit,
            "repeat": self.repeat,
            "schema": self.schema,
            "messages": [
                {
                    "role": message.role,
                    "parts": [{"picture": next(names)} if isinstance(part, bytes) else part for part in message.parts],
                }
                for message in self.messages
            ],
        }

    def digest(self, endpoint: Endpoint) -> str:
        """Return thirty-two hexadecimal digits, the same for the same question to the same model."""
        return _digest(json.dumps(self.document(endpoint), ensure_ascii=True, sort_keys=True).encode())


@dataclass(frozen=True, slots=True)
class Reply:
    """An answer. finish: why it ends, `stop` or `length` mostly; usage: None where the server names none.

    cost: what it cost when it was given [$]; cached: that was earlier, and this time it cost nothing.
    """

    text: str
    finish: str = "stop"
    usage: TokenCount | None = None
    cost: float = 0.0
    cached: bool = False

    @property
    def is_cut(self) -> bool:
        """Whether the answer ends where its room ended."""
        return self.finish == "length"


class AnswerCache:
    """A folder of answers: `answers/DIGEST.json` holds what was sent and what came back, `pictures/` the pictures."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def read(self, question: VlmQuestion, endpoint: Endpoint) -> Reply | None:
        """Return the answer to a question, None where there is none, or none that can be read."""
        try:
            kept = json.loads(self._path(question, endpoint).read_bytes())["answered"]
            usage = TokenCount(int(kept["input_tokens"]), int(kept["output_tokens"]), bool(kept.get("estimated")))
            return Reply(str(kept["text"]), str(kept["finish"]), usage, float(kept["cost"]), cached=True)
        except (OSError, ValueError, LookupError, TypeError, AttributeError):
            return None

    def write(self, question: VlmQuestion, endpoint: Endpoint, reply: Reply) -> None:
        """Keep an answer. The pictures are written first, so that an answer that is there has them."""
        for digest, picture in zip(question.digests, question.pictures, strict=True):
            path = self.folder / "pictures" / f"{digest}.png"
            if not path.exists():
                write_atomically(path, picture)
        usage = reply.usage or TokenCount()
        kept = {"text": reply.text, "finish": reply.finish, "input_tokens": usage.input, "output_tokens": usage.output}
        kept |= {"estimated": True} if usage.estimated else {}
        document = {"asked": question.document(endpoint), "answered": kept | {"cost": reply.cost}}
        write_atomically(self._path(question, endpoint), json.dumps(document, ensure_ascii=False, indent=1) + "\n")

    def _path(self, question: VlmQuestion, endpoint: Endpoint) -> Path:
        return self.folder / "answers" / f"{question.digest(endpoint)}.json"
