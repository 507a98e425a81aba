"""A person with a mouse, who knows what every hull is and what is wanted of each asset."""

from __future__ import annotations

from functools import partial
from itertools import groupby
from typing import Any

from tests.e2e.expert import Expert, is_up_to_date
from tests.e2e.walk import go_to

_IN_SIGHT = """
() => {
  const box = document.querySelector('[data-testid=family]').getBoundingClientRect();
  return [...document.querySelectorAll('[data-testid=family] [role=option]')].filter(one => {
    const { top, bottom } = one.getBoundingClientRect();
    return top >= box.top && bottom <= box.bottom;
  }).map(one => one.dataset.asset);
}
"""
"""The assets whose cards are wholly in sight."""


class Pointer(Expert):
    """Selects by the mouse: a hull and its look-alikes, then what is still missing or too much."""

    def open_asset(self, asset: str) -> None:
        go_to(self.person, asset)

    def choose(self, asset: str, hulls: frozenset[str]) -> None:
        self.person.drawn(asset)
        looks_for_alike = True
        while left := hulls - self._selected():
            self._take(min(left, key=lambda hull: (not self._is_seen(hull), hull)))
            if looks_for_alike:
                before = self._selected()
                with self.person.page.expect_response(lambda one: one.url.endswith("/api/similar")):
                    self.person.press("j")
                self.person.page.wait_for_timeout(200)  # there may be none
                more = self._selected() - before
                looks_for_alike = len(more - hulls) <= len(more & hulls)
        for hull in sorted(self._selected() - hulls):
            self._take(hull)
        assert self._selected() == hulls

    def _take(self, hull: str) -> None:
        """Click on a hull in the view, or in the list where others hide it; Ctrl is pressed for all clicks at once."""
        if self._is_seen(hull):
            self.person.hull(hull, *(["Control"] if self._selected() else []))
            self.person.actions -= bool(self._selected())
            return
        row = self.person.page.locator(f'[role=row][data-name="{hull}"]')
        self.person.page.get_by_role("grid", name="Hulls").hover()
        for _ in range(60):
            if row.count():
                break
            self.person.page.mouse.wheel(0, 200)
            self.person.page.wait_for_timeout(50)
        self.person.actions += 1  # to scroll
        self.person.click(row, modifiers=["Control"])

    def _selected(self) -> frozenset[str]:
        return frozenset(self.person.page.evaluate("window.meshforgeViewport.selected()"))

    def _is_seen(self, hull: str) -> bool:
        return self.person.page.evaluate("name => window.meshforgeViewport.project(name)", hull) is not None

    def _answer(self, question: dict[str, Any]) -> None:
        if question["kind"] == "result" and self.is_right(question["asset"]):
            return self._accept_in_sight()
        of_all = {self.truth[hull["asset"]][hull["hull"]] for hull in question["hulls"]}
        if question["kind"] != "group" or len(of_all) == 1:
            return super()._answer(question)
        by_asset = groupby(question["hulls"], key=lambda hull: hull["asset"])
        for asset, hulls in ((asset, [hull["hull"] for hull in some]) for asset, some in by_asset):
            self._except(asset, hulls, [choice["label"] for choice in question["choices"]])
        self.person.press("1")

    def _except(self, asset: str, hulls: list[str], labels: list[str]) -> None:
        """Say of the hulls of an asset in a group what they are: of all at once what most of them are, then of each."""
        wanted = [labels.index(self.truth[asset][hull]) for hull in hulls]
        most = max(wanted, key=lambda label: (wanted.count(label), -label))
        common = most if wanted.count(most) > wanted.count(0) + 1 else 0
        for hull, own in zip(hulls, wanted, strict=True):
            button = self.person.page.get_by_role("button", name=f"{hull} of {asset}: ")
            if hull == hulls[0]:
                for _ in range(common):
                    self.person.click(button, modifiers=["Shift"])
            for _ in range((own - common) % len(labels)):
                self.person.click(button)

    def _accept_in_sight(self) -> None:
        """Accept all results at a look, with the family in the centre, unless one of them is wrong: that one first."""
        person, stage = self.person, self.person.page.get_by_role("tab", name="Review")
        if stage.get_attribute("aria-selected") != "true":
            person.press("Alt+4")
        if not is_up_to_date(self.studio.cards(bool)):
            person.click("Apply to all")
            self.studio.cards(is_up_to_date)
        if person.page.get_by_role("button", name="Show the family in the centre").count():
            person.press("q")
        accept = person.page.get_by_role("button", name="in sight")
        accept.wait_for()
        while accept.count():
            seen = person.page.evaluate(_IN_SIGHT)
            assert seen
            if wrong := [asset for asset in seen if not self.is_right(asset)]:
                return self._mend(wrong[0])
            person.click(accept)
            self.studio.cards(partial(_are_accepted, seen))
            person.page.wait_for_timeout(500)  # others move up

    def _mend(self, asset: str) -> None:
        """Say that a result is wrong, and show what is meant."""
        self.person.press("q")
        self.open_asset(asset)
        self.person.press("f", "Alt+2")
        self.show(asset)


def _are_accepted(assets: list[str], cards: dict[str, dict[str, Any]]) -> bool:
    return all(cards[asset]["review"] == "accepted" for asset in assets)
