"""A question to a model, its request and its answer, and the folder that keeps both: none is paid for twice."""

import base64
import hashlib
import json
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any, Literal

from pydantic import TypeAdapter

from meshforge.common import write_atomically
from meshforge.labels.vlm.endpoint import Endpoint
from meshforge.rendering import encode_png

_SIDE = 512  # pixels: one tile for those models that cut pictures up, so that it tells how they count them

Part = str | bytes
"""A text, or a picture as a PNG file."""


def _digest(data: bytes) -> str:
    return hashlib.blake2b(data, digest_size=16).hexdigest()


def _to_url(picture: bytes) -> str:
    return f"data:image/png;base64,{base64.b64encode(picture).decode()}"


@dataclass(frozen=True, slots=True)
class Message:
    """What one side says."""

    role: Literal["system", "user", "assistant"]
    parts: tuple[Part, ...]

    def to_json(self, to_url: Callable[[bytes], str]) -> dict[str, Any]:
        """Return it as a request has it; plain text where there is nothing else, which every server takes."""
        content: Any = [
            {"type": "text", "text": part}
            if isinstance(part, str)
            else {"type": "image_url", "image_url": {"url": to_url(part)}}
            for part in self.parts
        ]
        if all(isinstance(part, str) for part in self.parts):
            content = "\n".join(map(str, self.parts))
        return {"role": self.role, "content": content}


@dataclass(frozen=True, slots=True)
class VlmQuestion:
    """Messages that end with one of the user's.

    schema: the JSON schema of the answer, None for plain text; limit: tokens that the answer may have.
    """

    messages: tuple[Message, ...]
    schema: Mapping[str, Any] | None = None
    limit: int = 2000

    @property
    def pictures(self) -> Iterator[bytes]:
        """All pictures, in their order."""
        return (part for message in self.messages for part in message.parts if isinstance(part, bytes))

    @property
    def text(self) -> str:
        """All texts, one after the other."""
        return "\n".join(part for message in self.messages for part in message.parts if isinstance(part, str))

    def to_body(
        self, endpoint: Endpoint, refused: Collection[str] = (), to_url: Callable[[bytes], str] = _to_url
    ) -> dict[str, Any]:
        """Return the request that puts it to the model; refused: what is left out of it."""
        form = {"name": "answer", "strict": True, "schema": self.schema}
        every: dict[str, Any] = {
            "model": endpoint.settings.model,
            "messages": [message.to_json(to_url) for message in self.messages],
            "response_format": {"type": "json_schema", "json_schema": form} if self.schema else None,
            "temperature": 0.0,
            "max_tokens": self.limit,
            "max_completion_tokens": self.limit if "max_tokens" in refused else None,
        }
        kept = {name: value for name, value in every.items() if value is not None and name not in refused}
        return kept | dict(endpoint.settings.extra)

    def to_document(self, endpoint: Endpoint) -> dict[str, Any]:
        """Return all that the answer depends on, with digests in place of pictures; there is no key in it."""
        return {"base_url": endpoint.place, **self.to_body(endpoint, to_url=_digest)}

    def digest(self, endpoint: Endpoint) -> str:
        """Return thirty-two hexadecimal digits, the same for the same question to the same model."""
        return _digest(json.dumps(self.to_document(endpoint), sort_keys=True).encode())


def make_object_schema(**fields: Any) -> dict[str, Any]:
    """Return the JSON schema of an object that has these fields and no others."""
    return {"type": "object", "properties": fields, "required": [*fields], "additionalProperties": False}


@cache
def probe_question() -> VlmQuestion:
    """Return a small question that is asked first: which colour is this?"""
    from PIL import Image  # lazy: only a probe of a server draws this picture

    schema = make_object_schema(colour={"type": "string", "enum": ["red", "green", "blue"]})
    picture = encode_png(Image.new("RGB", (_SIDE, _SIDE), (220, 30, 30)))
    text = "Which of these colours is this picture: red, green, blue?"
    return VlmQuestion((Message("user", (text, picture)),), schema)


@dataclass(frozen=True, slots=True)
class Reply:
    """An answer. finish: why it ends, `length` where its room did; estimated: the server did not name its tokens.

    cost: what it cost when it was given [$].
    """

    text: str
    finish: str = "stop"
    input_tokens: int = 0
    output_tokens: int = 0
    estimated: bool = False
    cost: float = 0.0


_REPLY = TypeAdapter(Reply)


@dataclass(frozen=True, slots=True)
class AnswerCache:
    """A folder of answers: `answers/DIGEST.json` holds what was sent and what came back, `pictures/` the pictures."""

    folder: Path

    def read(self, question: VlmQuestion, endpoint: Endpoint) -> Reply | None:
        """Return the answer to a question, None where there is none, or none that can be read."""
        try:
            kept = json.loads(self._path(question, endpoint).read_bytes())
            return _REPLY.validate_python(kept["answered"])
        except (OSError, ValueError, LookupError, TypeError):
            return None

    def write(self, question: VlmQuestion, endpoint: Endpoint, reply: Reply) -> None:
        """Keep an answer. The pictures are written first, so that an answer that is there has them."""
        for picture in question.pictures:
            path = self.folder / "pictures" / f"{_digest(picture)}.png"
            if not path.exists():
                write_atomically(path, picture)
        document = {"asked": question.to_document(endpoint), "answered": asdict(reply)}
        write_atomically(self._path(question, endpoint), json.dumps(document, ensure_ascii=False, indent=1) + "\n")

    def _path(self, question: VlmQuestion, endpoint: Endpoint) -> Path:
        return self.folder / "answers" / f"{question.digest(endpoint)}.json"
