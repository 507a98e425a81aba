"""Writes the expectation of every input of `tests/corpus` that has none, or has another one now; to be reviewed.

Usage: python -m tests.corpus_goldens [--changed] [WORD ...]: inputs whose name holds one of the words, else all;
without --changed, only those that have no expectation yet. Prints what it writes.
"""

from __future__ import annotations

import sys

from tests.corpus_case import Case, cases, told


def settled(case: Case, changed: bool) -> str | None:
    """Write the expectation of an input where it is new or may be changed; gives its text where it was written."""
    before = case.expected
    if before and not changed:
        return None
    suffix, text = told(case).golden
    if before == (suffix, text):
        return None
    if before:
        case.golden(before[0]).unlink()
    case.golden(suffix).write_text(text, encoding="utf-8")
    return text


if __name__ == "__main__":
    words = [word for word in sys.argv[1:] if word != "--changed"]
    for one in cases():
        if words and not any(word in one.name for word in words):
            continue
        if (text := settled(one, "--changed" in sys.argv)) is not None:
            print(f"--- {one.name}\n{text}", end="")
