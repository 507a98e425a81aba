import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from meshforge.formats.engine_names import godot_kind, strip_godot_suffix, unreal_kind, visible_mesh_of
from meshforge.formats.gltf.document import rewrite_json
from tests.examples import examples

SCALARS = st.none() | st.booleans() | st.integers(-9, 9) | st.floats(allow_nan=False, allow_infinity=False) | st.text()
KEYS = st.sampled_from("abcd")
VALUES = st.recursive(SCALARS, lambda inner: st.lists(inner, max_size=4) | st.dictionaries(KEYS, inner), max_leaves=12)
TREES = st.dictionaries(KEYS, VALUES) | st.lists(VALUES)
LAYOUTS = st.sampled_from([(None, (",", ":")), (None, (", ", ": ")), (2, (",", ": ")), ("\t", (",", " : ")), (0, None)])


@examples(60)
@given(TREES, TREES, LAYOUTS)
def test_any_value_can_become_any_other(old: Any, new: Any, layout: Any) -> None:
    text = json.dumps(old, indent=layout[0], separators=layout[1])
    assert json.loads(rewrite_json(text, new)) == new
    assert rewrite_json(text, old) == text


@examples(60)
@given(st.lists(VALUES, min_size=1, max_size=6), VALUES, st.data(), LAYOUTS)
def test_what_stays_of_a_list_keeps_its_text(old: list[Any], more: Any, data: st.DataObject, layout: Any) -> None:
    kept = [value for value in old if data.draw(st.booleans())]
    new = [*kept, more]
    text = json.dumps({"list": old, "x": 1.0}, indent=layout[0], separators=layout[1])
    assert json.loads(rewrite_json(text, {"list": new, "x": 1.0})) == {"list": new, "x": 1.0}


def test_numbers_escapes_and_blanks_stay_and_new_members_are_laid_out_alike() -> None:
    text = '{\r\n\t"a" : [\r\n\t\t1.00,\r\n\t\t-0\r\n\t],\r\n\t"b": {"\\u0063":1.50e0}\r\n}\r\n'
    new = {"a": [1.0, 0, {"x": 1}], "b": {"c": 1.5, "d": 2}, "e": 3}
    assert rewrite_json(text, new) == (
        '{\r\n\t"a" : [\r\n\t\t1.00,\r\n\t\t-0,\r\n\t\t{\r\n\t\t\t"x": 1\r\n\t\t}\r\n\t],\r\n'
        '\t"b": {"\\u0063":1.50e0,"d":2},\r\n\t"e": 3\r\n}\r\n'
    )


def test_a_removed_member_takes_its_comma_along() -> None:
    text = '{"a": 1.0, "b": 2.0, "c": 3.0}'
    assert rewrite_json(text, {"a": 1, "c": 3}) == '{"a": 1.0, "c": 3.0}'
    assert rewrite_json(text, {"b": 2}) == '{"b": 2.0}'
    assert rewrite_json(text, {"a": 1}) == '{"a": 1.0}'
    assert rewrite_json(text, {"d": 4}) == '{"d": 4}'


@pytest.mark.parametrize(
    ("name", "kind", "rest"),
    [
        ("a-col", "col", "a"),
        ("a_convcol", "convcol", "a"),
        ("a-COLONLY.001", "colonly", "a"),
        ("a$convcolonly$b 3", "convcolonly", "a$b"),
        ("col", None, "col"),
        ("a-col-b", None, "a-col-b"),
        ("a-col#1", None, "a-col#1"),
        ("collar", None, "collar"),
        (None, None, None),
    ],
)
def test_godot_takes_names_that_end_so(name: str | None, kind: str | None, rest: str | None) -> None:
    assert godot_kind(name) == kind
    assert name is None or strip_godot_suffix(name) == rest


def test_unreal_takes_names_that_begin_so() -> None:
    kinds = [unreal_kind(name) for name in ("UCX_a", "ubx_a", "USP_", "UCP_a_01", "UCXa", "aUCX_a", None)]
    assert kinds == ["UCX", "UBX", "USP", "UCP", None, None, None]


def test_the_mesh_of_an_unreal_name_is_the_longest_that_is_there() -> None:
    assert visible_mesh_of("UCX_table_top_01", ["table", "table_top"]) == "table_top"
    assert visible_mesh_of("UCX_table_top_01", ["table"]) == "table"
    assert visible_mesh_of("UCX_table_top_01", []) == "table_top"
    assert visible_mesh_of("UCX_01", ["01"]) == "01"
