"""Where the prims and properties of a layer's text stand, to the character; what they say is not understood."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

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


class UnscannableError(Exception):
    """A text that does not have the form that is expected; no error for people."""


@dataclass(slots=True)
class Block:
    """A prim, or the whole text: from `start` to `end`, its braces at `open` and `end - 1`.

    own: the properties and variant sets by what they are called, each from where to where; children: prims by name.
    """

    start: int
    open: int = 0
    end: int = 0
    own: dict[str, tuple[int, int]] = field(default_factory=dict)
    children: dict[str, Block] = field(default_factory=dict)


def scanned(text: str) -> Block:
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

    def scan(self) -> Block:
        """The text as a block: layer metadata, then prims."""
        root = Block(0)
        self._skip_blanks()
        if self._peek() == "(":
            self._skip_bracket()
        root.open = self.places[self.at - 1][1] - 1 if self.at else -1
        while self._skip_blanks() and self.at < len(self.words):
            self._scan_entry(root)
        root.end = self.length + 1
        return root

    def _scan_entry(self, block: Block) -> None:
        """A prim, a variant set, or a property."""
        word = self._peek()
        if word in _SPECIFIERS:
            self._scan_prim(block)
        else:
            self._scan_statement(block)

    def _scan_prim(self, block: Block) -> None:
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

    def _scan_head(self, parent: Block) -> Block:
        """A prim up to its opening brace."""
        made = Block(self.places[self.at][0])
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

    def _scan_statement(self, block: Block) -> None:
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
        key = _key(words)
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

    def _skip_blanks(self) -> bool:
        while self._peek() in ("\n", ";"):
            self.at += 1
        return True

    def _peek(self) -> str:
        return self.words[self.at] if self.at < len(self.words) else ""


def _key(words: list[str]) -> str:
    """What a statement is about: its words up to its name, with those that change what it does to it."""
    before = words[: words.index("=")] if "=" in words else words
    qualifiers = [word for word in before if word in ("prepend", "append", "add", "delete", "reorder")]
    rest = [word for word in before if word not in _QUALIFIERS]
    return " ".join([*qualifiers, rest[-1] if rest else ""])
