"""A question to a model: messages of texts and pictures, and the form that the answer must have."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

from meshforge.perception.vlm.endpoint import Endpoint

Part = str | bytes
"""A text, or a picture as a PNG file."""


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
class Question:
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
        """The digest of each picture."""
        return tuple(picture_digest(picture) for picture in self.pictures)

    def document(self, endpoint: Endpoint) -> dict[str, Any]:
        """All that the answer depends on, with digests in place of pictures; there is no key in it."""
        names = iter(self.digests)
        return {
            "base_url": endpoint.place,
            "model": endpoint.model,
            "extra": dict(endpoint.extra),
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
        """Thirty-two hexadecimal digits, the same for the same question to the same model."""
        text = json.dumps(self.document(endpoint), ensure_ascii=True, sort_keys=True)
        return hashlib.blake2b(text.encode(), digest_size=16).hexdigest()


def picture_digest(picture: bytes) -> str:
    """Thirty-two hexadecimal digits of a picture file."""
    return hashlib.blake2b(picture, digest_size=16).hexdigest()
