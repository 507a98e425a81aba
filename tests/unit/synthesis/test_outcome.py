"""Outcomes, and the JSON that scripts read."""

import json

from meshforge.language import Delete, Merge
from meshforge.synthesis import Demonstration, NoProgram, Step, outcome_to_json, synthesize
from tests.synthesis_boxes import boxes

KEYS = [
    "status",
    "program",
    "unambiguous",
    "candidates",
    "repairs",
    "open_rule",
    "nearest",
    "overruled",
    "stale_answers",
    "suggested_orientation",
    "seconds",
]
TWINS = boxes(
    ("left", "leg", (0, 0, 0), (1, 1, 1)),
    ("middle", "leg", (2, 0, 0), (1, 1, 1)),
    ("right", "leg", (4, 0, 0), (1, 1, 1)),
    ("more", "leg", (6, 0, 0), (1, 1, 1)),
    ("top", "panel", (0, 0, 1.5), (7, 1, 1)),
)


def test_a_found_program_as_json() -> None:
    outcome = synthesize([Demonstration(TWINS, [Step(1, {"top"}, Delete())])])
    shape = outcome_to_json(outcome)
    assert list(shape) == KEYS
    assert sorted(shape.pop("seconds")) == ["replay", "search"]
    assert json.loads(json.dumps(shape)) == {
        "status": "found",
        "program": "labels leg, panel\n\nIs(panel) => Delete\n",
        "unambiguous": False,
        "candidates": [{"id": "1.1", "rule": 1, "extractor": "Is(panel)", "size": 1, "belief": 1.0, "differs_on": []}],
        "repairs": [],
        "open_rule": None,
        "nearest": None,
        "overruled": [],
        "stale_answers": [],
        "suggested_orientation": None,
    }


def test_hulls_that_nothing_tells_apart_give_a_nearest_miss_and_say_why() -> None:
    steps = [Step(1, {"top"}, Delete()), Step(2, {"left", "middle"}, Merge())]
    outcome = synthesize([Demonstration(TWINS, steps, "twins")])
    assert isinstance(outcome, NoProgram)
    assert outcome.why == (
        "'middle' of twins was selected and 'right' of twins was not, yet every extractor treats them alike; "
        "a label of its own for one of them would tell them apart"
    )
    shape = outcome_to_json(outcome)
    assert shape["status"] == "none"
    assert shape["program"] is None
    assert [reading["extractor"] for reading in shape["candidates"]] == ["Is(panel)"]
    assert shape["nearest"] == {
        "rule": 2,
        "extractor": "Geo(Is(leg), -X)",
        "asset": "twins",
        "extra": [],
        "missing": ["middle"],
    }


def test_the_nearest_miss_tells_of_the_mesh_where_it_differs_most() -> None:
    door = boxes(
        ("a", "handle", (0, 0, 0), (1, 1, 1)),
        ("b", "handle", (0, 0, 2), (1, 1, 1)),
        ("c", "handle", (0, 0, 4), (1, 1, 1)),
        ("d", "handle", (0, 0, 6), (1, 1, 1)),
    )
    demos = [
        Demonstration(door, [Step(1, {"a", "b", "d"}, Delete())], "one"),
        Demonstration(door, [Step(1, {"a", "d"}, Delete())], "two"),
        Demonstration(door, [Step(1, {"a", "b", "d"}, Delete())], "three"),
    ]
    outcome = synthesize(demos)
    assert isinstance(outcome, NoProgram)
    nearest = outcome.nearest
    assert (nearest.asset, nearest.extra, nearest.missing) == ("one", (), ("b",))
