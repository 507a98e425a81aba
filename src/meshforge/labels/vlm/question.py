"""A question to a model, its request and its answer, and the folder that keeps both: none is paid for twice."""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from typing import Any, Literal

from meshforge.common import write_atomically
from meshforge.labels.vlm.endpoint import Endpoint, TokenCount
from meshforge.rendering import encode_png

_SIDE = 512  # pixels: one tile for those models that cut pictures up, so that it tells how they count them

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
        parts = ([{"picture": next(names)} if isinstance(p, bytes) else p for p in m.parts] for m in self.messages)
        settings = endpoint.settings
        return {"base_url": endpoint.place, "model": settings.model, "extra": dict(settings.extra)} | {
            "temperature": self.temperature,
            "limit": self.limit,
            "repeat": self.repeat,
            "schema": self.schema,
            "messages": [{"role": m.role, "parts": own} for m, own in zip(self.messages, parts, strict=True)],
        }

    def digest(self, endpoint: Endpoint) -> str:
        """Return thirty-two hexadecimal digits, the same for the same question to the same model."""
        return _digest(json.dumps(self.document(endpoint), ensure_ascii=True, sort_keys=True).encode())


_OPTIONAL = {"response_format": "schema", "temperature": "temperature", "max_tokens": "max_tokens"}
"""What servers may refuse, with the word by which they complain about it; the first that can be spared first. In place
of the last there is another name."""


def build_body(question: VlmQuestion, endpoint: Endpoint, refused: Collection[str] = ()) -> dict[str, Any]:
    """Return the request that puts a question to the model; refused: what is left out of it."""
    form = {"name": "answer", "strict": True, "schema": question.schema}
    every: dict[str, Any] = {
        "model": endpoint.settings.model,
        "messages": [{"role": m.role, "content": _format_content(m)} for m in question.messages],
        "response_format": {"type": "json_schema", "json_schema": form} if question.schema else None,
        "temperature": question.temperature,
        "max_tokens": question.limit,
        "max_completion_tokens": question.limit if "max_tokens" in refused else None,
    }
    kept = {name: value for name, value in every.items() if value is not None and name not in refused}
    return kept | dict(endpoint.settings.extra)


def find_refused(complaint: str, refused: Collection[str], *, is_first: bool) -> str | None:
    """Return what a server complains about, or else what can be spared next, after the first question only the schema;
    None: nothing."""
    left = {name: word for name, word in _OPTIONAL.items() if name not in refused}
    named = (name for name, word in left.items() if word in complaint.lower() or name in complaint.lower())
    return next(named, next((name for name in left if is_first or name == "response_format"), None))


def _format_content(message: Message) -> Any:
    """Plain text where there is nothing else, which every server takes."""
    if all(isinstance(part, str) for part in message.parts):
        return "\n".join(str(part) for part in message.parts)
    return [
        {"type": "text", "text": part}
        if isinstance(part, str)
        else {"type": "image_url", "image_url": {"url": f"data:image/png;base64,{base64.b64encode(part).decode()}"}}
        for part in message.parts
    ]


@cache
def probe_question() -> VlmQuestion:
    """Return a small question that is asked first: which colour is this?"""
    from PIL import Image  # lazy: only a probe of a server draws this picture

    colour = {"type": "string", "enum": ["red", "green", "blue"]}
    schema = {"type": "object", "properties": {"colour": colour}, "required": ["colour"], "additionalProperties": False}
    picture = encode_png(Image.new("RGB", (_SIDE, _SIDE), (220, 30, 30)))
    return VlmQuestion((Message.user("Which of these colours is this picture: red, green, blue?", picture),), schema)


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


@dataclass(frozen=True, slots=True)
class AnswerCache:
    """A folder of answers: `answers/DIGEST.json` holds what was sent and what came back, `pictures/` the pictures."""

    folder: Path

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
