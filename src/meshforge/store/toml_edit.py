"""Changing one value of a TOML text and leaving every other character, comments included, as its author wrote it."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Sequence

from meshforge.common import ProjectError

TomlValue = str | float | Sequence[str]

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_HEADER = re.compile(r"^\s*\[")


def toml_value(value: TomlValue) -> str:
    """A value as TOML writes it: a string, a number, or an array of strings."""
    match value:
        case str():
            return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
        case int() | float():
            return repr(value)
        case _:
            return f"[{', '.join(map(toml_value, value))}]"


def set_value(text: str, key: str, value: TomlValue | None, table: str | None = None) -> str:
    """The text with one key of the top level, or of a table (`a` or `a.b`), set anew, added, or taken away by None.

    Raises ProjectError where the text is written in a way that this cannot follow (a key inside an inline table).
    """
    wanted = tomllib.loads(text)
    part = wanted
    for name in table.split(".") if table else ():
        part = part.setdefault(name, {})
    part.pop(key, None)
    if value is not None:
        part[key] = value if isinstance(value, str | int | float) else list(value)
    edited = _edit(text.splitlines(keepends=True), key, value, table)
    if not _parses(edited) or _without_empty(tomllib.loads(edited)) != _without_empty(wanted):
        raise ProjectError(f"the key {key!r} cannot be changed where it stands", remedy="Change it by hand.")
    return edited


def _edit(lines: list[str], key: str, value: TomlValue | None, table: str | None) -> str:
    start, end = _find_table(lines, table)
    if start is None:
        return "".join(lines) + ("" if value is None else f"\n[{table}]\n{_key(key)} = {toml_value(value)}\n")
    first = next((k for k in range(start, end) if _is_key(lines[k], key)), None)
    new = [] if value is None else [f"{_key(key)} = {toml_value(value)}"]
    if first is None:
        at = _find_insertion(lines, start, end)
        return "".join([*lines[:at], *(line + "\n" for line in new), *lines[at:]])
    last = _find_statement_end(lines, first, end)
    comment = _end_comment(lines[first:last])
    return "".join([*lines[:first], *(f"{line}{comment}\n" for line in new), *lines[last:]])


def _find_table(lines: list[str], table: str | None) -> tuple[int | None, int]:
    """Where the lines of a table begin and end; the top level ends at the first header."""
    headers = [k for k, line in enumerate(lines) if _HEADER.match(line) and _is_statement(lines, k)]
    if table is None:
        return 0, headers[0] if headers else len(lines)
    for k in headers:
        if lines[k].split("#")[0].strip() == f"[{table}]":
            return k + 1, next((h for h in headers if h > k), len(lines))
    return None, len(lines)


def _is_statement(lines: list[str], index: int) -> bool:
    """Whether a statement begins at a line, so that it is not the inside of an array of several lines."""
    return _parses("".join(lines[:index]))


def _is_key(line: str, key: str) -> bool:
    ways = "|".join(map(re.escape, (key, f'"{key}"', toml_value(key), f"'{key}'")))
    return re.match(rf"\s*(?:{ways})\s*=", line) is not None


def _key(key: str) -> str:
    """A key as TOML writes it, in quotes where it has other characters than letters, digits, `_` and `-`."""
    return key if _BARE.fullmatch(key) else toml_value(key)


def _find_statement_end(lines: list[str], first: int, end: int) -> int:
    return next((k for k in range(first + 1, end + 1) if _parses("".join(lines[first:k]))), end)


def _find_insertion(lines: list[str], start: int, end: int) -> int:
    """The place below the last line that is not blank, so that a new key joins those above it."""
    while end > start and not lines[end - 1].strip():
        end -= 1
    if end and not lines[end - 1].endswith("\n"):
        lines[end - 1] += "\n"
    return end


def _end_comment(statement: list[str]) -> str:
    """The comment at the end of a statement, with the space before it."""
    text = "".join(statement).rstrip()
    for k in range(text.rfind("\n") + 1, len(text)):
        if text[k] == "#" and _parses(text[:k]):
            return text[len(text[:k].rstrip()) :]
    return ""


def _parses(text: str) -> bool:
    try:
        tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return False
    return True


def _without_empty(tables: dict[str, object]) -> dict[str, object]:
    full = {key: _without_empty(value) if isinstance(value, dict) else value for key, value in tables.items()}
    return {key: value for key, value in full.items() if value != {}}
