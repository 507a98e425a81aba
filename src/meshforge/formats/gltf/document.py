"""A glTF file as it was authored: what is kept of it to write it back, and edits of its JSON that leave all of the
text as it is but what has changed: numbers, blanks, order."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from meshforge.formats.collision_pieces import CollisionElement
from meshforge.geometry import Ints
from meshforge.symbolic import Document

Convention = Literal["khr", "omi", "unreal", "godot", "unity", "plain"]
"""How a file marks its collision geometry: by an extension, by names, or not at all, then all meshes are collision."""

BODY = "body"
"""The name of the body of all collision that is part of no rigid body."""


@dataclass(frozen=True, eq=False, slots=True)
class NodeRecord(CollisionElement):
    """A node of the file with collision.

    owner: the piece (m,) of each triangle of its mesh; None where the pieces are not parts of a mesh.
    """

    node: int
    owner: Ints | None = None


@dataclass(frozen=True, eq=False, slots=True)
class GltfDocument(Document):
    """The source of an asset read from a glTF file or GLB.

    source: the bytes of the file; bodies: the nodes that are bodies, with the names of those;
    digests: of the files with its buffers, so that one changed since then is noticed.
    """

    source: bytes
    convention: Convention
    authored: tuple[NodeRecord, ...]
    bodies: tuple[tuple[int, str], ...] = ()
    digests: tuple[tuple[Path, str], ...] = ()


_BLANKS = re.compile(r"[ \t\r\n]*")
_decode = json.JSONDecoder().raw_decode


_Change = tuple[int, int, str]
"""New text in place of [start, end)."""


@dataclass(frozen=True, slots=True)
class _Item:
    """An element of an array, or a member of an object with its key, from `start` to `end`; its value from `at` on."""

    start: int
    at: int
    end: int
    value: Any
    key: str | None = None


def rewrite_json(text: str, new: Any) -> str:
    """Return a JSON text with another value: what is the same in both keeps its text."""
    at = _skip_blanks(text, 0)
    old, end = _decode(text, at)
    out, done = [], 0
    for start, stop, more in sorted(_find_changes(text, at, end, old, new), key=lambda change: change[:2]):
        out += [text[done:start], more]
        done = stop
    return "".join([*out, text[done:]])


def _find_changes(text: str, at: int, end: int, old: Any, new: Any) -> Iterator[_Change]:
    if old == new:
        return
    if isinstance(old, dict) and isinstance(new, dict) and old and new:
        yield from _change_object(text, end, list(_parse_items(text, at, keyed=True)), new)
    elif isinstance(old, list) and isinstance(new, list) and old and new:
        yield from _change_array(text, end, list(_parse_items(text, at, keyed=False)), new)
    else:
        yield at, end, json.dumps(new)


def _change_object(text: str, end: int, items: Sequence[_Item], new: dict[str, Any]) -> Iterator[_Change]:
    kept = [item.key in new for item in items]
    yield from _remove_items(items, kept)
    for item in (item for item, stays in zip(items, kept, strict=True) if stays):
        yield from _find_changes(text, item.at, item.end, item.value, new[str(item.key)])
    there, style = {item.key for item in items}, _Layout.of(text, items, end)
    added = [f"{json.dumps(key)}{style.colon}{style.format(value)}" for key, value in new.items() if key not in there]
    yield from _add_items(items, kept, added, style)


def _change_array(text: str, end: int, items: Sequence[_Item], new: Sequence[Any]) -> Iterator[_Change]:
    style = _Layout.of(text, items, end)
    if len(new) < len(items):
        kept = _subsequence([item.value for item in items], new)
        if kept is None:
            yield items[0].start, items[-1].end, style.between.join(style.format(value) for value in new)
        else:
            yield from _remove_items(items, kept)
        return
    for item, value in zip(items, new, strict=False):
        yield from _find_changes(text, item.at, item.end, item.value, value)
    yield from _add_items(items, [True], [style.format(value) for value in new[len(items) :]], style)


def _subsequence(old: Sequence[Any], new: Sequence[Any]) -> list[bool] | None:
    """Which elements stay where nothing but removals makes the old ones the new ones."""
    kept, at = [], 0
    for value in old:
        stays = at < len(new) and value == new[at]
        kept.append(stays)
        at += stays
    return kept if at == len(new) else None


def _remove_items(items: Sequence[_Item], kept: Sequence[bool]) -> Iterator[_Change]:
    if not any(kept):
        yield items[0].start, items[-1].end, ""
        return
    last = max(k for k, stays in enumerate(kept) if stays)
    for k, item in enumerate(items[:last]):
        if not kept[k]:
            yield item.start, items[k + 1].start, ""
    if last + 1 < len(items):
        yield items[last].end, items[-1].end, ""


def _add_items(items: Sequence[_Item], kept: Sequence[bool], texts: Sequence[str], style: _Layout) -> Iterator[_Change]:
    if texts:
        first = "" if not any(kept) else style.between
        yield items[-1].end, items[-1].end, first + style.between.join(texts)


@dataclass(frozen=True, slots=True)
class _Layout:
    """How an object or array is laid out: the text between items and behind keys, the blanks before lines, a step."""

    between: str
    colon: str
    lead: str | None
    step: str

    @staticmethod
    def of(text: str, items: Sequence[_Item], end: int) -> _Layout:
        first = items[0]
        before = text[_line_start(text, first.start) : first.start]
        closing = text[_line_start(text, end - 1) : end - 1]
        gap = text[first.end : items[1].start] if len(items) > 1 else ","
        colon = ": " if first.key is None or " " in text[first.start : first.at].rpartition('"')[2] else ":"
        if before.strip() or "\n" not in text[: first.start]:
            return _Layout(", " if " " in gap else ",", colon if " " in gap or first.key else ":", None, "")
        step = before[len(closing) :] if not closing.strip() and before.startswith(closing) else ""
        line_end = "\r\n" if text[: first.start - len(before)].endswith("\r\n") else "\n"
        return _Layout(f",{line_end}{before}", colon, line_end + before, step or "  ")

    def format(self, value: Any) -> str:
        if self.lead is None:
            return json.dumps(value, separators=(self.between, self.colon))
        return json.dumps(value, indent=self.step).replace("\n", self.lead)


def _line_start(text: str, at: int) -> int:
    return text.rfind("\n", 0, at) + 1


def _parse_items(text: str, at: int, *, keyed: bool) -> Iterator[_Item]:
    """The items of the object or array that begins at `at`, which is not empty."""
    at = _skip_blanks(text, at + 1)
    while True:
        start, key = at, None
        if keyed:
            key, at = _decode(text, at)
            at = _skip_blanks(text, _skip_blanks(text, at) + 1)
        value, end = _decode(text, at)
        yield _Item(start, at, end, value, key)
        at = _skip_blanks(text, end)
        if text[at] != ",":
            return
        at = _skip_blanks(text, at + 1)


def _skip_blanks(text: str, at: int) -> int:
    found = _BLANKS.match(text, at)
    assert found is not None  # it matches nothing too
    return found.end()
