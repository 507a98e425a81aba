"""An edit of a layer brought into its authored text: what the edit leaves alone keeps its place, form and comments."""

from __future__ import annotations

import re
from collections.abc import Iterator

from meshforge.formats.usd.text.scan import Block, UnscannableError, scanned

Splice = tuple[int, int, str]
"""From where to where, and what stands there instead."""
_STEP = "    "


def patched(text: str, before: str, after: str) -> str | None:
    """An authored text with an edit; None where its form is not understood.

    before, after: the layer of the text as the library writes it, without and with the edit. What comes out must be
    read by the library and compared with `after`: this function knows little of the language.
    """
    try:
        source, old, new = scanned(text), scanned(before), scanned(after)
        splices = sorted(_Patch(text, before, after).patch_block(source, old, new, ""), key=lambda splice: splice[:2])
    except (UnscannableError, KeyError, RecursionError):
        return None
    parts, at = [], 0
    for start, end, instead in splices:
        if start < at:
            return None
        parts += [text[at:start], instead]
        at = end
    line_end = "\r\n" if "\r\n" in text else "\n"
    return "".join([*_with_line_ends(parts, line_end), text[at:]])


def _with_line_ends(parts: list[str], line_end: str) -> Iterator[str]:
    """The parts, of which each second one is new."""
    for k, part in enumerate(parts):
        yield part if k % 2 == 0 or line_end == "\n" else part.replace("\r\n", "\n").replace("\n", line_end)


class _Patch:
    def __init__(self, text: str, before: str, after: str) -> None:
        self.text, self.before, self.after = text, before, after

    def patch_block(self, source: Block, old: Block, new: Block, lead: str) -> Iterator[Splice]:
        """The splices of a prim, or of the whole text; lead: the blanks before what stands in it."""
        was, now = self.before[old.start : old.open], self.after[new.start : new.open]
        if was != now:
            outer = _lead(self.text, source.start)
            yield source.start, source.open, _indented(now, _lead(self.after, new.start), outer)
        yield from self._patch_properties(source, old, new, lead)
        yield from self._patch_children(source, old, new, lead)

    def _patch_properties(self, source: Block, old: Block, new: Block, lead: str) -> Iterator[Splice]:
        added = []
        for key, (start, end) in new.own.items():
            text = self.after[start:end]
            if key not in old.own:
                added.append(_indented(text, _lead(self.after, start), lead))
            elif text != self.before[slice(*old.own[key])]:
                yield (*source.own[key], _indented(text, _lead(self.after, start), lead))
        for key in old.own:
            if key not in new.own:
                yield (*_line(self.text, *source.own[key]), "")
        if added:
            at = max((end for _, end in source.own.values()), default=source.open + 1)
            yield at, at, "".join(f"\n{lead}{text}" for text in added)

    def _patch_children(self, source: Block, old: Block, new: Block, lead: str) -> Iterator[Splice]:
        anchor: Block | None = None
        waiting: dict[int, list[str]] = {}
        for name, child in new.children.items():
            if name in old.children:
                anchor = source.children[name]
                inner = _inner_lead(self.text, anchor)
                yield from self.patch_block(anchor, old.children[name], child, inner)
                continue
            text = _indented(self.after[child.start : child.end], _lead(self.after, child.start), lead)
            at = anchor.end if anchor else self._end_of_own(source)
            waiting.setdefault(at, []).append(text)
        for at, texts in waiting.items():
            yield at, at, "".join(f"\n\n{lead}{text}" for text in texts)
        for name in old.children:
            if name not in new.children:
                gone = source.children[name]
                yield (*_line(self.text, gone.start, gone.end), "")

    def _end_of_own(self, source: Block) -> int:
        """Behind the properties of a block; new prims come before the others there."""
        return max((end for _, end in source.own.values()), default=source.open + 1)


def _lead(text: str, at: int) -> str:
    """The blanks before a place, empty where something else stands before it in its line."""
    start = text.rfind("\n", 0, at) + 1
    return text[start:at] if not text[start:at].strip() else ""


def _inner_lead(text: str, block: Block) -> str:
    """The blanks before what stands in a prim."""
    inside = [start for start, _ in block.own.values()] + [child.start for child in block.children.values()]
    found = [_lead(text, start) for start in inside]
    return next((lead for lead in found if lead), _lead(text, block.start) + _STEP)


def _line(text: str, start: int, end: int) -> tuple[int, int]:
    """From where to where to take something out: with its line, where it stands alone there, and one blank line."""
    first = text.rfind("\n", 0, start) + 1
    last = text.find("\n", end)
    last = len(text) if last < 0 else last + 1
    if text[first:start].strip() or text[end:last].strip().rstrip(";"):
        return start, end
    before = text.rfind("\n", 0, max(first - 1, 0)) + 1
    blank = first > 0 and not text[before:first].strip()
    following = text[last : text.find("\n", last) + 1 or len(text)].strip()
    return (before if blank and following in ("", "}") else first), last


def _indented(text: str, old: str, new: str) -> str:
    """A text whose lines begin with other blanks; one with a text of several lines in it stays as it is."""
    if '"""' in text or "'''" in text or old == new:
        return text
    return re.sub(rf"^{re.escape(old)}", new, text, flags=re.M) if old else text.replace("\n", f"\n{new}")
