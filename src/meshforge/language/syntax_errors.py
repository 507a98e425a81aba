"""Syntax errors in plain words: what was expected at a place, what stands there, and what was probably meant."""

from __future__ import annotations

from collections.abc import Iterable, Set

from meshforge.common import ProgramError, nearest_name
from meshforge.language.actions.arguments import join_alternatives
from meshforge.language.actions.basic import ACTIONS
from meshforge.language.syntax import DIRECTIONS, OPERATORS
from meshforge.language.text import ProgramText

HEADERS = ("labels", "contact", "extremity", "orient")
QUOTE_NAMES = "Put names with other characters than letters, digits and _ in double quotes."
_SIGNS = {"COMMA": ",", "COLON": ":", "LPAR": "(", "RPAR": ")", "_TO": "->", "_ARROW": "=>"}
_WORDS = {f"_{word.upper()}": word for word in (*HEADERS, *OPERATORS, "as")} | {"SNAP": "snap"}


def syntax_error(source: ProgramText, offset: int, accepted: Set[str], before: str) -> ProgramError:
    """The error for an unexpected piece of text.

    accepted: names of the grammar's terminals that may stand there; before: the text of the token before it.
    """
    found = source.piece_at(offset)
    words = _candidate_words(accepted)
    like = likely_word(found, words)
    problem = _problem(found, accepted)
    if like:
        return source.error_at(offset, problem, f"Did you mean {like}?")
    return source.error_at(offset, problem, _remedy(source, offset, found, accepted, before))


def likely_word(word: str, words: Iterable[str]) -> str | None:
    """The one of the words that was probably meant, whatever its case."""
    lower = {w.lower(): w for w in words}
    signless = {w[1:].lower(): w for w in words if w[0] in "+-" and w[0] == "+"}
    found = nearest_name(word.lower(), lower)
    return signless.get(word.lower()) or (lower[found] if found else None)


def quote_code(found: str) -> str:
    """A piece of program text, for use in a sentence."""
    return f"`{found}`" if found else "the end of the line"


def _problem(found: str, accepted: Set[str]) -> str:
    is_word = found[:1].isalpha() or found[:1] == "_"
    if is_word and "_GEO" in accepted and found not in (*HEADERS, *ACTIONS):
        return f"unknown {'word' if '_LABELS' in accepted else 'operator'} {quote_code(found)}"
    if found == '"':
        return "this text is never closed: a double quotation mark is missing"
    if found in HEADERS and "_GEO" in accepted:
        return f"{found} must stand above the first rule"
    return f"expected {join_alternatives(_expectations(accepted))}, not {quote_code(found)}"


def _expectations(accepted: Set[str]) -> list[str]:
    """What may stand at a place, in words."""
    if "_LABELS" in accepted:
        return [f"a header line ({', '.join(HEADERS)})", f"a rule, which begins with one of {', '.join(OPERATORS)}"]
    if "_GEO" in accepted:
        return [f"an extractor ({', '.join(OPERATORS)})"]
    if "_ALL" in accepted:
        return ["All", "Is(label)"]
    phrases = []
    if "NAME" in accepted:
        names = {"STRING", "NUMBER"} & accepted
        phrases.append(
            "an argument" if len(names) == 2 else "a label" if names else f"an action ({', '.join(ACTIONS)})"
        )
    if "NUMBER" in accepted and "NAME" not in accepted:
        phrases.append("a number")
    if "SNAP" in accepted:
        phrases.append("snap")
    if "DIRECTION" in accepted and "NAME" not in accepted:
        phrases.append(f"a direction ({', '.join(DIRECTIONS)})")
    phrases += [f"`{sign}`" for name, sign in _SIGNS.items() if name in accepted]
    phrases += [f"`{word}`" for name, word in _WORDS.items() if name in accepted and word != "snap"]
    return phrases + (["the end of the line"] if accepted & {"_NL", "$END"} else [])


def _candidate_words(accepted: Set[str]) -> list[str]:
    """The words that may stand at a place."""
    words = [word for name, word in _WORDS.items() if name in accepted]
    if "DIRECTION" in accepted and "NAME" not in accepted:
        words += DIRECTIONS
    return words + (list(ACTIONS) if "NAME" in accepted and "STRING" not in accepted else [])


def _remedy(source: ProgramText, offset: int, found: str, accepted: Set[str], before: str) -> str | None:
    if "_ALL" in accepted and "_GEO" not in accepted and found in OPERATORS:
        return "Attach, Geo and orient refine All or Is(label); combine selections with Union, Intersect and Diff."
    if (found in ACTIONS and "_GEO" in accepted) or "_ARROW" in accepted:
        return "A rule is written `extractor => action`."
    if accepted & {"_TO", "COLON"}:
        return "A landmark pair is written `+Z: start -> end`."
    if "_GEO" in accepted and found[:1].isalpha() and found not in HEADERS:
        return f"Operators are {join_alternatives(OPERATORS)}."
    if found.startswith("'"):
        return "Write double quotation marks."
    joined = offset > 0 and not source.text[offset - 1].isspace() and before[:1].isalpha() and found[:1] not in "(),"
    if joined or ("NAME" in accepted and found[:1].isdigit()):
        return QUOTE_NAMES
    return None
