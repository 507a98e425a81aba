import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.common import ProjectError
from meshforge.store.settings import TomlValue, set_value
from tests.examples import examples

TEXT = """\
# our tables
name = "tables" # never change

vocabulary = [
  "top", # the # board
  "leg",
]  # closed list
orient = "+Z: Is('#')" # up

[thresholds] # shares
contact = 0.002

[[note]]
words = [
  ["a"],
]
"""


def test_only_the_value_changes_and_comments_stay() -> None:
    assert set_value(TEXT, "orient", "+X # 1") == TEXT.replace('''"+Z: Is('#')"''', '"+X # 1"')
    assert set_value(TEXT, "contact", 0.01, "thresholds") == TEXT.replace("0.002", "0.01")


def test_keys_of_other_characters_are_found_and_written_in_quotes() -> None:
    text = '[names]\n"*leg*" = "leg" # all\n\'/a\\d/\' = "top"\n'
    assert set_value(text, "*leg*", "foot", "names") == text.replace('"leg"', '"foot"')
    assert tomllib.loads(set_value(text, "/a\\d/", "lid", "names"))["names"] == {"*leg*": "leg", "/a\\d/": "lid"}
    assert set_value("", "a b", "c", "names") == '\n[names]\n"a b" = "c"\n'


def test_a_table_within_a_table_is_found() -> None:
    text = '[a]\nx = 1\n[a.b]\n"y z" = "here"  # why\n[c]\n'
    assert set_value(text, "y z", "there", "a.b") == text.replace("here", "there")
    assert set_value("[a]\nx = 1\n", "y", 2, "a.b") == "[a]\nx = 1\n\n[a.b]\ny = 2\n"
    assert set_value("[a]\nx = 1\n", "y", None, "a.b") == "[a]\nx = 1\n"


def test_none_takes_a_key_away() -> None:
    assert set_value(TEXT, "name", None) == TEXT.replace('name = "tables" # never change\n', "")
    assert set_value(TEXT, "absent", None) == TEXT


def test_what_cannot_be_followed_is_refused_and_left_alone() -> None:
    with pytest.raises(ProjectError, match="cannot be changed where it stands"):
        set_value("thresholds = { contact = 0.1 }\n", "contact", 0.2, "thresholds")


@examples(150)
@given(
    key=st.sampled_from(["name", "vocabulary", "orient", "fresh"]),
    value=st.text(st.characters(exclude_categories=["Cs"])) | st.lists(st.text("ab\"'#\\é\n"), max_size=3),
)
def test_whatever_is_set_reads_back_and_the_rest_as_before(key: str, value: TomlValue) -> None:
    before, after = tomllib.loads(TEXT), tomllib.loads(set_value(TEXT, key, value))
    assert after == {**before, key: value}
