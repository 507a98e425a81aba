"""The demo in the studio, as a newcomer starts it, and starts it again."""

from __future__ import annotations

from pathlib import Path

from tests.e2e.studio import ending, ok, started

FIRST = "table_01.obj"


def test_the_demo_begins_with_labelled_tables_and_a_tour_and_keeps_what_is_done(tmp_path: Path) -> None:
    words = ("demo", "--studio", "--out", str(tmp_path / "tables"))
    with ending(started(*words)) as studio:
        hello = studio.settled()
        cards = {card["asset"]: card for card in hello["cards"]}
        assert hello["tour"] and hello["outcome"] is None and not hello["program"]["text"]
        assert len(cards) == 14
        assert all(place >= 0 for place in cards[FIRST]["labels"])
        assert not any(card["demonstrated"] for card in cards.values())
        assert hello["history"]["undoable"] == 0
        fields = studio.steps(FIRST)
        assert fields["steps"] == []
        studio.edit("steps", **fields | {"steps": [{"select": ["convex_00"], "action": {"name": "Delete"}}]})
    with ending(started(*words)) as studio:
        hello = studio.settled()
        assert hello["tour"] and hello["history"]["undoable"] == 1
        assert [card["asset"] for card in hello["cards"] if card["demonstrated"]] == [FIRST]
        assert studio.steps(FIRST)["steps"] == [
            {"select": ["convex_00"], "action": {"name": "Delete", "arguments": {}, "each": False, "label": None}}
        ]
        ok(studio.post("/api/undo"))
        assert studio.steps(FIRST)["steps"] == []
