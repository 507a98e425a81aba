"""What a server and its model can do, found out once by a small question about a red picture."""

from __future__ import annotations

import base64
import json
from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

from meshforge.files import write_atomically
from meshforge.perception.vlm.endpoint import Endpoint
from meshforge.perception.vlm.faults import EndError, RefusedError
from meshforge.perception.vlm.question import Message, Question
from meshforge.perception.vlm.reply import Reply

_LIKELIEST = 5  # tokens whose chances are asked for in each place
_COLOURS = ("red", "green", "blue")
_SIDE = 512  # pixels: one tile for those models that cut pictures up, so that it tells how they count them


@dataclass(frozen=True, slots=True)
class Features:
    """What of a request is understood. schema: answers keep to it; logprobs: chances are given.

    temperature: can be set; limit: the name of the field for the room of an answer; pictures: are taken, and sees: what
    is on them was told rightly.
    """

    schema: bool = True
    logprobs: bool = True
    temperature: bool = True
    limit: str = "max_tokens"
    pictures: bool = True
    sees: bool = True

    def body(self, question: Question, endpoint: Endpoint) -> dict[str, Any]:
        """The request that puts a question to the model."""
        body: dict[str, Any] = {
            "model": endpoint.model,
            "messages": [{"role": m.role, "content": _content(m)} for m in question.messages],
            self.limit: question.limit,
        }
        if self.temperature:
            body["temperature"] = question.temperature
        if self.schema and question.schema is not None:
            form = {"name": "answer", "strict": True, "schema": question.schema}
            body["response_format"] = {"type": "json_schema", "json_schema": form}
        if self.logprobs:
            body |= {"logprobs": True, "top_logprobs": _LIKELIEST}
        return body | dict(endpoint.extra)


def _content(message: Message) -> Any:
    """Plain text where there is nothing else, which every server takes."""
    if all(isinstance(part, str) for part in message.parts):
        return "\n".join(str(part) for part in message.parts)
    return [
        {"type": "text", "text": part}
        if isinstance(part, str)
        else {"type": "image_url", "image_url": {"url": f"data:image/png;base64,{base64.b64encode(part).decode()}"}}
        for part in message.parts
    ]


def probe(send: Callable[[Question, Features], Reply]) -> Features:
    """Ask with everything, and with less as long as the server refuses. Raises EndError where it refuses everything.

    send: raises RefusedError where the server refuses.
    """
    features = Features()
    while True:
        question = probe_question(features.pictures)
        try:
            reply = send(question, features)
        except RefusedError as error:
            less = _less(features, error.problem.lower())
            if less is None:
                raise EndError(error.problem, where=error.where) from error
            features = less
            continue
        keeps, sees = _keeps(reply.text), not features.pictures or "red" in reply.text.lower()
        return replace(
            features,
            schema=features.schema and keeps,
            logprobs=features.logprobs and reply.tokens is not None,
            sees=sees,
        )


@cache
def probe_question(with_picture: bool) -> Question:
    """Which colour is this? Asked so that only a schema makes the answer JSON."""
    colour = {"type": "string", "enum": list(_COLOURS)}
    schema = {
        "type": "object",
        "properties": {"colour": colour},
        "required": ["colour"],
        "additionalProperties": False,
    }
    text = f"Which of these colours is {'this picture' if with_picture else 'a ripe tomato'}: {', '.join(_COLOURS)}?"
    message = Message.user(text, _red()) if with_picture else Message.user(text)
    return Question((message,), schema)


def _red() -> bytes:
    from PIL import Image

    from meshforge.views import png

    return png(Image.new("RGB", (_SIDE, _SIDE), (220, 30, 30)))


def _keeps(text: str) -> bool:
    """Whether an answer has the form that the schema says, and nothing besides."""
    try:
        return bool(json.loads(text).get("colour") in _COLOURS)
    except (ValueError, AttributeError, TypeError):
        return False


def _less(features: Features, complaint: str) -> Features | None:
    """The features without the one that the server complains about, or else the next; None where none is left."""
    wishes: dict[str, Features] = {}
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


def read_features(path: Path) -> Features | None:
    """What was found out earlier, None where nothing was, or nothing that can be read."""
    try:
        return Features(**json.loads(path.read_bytes())["features"])
    except (OSError, ValueError, KeyError, TypeError):
        return None


def write_features(path: Path, features: Features, endpoint: Endpoint) -> None:
    """Keep what was found out."""
    kept = {"base_url": endpoint.place, "model": endpoint.model, "features": asdict(features)}
    write_atomically(path, json.dumps(kept, ensure_ascii=False, indent=1) + "\n")
