"""An edit of a layer brought into its authored text: where its prims stand, to the character; what the edit leaves
alone keeps place, form and comments."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

TextSplice = tuple[int, int, str]
"""From where to where, and what stands there instead."""
_STEP = "    "

_TOKEN = re.compile(
    r'"""(?:[^\\]|\\.)*?"""'
    r"|'''(?:[^\\]|\\.)*?'''"
    r'|"(?:[^"\\\n]|\\.)*"'
    r"|'(?:[^'\\\n]|\\.)*'"
    r"|@@@.*?@@@|@[^@\n]*@"
    r"|<[^<>\n]*>"
    r"|\#[^\n]*|//[^\n]*|/\*.*?\*/"
    r"|[(){}\[\]]|;|\n|[^\s\"'@<\#(){}\[\];/]+|/",
    re.S,
)
_COMMENTS = ("#", "//", "/*")
_OPEN, _CLOSE = "([{", ")]}"
_SPECIFIERS = ("def", "over", "class")
_QUALIFIERS = frozenset(["custom", "uniform", "varying", "config", "prepend", "append", "add", "delete", "reorder"])


def patch_layer(text: str, before: str, after: str) -> str | None:
    """An authored text with an edit; None where its form is not understood.

    before, after: the layer of the text as the library writes it, without and with the edit. What comes out must be
    read by the library and compared with `after`: this function knows little of the language.
    """
    try:
        source, old, new = scan_layer(text), scan_layer(before), scan_layer(after)
        splices = sorted(_Patcher(text, before, after).patch_block(source, old, new, ""), key=lambda splice: splice[:2])
    except (UnscannableError, KeyError, RecursionError):
        return None
    parts, at = [], 0
    for start, end, instead in splices:
        if start < at:
            return None
        if "\r\n" in text:
            instead = instead.replace("\r\n", "\n").replace("\n", "\r\n")
        parts += [text[at:start], instead]
        at = end
    return "".join([*parts, text[at:]])


class _Patcher:
    def __init__(self, text: str, before: str, after: str) -> None:
        self.text, self.before, self.after = text, before, after

    def patch_block(self, source: TextBlock, old: TextBlock, new: TextBlock, lead: str) -> Iterator[TextSplice]:
        """The splices of a prim, or of the whole text; lead: the blanks before what stands in it."""
        was, now = self.before[old.start : old.open], self.after[new.start : new.open]
        if was != now:
            outer = _lead_before(self.text, source.start)
            yield source.start, source.open, _reindent(now, _lead_before(self.after, new.start), outer)
        yield from self._patch_properties(source, old, new, lead)
        yield from self._patch_children(source, old, new, lead)

    def _patch_properties(self, source: TextBlock, old: TextBlock, new: TextBlock, lead: str) -> Iterator[TextSplice]:
        added = []
        for key, (start, end) in new.own.items():
            text = self.after[start:end]
            if key not in old.own:
                added.append(_reindent(text, _lead_before(self.after, start), lead))
            elif text != self.before[slice(*old.own[key])]:
                yield (*source.own[key], _reindent(text, _lead_before(self.after, start), lead))
        for key in old.own:
            if key not in new.own:
                yield (*_span_with_line(self.text, *source.own[key]), "")
        if added:
            at = self._end_of_own(source)
            yield at, at, "".join(f"\n{lead}{text}" for text in added)

    def _patch_children(self, source: TextBlock, old: TextBlock, new: TextBlock, lead: str) -> Iterator[TextSplice]:
        anchor: TextBlock | None = None
        waiting: dict[int, list[str]] = {}
        for name, child in new.children.items():
            if name in old.children:
                anchor = source.children[name]
                inner = _inner_lead(self.text, anchor)
                yield from self.patch_block(anchor, old.children[name], child, inner)
                continue
            text = _reindent(self.after[child.start : child.end], _lead_before(self.after, child.start), lead)
            at = anchor.end if anchor else self._end_of_own(source)
            waiting.setdefault(at, []).append(text)
        for at, texts in waiting.items():
            yield at, at, "".join(f"\n\n{lead}{text}" for text in texts)
        for name in old.children:
            if name not in new.children:
                gone = source.children[name]
                yield (*_span_with_line(self.text, gone.start, gone.end), "")

    def _end_of_own(self, source: TextBlock) -> int:
        """Behind the properties of a block; new prims come before the others there."""
        return max((end for _, end in source.own.values()), default=source.open + 1)


def _lead_before(text: str, at: int) -> str:
    """The blanks before a place, empty where something else stands before it in its line."""
    start = text.rfind("\n", 0, at) + 1
    return text[start:at] if not text[start:at].strip() else ""


def _inner_lead(text: str, block: TextBlock) -> str:
    """The blanks before what stands in a prim."""
    inside = [start for start, _ in block.own.values()] + [child.start for child in block.children.values()]
    found = [_lead_before(text, start) for start in inside]
    return next((lead for lead in found if lead), _lead_before(text, block.start) + _STEP)


def _span_with_line(text: str, start: int, end: int) -> tuple[int, int]:
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


def _reindent(text: str, old: str, new: str) -> str:
    """A text whose lines begin with other blanks; one with a text of several lines in it stays as it is."""
    if '"""' in text or "'''" in text or old == new:
        return text
    return re.sub(rf"^{re.escape(old)}", new, text, flags=re.M) if old else text.replace("\n", f"\n{new}")


