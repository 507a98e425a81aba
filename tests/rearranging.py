"""Damage to the structure of a file: parts of XML and JSON moved, doubled, renamed, left out, nested, of odd values."""

from __future__ import annotations

import copy
import json
import random
from typing import Any

from lxml import etree

_TEXTS = (
    *("", "0", "-1", "1 2", "1 2 3", "0 0 0", "1e308 1e308 1e308", "nan", "inf", "a", "::", "..", "../..", "/", "~"),
    *("true", "file:///etc/passwd", "model://a/../../b", "http://localhost/x", "x" * 3000, "\u202e", "9" * 400),
)
_VALUES: tuple[Any, ...] = (
    *(None, True, -1, 0, 1, 2**31, 2**53, 2**64, -(2**63), 1e308, 0.5, "", "x", "../.."),
    *([], {}, [[]], [-1], [1e308] * 16, {"extensions": {}}),
)
_DEEP = 1200


def rearranged(data: bytes, rng: random.Random) -> bytes:
    """XML and JSON with one to four parts changed; anything else as it is."""
    text = data.lstrip()
    try:
        if text.startswith(b"<"):
            return _xml(data, rng)
        if text.startswith(b"{"):
            return _json(data, rng)
    except (etree.XMLSyntaxError, ValueError, RecursionError):
        pass
    return data


def _xml(data: bytes, rng: random.Random) -> bytes:
    root = etree.fromstring(data, etree.XMLParser(resolve_entities=False, remove_comments=False))
    for _ in range(rng.choice((1, 1, 2, 4))):
        every = [element for element in root.iter() if isinstance(element.tag, str)]
        _change(rng.choice(every), every, rng)
    return bytes(etree.tostring(root))


def _change(one: Any, every: list[Any], rng: random.Random) -> None:
    """Change something about one of the elements."""
    other, parent = rng.choice(every), one.getparent()
    match rng.randrange(9):
        case 0 if parent is not None:
            parent.remove(one)
        case 1 if parent is not None:
            parent.insert(rng.randrange(len(parent) + 1), copy.deepcopy(one))
        case 2:
            other.append(copy.deepcopy(one))
        case 3:
            one.tag = other.tag
        case 4 if len(one.attrib):
            one.set(rng.choice(sorted(one.attrib)), rng.choice(_TEXTS))
        case 5 if len(other.attrib):
            name = rng.choice(sorted(other.attrib))
            one.set(name, other.attrib[name])
        case 6 if len(one.attrib):
            del one.attrib[rng.choice(sorted(one.attrib))]
        case 7:
            one.text = rng.choice((other.text, *_TEXTS)) if rng.random() < 0.97 else "7 " * 100_000
        case _ if rng.random() < 0.05:
            for _ in range(_DEEP):
                one = etree.SubElement(one, one.tag)
        case _:
            one.text, other.text = other.text, one.text


def _json(data: bytes, rng: random.Random) -> bytes:
    tree = json.loads(data)
    for _ in range(rng.choice((1, 1, 2, 4))):
        places = list(_places(tree))
        if places:
            holder, key = rng.choice(places)
            other, which = rng.choice(places)
            _put(holder, key, copy.deepcopy(rng.choice((*_VALUES, other[which], other[which]))), rng)
    return json.dumps(tree).encode()


def _put(holder: Any, key: Any, value: Any, rng: random.Random) -> None:
    """A value in a place, or nothing there, or it twice."""
    match rng.randrange(4):
        case 0:
            del holder[key]
        case 1 if isinstance(holder, list):
            holder.insert(key, value)
        case _:
            holder[key] = value


def _places(tree: Any) -> Any:
    """All holders of values, with the keys."""
    waiting = [tree]
    while waiting:
        holder = waiting.pop()
        if isinstance(holder, dict | list):
            keys = list(holder) if isinstance(holder, dict) else range(len(holder))
            for key in keys:
                yield holder, key
                waiting.append(holder[key])
