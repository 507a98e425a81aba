"""The files of results: read back, they are what was written; and what changed is a line of a diff."""

import json
from types import ModuleType

import pytest

from benchmark.learning import asking, calibrate, growth, repairs
from benchmark.report import Goal, Result, Table, as_text, write_lines
from benchmark.speed import geometry, load, robots, save

DETAILS = ({"task": "cup-easy", "rounds": [{"answers": 0}, {"answers": 1}], "shown": []}, {"task": "Küche", "f1": 0.1})
RESULT = Result(
    "part",
    "Title",
    (Table("cups", ("mesh", "pass, %"), (("one", 1.5), ("two", 2))), Table("empty", ("mesh",), ())),
    (Goal("share, %", "at least", 90.0, 91.0),),
    ("a note", "another"),
    DETAILS,
)


def test_what_is_read_back_is_what_was_written() -> None:
    data = {"quick": False, "machine": {"cores": "2"}, **RESULT.to_json()}
    found = json.loads(write_lines(data))
    assert found == json.loads(json.dumps(data))
    assert list(found) == list(data)
    assert Result.of_json(found) == RESULT


def test_each_detail_goal_note_and_row_of_a_table_has_a_line() -> None:
    lines = write_lines(RESULT.to_json()).splitlines()
    assert '{"task":"cup-easy","rounds":[{"answers":0},{"answers":1}],"shown":[]},' in lines
    assert '{"task":"Küche","f1":0.1}' in lines
    assert '["one",1.5],' in lines
    assert '"a note",' in lines
    assert sum(line.startswith('{"what":') for line in lines) == 1


def silent(_: str) -> None: ...


LONG = [pytest.param(part, marks=pytest.mark.long) for part in (asking, calibrate, repairs)]


@pytest.mark.parametrize("part", [load, robots, save, geometry, growth, *LONG])
def test_a_part_runs_quickly_and_its_result_is_read_back(part: ModuleType) -> None:
    result = part.measure(silent, True)
    assert isinstance(result, Result)
    assert all(table.rows for table in result.tables)
    assert all(len(row) == len(table.columns) for table in result.tables for row in table.rows)
    assert as_text(Result.of_json(json.loads(json.dumps(result.to_json())))) == as_text(result)
