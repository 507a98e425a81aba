"""Answers on disk by what was asked, so that none is paid for twice, and a page that shows them to people."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any

from meshforge.common import relative_name, write_atomically
from meshforge.labels.vlm.answer import VlmAnswers
from meshforge.labels.vlm.endpoint import Endpoint, TokenCount
from meshforge.labels.vlm.request import VlmQuestion
from meshforge.labels.vlm.transport import Reply, Token

_ANY_BYTES = "latin-1"  # tokens may be parts of characters

_STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 1100px; margin: 2rem auto; padding: 0 1rem; color: #1b2430 }
figure { display: inline-block; width: 340px; margin: 0 12px 8px 0; vertical-align: top }
img { width: 100%; border: 1px solid #dde2e8 }
pre { background: #f4f6f8; padding: 12px; white-space: pre-wrap; overflow-wrap: anywhere }
table { border-collapse: collapse }
td, th { text-align: left; padding: 2px 16px 2px 0; border-bottom: 1px solid #dde2e8 }
.answer { background: #eef6ee } .open { color: #a33 } h2 { margin-top: 2.5rem }
"""


class AnswerCache:
    """A folder of answers: `answers/DIGEST.json` holds what was sent and what came back, `pictures/` the pictures."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def read(self, question: VlmQuestion, endpoint: Endpoint) -> Reply | None:
        """The answer to a question, None where there is none, or none that can be read."""
        try:
            data = json.loads(self.path(question, endpoint).read_bytes())
            asked = json.loads(json.dumps(question.document(endpoint)))
            return _to_reply(data["answered"], data["tokens"]) if data["asked"] == asked else None
        except (OSError, ValueError, KeyError, TypeError, AttributeError, IndexError):
            return None

    def write(self, question: VlmQuestion, endpoint: Endpoint, reply: Reply) -> None:
        """Keep an answer. The pictures are written first, so that an answer that is there has them."""
        for digest, picture in zip(question.digests, question.pictures, strict=True):
            path = self.folder / "pictures" / f"{digest}.png"
            if not path.exists():
                write_atomically(path, picture)
        rows = [(token.text.decode(_ANY_BYTES), token.chance) for token in reply.tokens or ()]
        tokens = json.dumps(rows if reply.tokens else None)  # hundreds of them, in one line
        asked, answered = (
            json.dumps(value, ensure_ascii=False, indent=1)
            for value in (question.document(endpoint), _to_record(reply))
        )
        text = f'{{\n"asked": {asked},\n"answered": {answered},\n"tokens": {tokens}\n}}\n'
        write_atomically(self.path(question, endpoint), text)

    def path(self, question: VlmQuestion, endpoint: Endpoint) -> Path:
        """The file of a question and its answer."""
        return self.folder / "answers" / f"{question.digest(endpoint)}.json"


def _to_record(reply: Reply) -> dict[str, Any]:
    usage = reply.usage or TokenCount()
    counts = {"input_tokens": usage.input, "output_tokens": usage.output} | (
        {"estimated": True} if usage.estimated else {}
    )
    return {"text": reply.text, "finish": reply.finish, **counts, "cost": reply.cost}


def _to_reply(record: Mapping[str, Any], rows: Sequence[Sequence[Any]] | None) -> Reply:
    """The answer of a record, whose rows of tokens may have more than their text and chance. Raises ValueError."""
    usage = TokenCount(int(record["input_tokens"]), int(record["output_tokens"]), bool(record.get("estimated")))
    tokens = tuple(Token(row[0].encode(_ANY_BYTES), float(row[1])) for row in rows) if rows else None
    if not (isinstance(record["text"], str) and isinstance(record["finish"], str)):
        raise ValueError("this is no answer")
    return Reply(record["text"], record["finish"], usage, tokens, float(record["cost"]), cached=True)


def write_page(folder: Path, name: str, answers: VlmAnswers) -> Path:
    """Write `pages/NAME.html` into a folder of answers; name: that of the mesh, maybe with folders."""
    path = folder / "pages" / f"{name}.html"
    pictures = relative_name(folder / "pictures", path.parent)
    body = [f"<h1>{escape(name)}</h1>", *_label_rows(answers)]
    for number, digest in enumerate(answers.asked, 1):
        body += [f"<h2>Question {number}</h2>", *_format_question(folder / "answers" / f"{digest}.json", pictures)]
    head = f'<meta charset="utf-8"><title>{escape(name)}</title><style>{_STYLE}</style>'
    write_atomically(path, f'<!doctype html>\n<html lang="en">{head}\n' + "\n".join(body) + "\n</html>\n")
    return path


def _label_rows(answers: VlmAnswers) -> Iterator[str]:
    yield "<table><tr><th>Hull</th><th>Label</th><th>Confidence</th></tr>"
    for hull, label in answers.labels.items():
        yield f"<tr><td>{escape(hull)}</td><td>{escape(label.name)}</td><td>{label.confidence:.2f}</td></tr>"
    for hull, why in answers.open.items():
        yield f'<tr><td>{escape(hull)}</td><td class="open" colspan="2">none: {escape(why)}</td></tr>'
    yield "</table>"


def _format_question(file: Path, pictures: str) -> Iterator[str]:
    try:
        kept = json.loads(file.read_bytes())
        messages, answer = kept["asked"]["messages"], kept["answered"]
        usage = f"{answer['input_tokens']} tokens in, {answer['output_tokens']} out"
        answer_html = f'<pre class="answer">{escape(answer["text"])}</pre><p>{usage}.</p>'
        shown = [*_format_messages(messages, pictures), answer_html]
    except (OSError, ValueError, KeyError, TypeError):
        yield "<p>It got no answer.</p>"
    else:
        yield from shown


def _format_messages(messages: Sequence[Any], pictures: str) -> Iterator[str]:
    for message in messages:
        parts = list(_format_parts(message["parts"], pictures))
        if message["role"] == "system":
            yield f"<details><summary>What the task is</summary>{''.join(parts)}</details>"
        else:
            yield "".join(parts)


def _format_parts(parts: Sequence[Any], pictures: str) -> Iterator[str]:
    """Texts and pictures; a text before a picture stands above it."""
    for part, then in zip(parts, [*parts[1:], ""], strict=True):
        match part, then:
            case {"picture": str(digest)}, _:
                yield f'<img src="{escape(pictures)}/{escape(digest)}.png" alt=""></figure>'
            case str(), {"picture": _}:
                yield f"<figure><figcaption>{escape(part)}</figcaption>"
            case _:
                yield f"<pre>{escape(str(part))}</pre>"
