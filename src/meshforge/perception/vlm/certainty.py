"""How sure a model was of each label, from the chances of its tokens."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from meshforge.perception.vlm.answer import Answer
from meshforge.perception.vlm.reply import Reply, Token

Chances = Mapping[str | None, float]
"""The chance of each label, None for unknown; they sum up to one."""


def chances(reply: Reply, answer: Answer, vocabulary: Sequence[str], unknown: str) -> dict[int, Chances]:
    """The chances of all labels for each number that has one, as far as the server told them."""
    if not reply.tokens:
        return {}
    text, whole = reply.text.encode(), b"".join(token.text for token in reply.tokens)
    start = whole.rfind(text)
    if start < 0:
        return {}
    words: dict[bytes, str | None] = {word.encode(): word for word in vocabulary} | {unknown.encode(): None}
    found = {}
    for number, label in answer.said.items():
        places = list(re.finditer(rb'"number"\s*:\s*%d\s*,\s*"label"\s*:\s*"([^"\\]*)"' % number, text))
        word = places[-1][1] if places else b""
        if words.get(word, "") == label and word in words:
            found[number] = _spread(reply.tokens, start + places[-1].start(1), word, words)
    return found


def _spread(tokens: Sequence[Token], start: int, word: bytes, words: Mapping[bytes, str | None]) -> Chances:
    """The chances of all words in the place of one that begins at `start`.

    That of the word itself is the product over its tokens. The others share what is left: as the tokens say that were
    likely instead of the first, then evenly.
    """
    own, first, place, before = 1.0, None, 0, 0
    for token in tokens:
        end = place + len(token.text)
        if place < start + len(word) and end > start:
            own *= token.chance
            if first is None:
                first, before = token, max(0, start - place)
        place = end
    if first is None:
        return {words[word]: 1.0}
    share = dict.fromkeys(words, 0.0)
    for text, chance in first.others.items():
        head, rest = text[:before], text[before:]
        like = [one for one in words if one != word and rest and (one.startswith(rest) or rest.startswith(one))]
        if head == first.text[:before] and text != first.text and like:
            for one in like:
                share[one] += chance / len(like)
    share[word] = own
    left, others = max(0.0, 1 - sum(share.values())), len(words) - 1
    spread = {one: chance + (left / others if one != word else 0.0) for one, chance in share.items()}
    total = sum(spread.values()) or 1.0
    return {words[one]: chance / total for one, chance in spread.items()}
