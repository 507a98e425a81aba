"""How many acts (a click, a drag, a key) it takes to label a chair, as a person does who sees the view and knows the
parts.
"""

from __future__ import annotations

import time
from pathlib import Path

from playwright.sync_api import Browser

from tests.e2e.chair_family import FIVE, ChairFamily, ChairShape, chair_family
from tests.e2e.hand import Hand
from tests.e2e.labelling import visible
from tests.e2e.studio import PATIENCE
from tests.e2e.walk import visiting

MOST_ACTS = 14
"""For a chair of 24 hulls and five labels."""

Spot = tuple[float, float]


def test_a_chair_of_24_hulls_takes_few_acts(tmp_path: Path, browser: Browser) -> None:
    """Seat, back and arms are painted, the rails found from one, and the legs are what has no label then."""
    family = chair_family(tmp_path, [ChairShape(slats=3)], FIVE)
    (asset,) = family.truth
    parts = dict(zip(family.truth[asset], family.parts[asset], strict=True))
    assert len(parts) == 24
    with visiting(tmp_path, family.project, browser) as (_, person):

        def spots(*wanted: str) -> list[Spot]:
            return [see(person, name) for part in wanted for name, its in parts.items() if its == part]

        right_post = max(spots("post"))
        person.press("1")
        stroke(person, spots("seat"))
        person.press("4")
        stroke(person, [*spots("crest"), right_post, *sorted(spots("slat"), key=lambda at: at[1]), min(spots("post"))])
        person.page.keyboard.down("5")  # held, so that clicks select again after it
        for side in (min, max):
            (x, y), support = side(spots("arm")), side(spots("support"))
            stroke(person, [(x, y), (support[0], y + 0.6 * abs(x - support[0])), support])  # along the arm, then down
        person.page.keyboard.up("5")
        person.actions += 1
        person.hull(next(name for name, part in parts.items() if part == "stretcher" and visible(person, name)))
        person.press("j")
        selected(person, 4)
        person.press("3")
        # all that is left are legs, one of them behind the seat
        person.hull(next(name for name, part in parts.items() if part == "leg" and visible(person, name)))
        person.press("Shift+L")
        selected(person, 8)
        person.press("2")
        until_right(family)
    print(f"\n24 hulls, five labels: {person.actions} acts (at most {MOST_ACTS})")
    assert person.actions <= MOST_ACTS


def see(person: Hand, hull: str) -> Spot:
    """Where a hull is seen."""
    at = person.page.evaluate("name => window.meshforgeViewport.project(name)", hull)
    assert at, f"nothing is seen of {hull}"
    return at["x"], at["y"]


def stroke(person: Hand, spots: list[Spot]) -> None:
    """Drag from spot to spot, which is one act."""
    mouse = person.page.mouse
    mouse.move(*spots[0])
    mouse.down()
    for x, y in spots[1:]:
        mouse.move(x, y, steps=4)
    mouse.up()
    person.actions += 1


def selected(person: Hand, count: int) -> None:
    """Wait until so many hulls are outlined."""
    person.page.wait_for_function("count => window.meshforgeViewport.selected().length === count", arg=count)


def until_right(family: ChairFamily) -> None:
    """Wait until every hull has its label on disk."""
    deadline = time.monotonic() + PATIENCE
    while (found := family.labels()) != family.truth:
        wrong = {
            f"{asset} {hull}": (found[asset].get(hull), part)
            for asset, own in family.truth.items()
            for hull, part in own.items()
            if found[asset].get(hull) != part
        }
        assert time.monotonic() < deadline, wrong
        time.sleep(0.05)