class UnscannableError(Exception):
    """A text that does not have the form that is expected; no error for people."""


@dataclass(slots=True)
class TextBlock:
    """A prim, or the whole text: from `start` to `end`, its braces at `open` and `end - 1`.

    own: the properties and variant sets by what they are called, each from where to where; children: prims by name.
    """

    start: int
    open: int = 0
    end: int = 0
    own: dict[str, tuple[int, int]] = field(default_factory=dict)
    children: dict[str, TextBlock] = field(default_factory=dict)


def scan_layer(text: str) -> TextBlock:
    """The blocks of a text. Raises UnscannableError."""
    return _Scanner(text).scan()


def has_comments(text: str) -> bool:
    """Whether a text has comments behind its first line."""
    return any(found[0].startswith(_COMMENTS) and found.start() > 0 for found in _TOKEN.finditer(text))


class _Scanner:
    def __init__(self, text: str) -> None:
        tokens = [found for found in _TOKEN.finditer(text) if not found[0].startswith(_COMMENTS)]
        self.words = [found[0] for found in tokens]
        self.places = [found.span() for found in tokens]
        self.at, self.length = 0, len(text)

    def scan(self) -> TextBlock:
        """The text as a block: layer metadata, then prims."""
        root = TextBlock(0)
        self._skip_blanks()
        if self._peek() == "(":
            self._skip_bracket()
        root.open = self.places[self.at - 1][1] - 1 if self.at else -1
        self._skip_blanks()
        while self.at < len(self.words):
            scan = self._scan_prim if self._peek() in _SPECIFIERS else self._scan_statement
            scan(root)
            self._skip_blanks()
        root.end = self.length + 1
        return root

    def _scan_prim(self, block: TextBlock) -> None:
        stack = [block]
        while True:
            word = self._peek()
            if word in _SPECIFIERS:
                stack.append(self._scan_head(stack[-1]))
            elif word == "}" and len(stack) > 1:
                self.at += 1
                stack.pop().end = self.places[self.at - 1][1]
                if len(stack) == 1:
                    return
            elif word in ("", "}"):
                raise UnscannableError
            else:
                self._scan_statement(stack[-1])
            self._skip_blanks()

    def _scan_head(self, parent: TextBlock) -> TextBlock:
        """A prim up to its opening brace."""
        made = TextBlock(self.places[self.at][0])
        self.at += 1
        name = ""
        while self._peek() != "{":
            word = self._peek()
            if word == "(":
                self._skip_bracket()
                continue
            if word == "" or word in _CLOSE or word == "[":
                raise UnscannableError
            if word[0] in "\"'" and not name:
                name = word.strip("\"'")
            self.at += 1
        made.open = self.places[self.at][0]
        self.at += 1
        if not name or name in parent.children:
            raise UnscannableError
        parent.children[name] = made
        return made

    def _scan_statement(self, block: TextBlock) -> None:
        """A line at the level of a prim: a property or a variant set, brackets and all."""
        start, words = self.at, list[str]()
        while self._peek() not in ("\n", ";", "", "}"):
            if self._peek() in _OPEN:
                self._skip_bracket()
            elif self._peek() in _CLOSE:
                raise UnscannableError
            else:
                words.append(self._peek())
                self.at += 1
        if not words or self.at == start:
            raise UnscannableError
        key = _key_of(words)
        if key in block.own:
            raise UnscannableError
        block.own[key] = self.places[start][0], self.places[self.at - 1][1]

    def _skip_bracket(self) -> None:
        """From an opening bracket to behind the one that closes it."""
        depth = 0
        while True:
            word = self._peek()
            if word == "":
                raise UnscannableError
            depth += (word in _OPEN) - (word in _CLOSE)
            self.at += 1
            if depth == 0:
                return

    def _skip_blanks(self) -> None:
        while self._peek() in ("\n", ";"):
            self.at += 1

    def _peek(self) -> str:
        return self.words[self.at] if self.at < len(self.words) else ""


def _key_of(words: list[str]) -> str:
    """What a statement is about: its words up to its name, with those that change what it does to it."""
    before = words[: words.index("=")] if "=" in words else words
    qualifiers = [word for word in before if word in ("prepend", "append", "add", "delete", "reorder")]
    rest = [word for word in before if word not in _QUALIFIERS]
    return " ".join([*qualifiers, rest[-1] if rest else ""])
