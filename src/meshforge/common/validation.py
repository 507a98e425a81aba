"""What is wrong in a JSON or TOML file, in plain words: the field, what was expected there, and what was found."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pydantic import ValidationError  # only its name: pydantic is slow to import

_LONGEST = 60  # characters of what was found


def first_validation_error(error: ValidationError) -> str:
    """Return the complaint about the first field of a file that does not fit, in one line."""
    return describe_invalid_field(error.errors(include_url=False)[0])


def describe_invalid_field(complaint: Mapping[str, Any]) -> str:
    """Return one complaint of pydantic's, in one line; complaint: one that `ValidationError.errors()` lists."""
    kind, about, given = complaint["type"], complaint.get("ctx") or {}, complaint.get("input")
    steps = (f"[{step}]" if isinstance(step, int) else f".{step}" for step in complaint["loc"])
    field = "".join(steps).removeprefix(".")
    at = f"the field {field}" if field else ""
    if kind == "json_invalid":
        text = str(about.get("error", ""))
        found = re.search(r"line (\d+) column (\d+)", text)
        place = f" (line {found[1]}, column {found[2]})" if found else ""
        return f"this JSON is nested too deeply{place}" if "recursion" in text else f"this is no JSON{place}"
    if kind.startswith("missing"):
        return f"{at or 'a field'} is missing"
    if kind.startswith(("extra_forbidden", "unexpected", "no_such")):
        return f"there is no such field as {field}"
    if kind in ("value_error", "assertion_error"):
        problem = str(about.get("error", "it does not fit"))
    else:
        expected = _read_expected().get(kind, "").format(**about)
        problem = (
            f"expected {expected}, found {_format_value(given)}" if expected else f"{_format_value(given)} does not fit"
        )
    return f"{at}: {problem}" if at else problem


@cache
def _read_expected() -> Mapping[str, str]:
    """What a field of each kind of complaint should have held."""
    return tomllib.loads(files("meshforge.common").joinpath("validation.toml").read_text("utf-8"))


def _format_value(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False, default=str)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3] + "..."
