"""What is said of a field that does not fit is in plain words, whatever pydantic calls it."""

import re
from typing import Annotated, Literal, get_args

import pytest
from pydantic import BaseModel, ConfigDict, Field, ValidationError
from pydantic_core.core_schema import ErrorType

from meshforge.common import describe_invalid_field, first_validation_error

THEIR_WORDS = re.compile(
    r"[Ii]nput|valid |instance|permitted|required|parse|dictionary|Error|mapping|expected ident|\{\}"
)


class Line(BaseModel):
    model_config = ConfigDict(extra="forbid")

    rule: Annotated[int, Field(ge=1)]
    verdict: Literal["accepted", "flagged"] = "accepted"
    share: Annotated[float | None, Field(gt=0, le=1, allow_inf_nan=False)] = None
    select: tuple[str, ...] | None = None


class File(BaseModel):
    steps: tuple[Line, ...]
    words: dict[str, bool] = {}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{}", "the field steps is missing"),
        ("[]", "expected an object {...}, found []"),
        ("{", "this is no JSON (line 1, column 1)"),
        ('{"steps": 3}', "the field steps: expected a list [...], found 3"),
        ('{"steps": [null]}', "the field steps[0]: expected an object {...}, found null"),
        ('{"steps": [{"rule": 0}]}', "the field steps[0].rule: expected a number not below 1, found 0"),
        ('{"steps": [{"rule": "x"}]}', 'the field steps[0].rule: expected a whole number, found "x"'),
        ('{"steps": [{"rule": 1, "rules": 2}]}', "there is no such field as steps[0].rules"),
        ('{"steps": [{"rule": 1, "share": 2}]}', "the field steps[0].share: expected a number not above 1, found 2"),
        ('{"steps": [{"rule": 1, "share": 0}]}', "the field steps[0].share: expected a number above 0, found 0"),
        ('{"steps": [{"rule": 1, "select": [7]}]}', "the field steps[0].select[0]: expected a text, found 7"),
        (
            '{"steps": [{"rule": 1, "verdict": "no"}]}',
            "the field steps[0].verdict: expected 'accepted' or 'flagged', found \"no\"",
        ),
        ('{"steps": [], "words": {"a": []}}', "the field words.a: expected true or false, found []"),
        ('{"steps": "' + "x" * 99 + '"}', f'the field steps: expected a list [...], found "{"x" * 56}...'),
    ],
)
def test_the_first_field_that_does_not_fit_is_named_with_what_was_expected(text: str, said: str) -> None:
    with pytest.raises(ValidationError) as raised:
        File.model_validate_json(text)
    assert first_validation_error(raised.value) == said


@pytest.mark.parametrize("kind", get_args(ErrorType))
def test_no_word_of_pydantic_reaches_a_person(kind: str) -> None:
    about = {
        **{"gt": 1, "ge": 1.5, "lt": 2, "le": 2, "min_length": 1, "max_length": 9, "expected": "'a' or 'b'"},
        **{"discriminator": "do", "expected_tags": "'cut'", "error": ValueError("there are two of them")},
    }
    said = describe_invalid_field({"type": kind, "loc": ("a", 0), "input": 5, "ctx": about, "msg": "Input is no good"})
    assert "a[0]" in said or kind == "json_invalid"
    assert not THEIR_WORDS.search(said), said
