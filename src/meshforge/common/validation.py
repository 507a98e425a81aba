"""What is wrong in a JSON or TOML file, in plain words: the field, what was expected there, and what was found."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pydantic import ValidationError  # only its name: pydantic is slow to import

_OBJECT, _LIST, _WHOLE, _NUMBER, _TRUTH = (
    "an object {{...}}",
    "a list [...]",
    "a whole number",
    "a number",
    "true or false",
)

_EXPECTED: Mapping[str, str] = {
    "string_type": "a text",
    "string_too_short": "a text of at least {min_length} characters",
    "string_too_long": "a text of at most {max_length} characters",
    "int_type": _WHOLE,
    "int_parsing": _WHOLE,
    "int_parsing_size": f"{_WHOLE} that is not so large",
    "int_from_float": _WHOLE,
    "float_type": _NUMBER,
    "float_parsing": _NUMBER,
    "finite_number": "a finite number",
    "greater_than": "a number above {gt:g}",
    "greater_than_equal": "a number not below {ge:g}",
    "less_than": "a number below {lt:g}",
    "less_than_equal": "a number not above {le:g}",
    "bool_type": _TRUTH,
    "bool_parsing": _TRUTH,
    "literal_error": "{expected}",
    "enum": "{expected}",
    "none_required": "null",
    "list_type": _LIST,
    "tuple_type": _LIST,
    "set_type": _LIST,
    "frozen_set_type": _LIST,
    "iterable_type": _LIST,
    "too_short": "at least {min_length} entries",
    "too_long": "at most {max_length} entries",
    "dict_type": _OBJECT,
    "mapping_type": _OBJECT,
    "model_type": _OBJECT,
    "model_attributes_type": _OBJECT,
    "dataclass_type": _OBJECT,
    "dataclass_exact_type": _OBJECT,
    "union_tag_invalid": "{discriminator}: {expected_tags}",
    "union_tag_not_found": f"{_OBJECT} with a field {{discriminator}}",
}
"""What a field of each kind of complaint should have held."""
_LONGEST = 60  # characters of what was found


def first_validation_error(error: ValidationError) -> str:
    """Return the complaint about the first field of a file that does not fit, in one line."""
    return describe_invalid_field(error.errors(include_url=False)[0])


def describe_invalid_field(complaint: Mapping[str, Any]) -> str:
    """Return one complaint of pydantic's, in one line; complaint: one of those that `ValidationError.errors()`
    lists."""
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
        expected = _EXPECTED.get(kind, "").format(**about)
        problem = (
            f"expected {expected}, found {_format_value(given)}" if expected else f"{_format_value(given)} does not fit"
        )
    return f"{at}: {problem}" if at else problem


def _format_value(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False, default=str)
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3] + "..."
