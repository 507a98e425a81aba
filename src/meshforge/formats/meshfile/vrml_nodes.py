"""The grammar of VRML 2.0: a text as a tree of nodes with fields."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from meshforge.errors import AssetError

_TOKEN = re.compile(r'"(?:\\.|[^"\\])*"|[{}\[\]]|[^\s,{}\[\]"#]+|#[^\n\r]*')
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|0[xX][0-9a-fA-F]+")
_OTHER = "Export it as OBJ."
_DEPTH = 200  # nodes in nodes; beyond, a file is damaged


@dataclass(slots=True)
class Node:
    """A node: its type, its DEF name, and what its fields hold (numbers, words, nodes; lists stay lists)."""

    type: str
    name: str | None = None
    fields: dict[str, list[Any]] = field(default_factory=dict)

    def numbers(self, key: str) -> list[float]:
        """The numbers of a field, none where it is not there."""
        return [x for x in self.fields.get(key, []) if isinstance(x, float)]

    def nodes(self, key: str) -> list[Node]:
        return [x for x in self.fields.get(key, []) if isinstance(x, Node)]

    def vector(self, key: str, size: int) -> list[float]:
        """The numbers of a field that has so many, none where it is not there. Raises ValueError: it has others."""
        found = self.numbers(key)
        if key in self.fields and len(found) != size:
            raise ValueError(f"the field {key} of a {self.type} needs {size} numbers")
        return found

    def word(self, key: str) -> str | None:
        return next((x for x in self.fields.get(key, []) if isinstance(x, str)), None)


def parse_nodes(text: str, where: str) -> list[Node]:
    """The nodes of a VRML 2.0 file. Raises AssetError: not such a file, cut short, or beyond what is read."""
    if not text.startswith("#VRML V2.0"):
        raise AssetError("this is no VRML 2.0 file", where=where, remedy=_OTHER)
    parser = _Parser([t for t in _TOKEN.findall(text) if t[0] != "#"], where)
    return list(parser.parse_all())


class _Parser:
    def __init__(self, tokens: list[str], where: str) -> None:
        self.tokens = tokens
        self.where = where
        self.at = 0
        self.depth = 0
        self.known: dict[str, Node] = {}

    def parse_all(self) -> Iterator[Node]:
        while self.at < len(self.tokens):
            if self.peek() == "ROUTE":
                self.at += 4
            else:
                yield self.parse_node()

    def peek(self) -> str:
        if self.at >= len(self.tokens):
            raise AssetError("the file is cut short", where=self.where, remedy="Export it again.")
        return self.tokens[self.at]

    def take(self) -> str:
        token = self.peek()
        self.at += 1
        return token

    def parse_node(self) -> Node:
        word, name = self.take(), None
        if word in ("PROTO", "EXTERNPROTO"):
            raise AssetError("prototypes are not read", where=self.where, remedy=_OTHER)
        if word == "USE":
            return self.look_up(self.take())
        if word == "DEF":
            name, word = self.take(), self.take()
        if self.depth > _DEPTH:
            raise AssetError(f"its nodes are nested more than {_DEPTH} deep", where=self.where)
        if word == "Inline":
            raise AssetError("it includes other files (Inline), which are not read", where=self.where, remedy=_OTHER)
        if self.take() != "{":
            raise AssetError(f"a node was expected where {word!r} stands", where=self.where, remedy=_OTHER)
        made = Node(word, name)
        self.depth += 1
        while self.peek() != "}":
            key = self.take()
            made.fields[key] = self.parse_value()
        self.at += 1
        self.depth -= 1
        if name:
            self.known[name] = made
        return made

    def look_up(self, name: str) -> Node:
        if name not in self.known:
            raise AssetError(f"USE {name}: no node of this name comes ahead of it", where=self.where, remedy=_OTHER)
        return self.known[name]

    def parse_value(self) -> list[Any]:
        if self.peek() == "[":
            self.at += 1
            out = []
            while self.peek() != "]":
                out.append(self.parse_item())
            self.at += 1
            return out
        out = [self.parse_item()]
        while isinstance(out[-1], float) and _NUMBER.fullmatch(self.peek()):
            out.append(self.parse_item())
        return out

    def parse_item(self) -> Any:
        token = self.peek()
        if _NUMBER.fullmatch(token):
            self.at += 1
            return float(int(token, 16)) if token[:2] in ("0x", "0X") else float(token)
        if token in ("TRUE", "FALSE", "NULL", "IS") or token[0] == '"':
            return self.take()
        return self.parse_node()
