"""A question to a model: messages of texts and pictures, the form of the answer, and which parts of a request the
server understands."""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, dataclass, replace
from functools import cache, cached_property
from pathlib import Path
from typing import Any, Literal

from meshforge.common import write_atomically
from meshforge.labels.vlm.endpoint import EndError, Endpoint, RefusalError
from meshforge.labels.vlm.transport import Reply
from meshforge.rendering import encode_png

Part = str | bytes
"""A text, or a picture as a PNG file."""

_COLOURS = ("red", "green", "blue")
_SIDE = 512  # pixels: one tile for those models that cut pictures up, so that it tells how they count them


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
        return tuple(hashlib.blake2b(picture, digest_size=16).hexdigest() for picture in self.pictures)

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


@dataclass(frozen=True, slots=True)
class ServerFeatures:
    """What of a request is understood. schema: answers keep to it; logprobs: chances are given.

    temperature: can be set; limit: the name of the field for the room of an answer; pictures: are taken, and sees: what
    is on them is recognized.
    """

    schema: bool = True
    logprobs: bool = True
    temperature: bool = True
    limit: str = "max_tokens"
    pictures: bool = True
    sees: bool = True

    def body(self, question: VlmQuestion, endpoint: Endpoint) -> dict[str, Any]:
        """The request that puts a question to the model."""
        body: dict[str, Any] = {
            "model": endpoint.model,
            "messages": [{"role": m.role, "content": _format_content(m)} for m in question.messages],
            self.limit: question.limit,
        }
        if self.temperature:
            body["temperature"] = question.temperature
        if self.schema and question.schema is not None:
            form = {"name": "answer", "strict": True, "schema": question.schema}
            body["response_format"] = {"type": "json_schema", "json_schema": form}
        if self.logprobs:
            body["logprobs"] = True
        return body | dict(endpoint.extra)


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


def probe_features(send: Callable[[VlmQuestion, ServerFeatures], Reply]) -> ServerFeatures:
    """Ask with everything, and with less as long as the server refuses. Raises EndError where it refuses everything.

    send: raises RefusalError where the server refuses.
    """
    features = ServerFeatures()
    while True:
        question = probe_question(features.pictures)
        try:
            reply = send(question, features)
        except RefusalError as error:
            less = _drop_feature(features, error.problem.lower())
            if less is None:
                raise EndError(error.problem, where=error.where) from error
            features = less
            continue
        schema, logprobs = features.schema and _fits_schema(reply.text), features.logprobs and reply.tokens is not None
        sees = not features.pictures or "red" in reply.text.lower()
        return replace(features, schema=schema, logprobs=logprobs, sees=sees)


@cache
def probe_question(with_picture: bool) -> VlmQuestion:
    """Which colour is this? Asked so that only a schema makes the answer JSON."""
    schema = {
        "type": "object",
        "properties": {"colour": {"type": "string", "enum": list(_COLOURS)}},
        "required": ["colour"],
        "additionalProperties": False,
    }
    text = f"Which of these colours is {'this picture' if with_picture else 'a ripe tomato'}: {', '.join(_COLOURS)}?"
    message = Message.user(text, _draw_red_picture()) if with_picture else Message.user(text)
    return VlmQuestion((message,), schema)


def _draw_red_picture() -> bytes:
    from PIL import Image  # lazy: only a probe of a server draws this picture

    return encode_png(Image.new("RGB", (_SIDE, _SIDE), (220, 30, 30)))


def _fits_schema(text: str) -> bool:
    try:
        return bool(json.loads(text).get("colour") in _COLOURS)
    except (ValueError, AttributeError, TypeError):
        return False


def _drop_feature(features: ServerFeatures, complaint: str) -> ServerFeatures | None:
    """The features without the one that the server complains about, or else the next; None where none is left."""
    wishes: dict[str, ServerFeatures] = {}
    if features.limit == "max_tokens":
        wishes["max_tokens"] = replace(features, limit="max_completion_tokens")
    if features.temperature:
        wishes["temperature"] = replace(features, temperature=False)
    if features.logprobs:
        wishes["logprobs"] = replace(features, logprobs=False)
    if features.schema:
        wishes["response_format"] = wishes["schema"] = replace(features, schema=False)
    if features.pictures:
        wishes["image"] = replace(features, pictures=False)
    named = (less for word, less in wishes.items() if word in complaint)
    order = ("logprobs", "schema", "temperature", "max_tokens", "image")
    return next(named, None) or next((wishes[word] for word in order if word in wishes), None)


def read_features(path: Path) -> ServerFeatures | None:
    """What was found out earlier, None where nothing was, or nothing that can be read."""
    try:
        return ServerFeatures(**json.loads(path.read_bytes())["features"])
    except (OSError, ValueError, KeyError, TypeError):
        return None


def write_features(path: Path, features: ServerFeatures, endpoint: Endpoint) -> None:
    """Keep what was found out."""
    kept = {"base_url": endpoint.place, "model": endpoint.model, "features": asdict(features)}
    write_atomically(path, json.dumps(kept, ensure_ascii=False, indent=1) + "\n")
