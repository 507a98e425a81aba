"""A page for people: what a model was shown and asked about one mesh, and what it said."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from html import escape
from pathlib import Path
from typing import Any

from meshforge.files import relative_name, write_atomically
from meshforge.perception.vlm.labeller import Said

_STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 1100px; margin: 2rem auto; padding: 0 1rem; color: #1b2430 }
figure { display: inline-block; width: 340px; margin: 0 12px 8px 0; vertical-align: top }
img { width: 100%; border: 1px solid #dde2e8 }
pre { background: #f4f6f8; padding: 12px; white-space: pre-wrap; overflow-wrap: anywhere }
table { border-collapse: collapse }
td, th { text-align: left; padding: 2px 16px 2px 0; border-bottom: 1px solid #dde2e8 }
.answer { background: #eef6ee } .open { color: #a33 } h2 { margin-top: 2.5rem }
"""


def write_page(folder: Path, name: str, said: Said) -> Path:
    """Write `pages/NAME.html` into a folder of answers; name: that of the mesh, maybe with folders."""
    path = folder / "pages" / f"{name}.html"
    pictures = relative_name(folder / "pictures", path.parent)
    body = [f"<h1>{escape(name)}</h1>", *_labels(said)]
    for number, digest in enumerate(said.asked, 1):
        file = folder / "answers" / f"{digest}.json"
        body += [f"<h2>Question {number}</h2>", *_question(file, pictures)]
    head = f'<meta charset="utf-8"><title>{escape(name)}</title><style>{_STYLE}</style>'
    write_atomically(path, f'<!doctype html>\n<html lang="en">{head}\n' + "\n".join(body) + "\n</html>\n")
    return path


def _labels(said: Said) -> Iterator[str]:
    yield "<table><tr><th>Hull</th><th>Label</th><th>Confidence</th></tr>"
    for hull, label in said.labels.items():
        yield f"<tr><td>{escape(hull)}</td><td>{escape(label.name)}</td><td>{label.confidence:.2f}</td></tr>"
    for hull, why in said.open.items():
        yield f'<tr><td>{escape(hull)}</td><td class="open" colspan="2">none: {escape(why)}</td></tr>'
    yield "</table>"


def _question(file: Path, pictures: str) -> Iterator[str]:
    try:
        kept = json.loads(file.read_bytes())
        messages, answer = kept["asked"]["messages"], kept["answered"]
        told = f"{answer['input_tokens']} tokens in, {answer['output_tokens']} out"
        shown = [*_messages(messages, pictures), f'<pre class="answer">{escape(answer["text"])}</pre><p>{told}.</p>']
    except (OSError, ValueError, KeyError, TypeError):
        yield "<p>It got no answer.</p>"
    else:
        yield from shown


def _messages(messages: Sequence[Any], pictures: str) -> Iterator[str]:
    for message in messages:
        parts = list(_parts(message["parts"], pictures))
        if message["role"] == "system":
            yield f"<details><summary>What the task is</summary>{''.join(parts)}</details>"
        else:
            yield "".join(parts)


def _parts(parts: Sequence[Any], pictures: str) -> Iterator[str]:
    """Texts and pictures; a text before a picture stands above it."""
    for part, then in zip(parts, [*parts[1:], ""], strict=True):
        match part, then:
            case {"picture": str(digest)}, _:
                yield f'<img src="{escape(pictures)}/{escape(digest)}.png" alt=""></figure>'
            case str(), {"picture": _}:
                yield f"<figure><figcaption>{escape(part)}</figcaption>"
            case _:
                yield f"<pre>{escape(str(part))}</pre>"
