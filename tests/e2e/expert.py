"""A person who knows what every hull is and what is wanted of each asset, and answers the studio's cards by keys."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property, partial
from pathlib import Path
from typing import Any

from playwright.sync_api import TimeoutError

from meshforge.common import MeshForgeError
from meshforge.formats import load
from meshforge.language import Program
from meshforge.project import Project
from meshforge.symbolic import NO_PART, SymbolicMesh
from tests.e2e.hand import Hand
from tests.e2e.studio import Studio
from tests.e2e.walk import guessed, stepped

Selections = tuple[frozenset[str], ...]
_TRIES = 150
_CARDS = '[role=group][aria-label="What MeshForge asks"]'


@dataclass
class Expert:
    """assets: the folder of the files; truth: the label of each hull, by asset and name; meant: the program that does
    what is wanted, on true labels; folder: of the project; answered: cards by kind."""

    person: Hand
    studio: Studio
    assets: Path
    truth: Mapping[str, Mapping[str, str]]
    meant: Program
    folder: Path
    answered: Counter[str] = field(default_factory=Counter)

    @cached_property
    def selections(self) -> dict[str, Selections]:
        """What each rule should select, by asset."""
        results = {asset: self.meant.run(self.mesh(asset)) for asset in self.truth}
        return {asset: tuple(frozenset(line.selected) for line in one.trace) for asset, one in results.items()}

    @cached_property
    def volumes(self) -> dict[str, list[float]]:
        """What each result should be: the volumes of its hulls [m³], in order."""
        return {asset: volumes_of(self.meant.run(self.mesh(asset)).mesh) for asset in self.truth}

    def mesh(self, asset: str) -> SymbolicMesh:
        """An asset with its true labels."""
        return load(self.assets / asset).with_labels(self.truth[asset])

    def answer_all(self, watch: Callable[[dict[str, Any]], None]) -> None:
        """Answer cards until none is left. watch: sees each assessment."""
        last: dict[str, Any] | None = {}  # which is no question
        for _ in range(_TRIES):
            hello = self.studio.until(partial(_asks_another, last))
            watch(hello)
            question = open_question(hello)
            if question is None:
                return
            if self._go_to_card(question):
                last = question
                self.answered[last["kind"]] += 1
                self._answer(last)
        raise AssertionError("the studio asks without end")

    def _go_to_card(self, question: dict[str, Any]) -> bool:
        """Press the key of the card until it is there: a busy page may lose one. False where another is asked."""
        card = self.person.page.locator(f'[id="question-{question["id"]}"]')
        for timeout in (5_000, 10_000, 60_000):
            if not self.person.page.locator(f"{_CARDS}:focus-within").count():  # it keeps the focus from card to card
                self.person.press("u")
            with suppress(TimeoutError):
                card.wait_for(timeout=timeout)
                return True
            if open_question(self.studio.settled()) != question:
                return False
        raise AssertionError(f"the page does not ask: {question['text']}")

    def _answer(self, question: dict[str, Any]) -> None:
        kind, asset, rule = question["kind"], question["asset"], (question["rule"] or 1) - 1
        choices = question["choices"]
        if kind in ("candidate", "label", "selection"):
            wanted = self.selections[asset][rule]
            right = [k for k, choice in enumerate(choices) if frozenset(choice["select"] or ()) == wanted]
            self.person.press(str(right[0] + 1) if right else "n")
        elif kind in ("group", "repair"):
            names = {self.truth[hull["asset"]][hull["hull"]] for hull in question["hulls"]}
            right = [k for k, choice in enumerate(choices) if {choice["label"]} == names]
            self.person.press(str(right[0] + 1) if right else "n")
            if not right:
                self.label([(hull["asset"], hull["hull"]) for hull in question["hulls"]])
        elif kind == "result":
            if self.is_right(asset):
                self.person.press("y")
            else:
                self.person.press("n")
                self.person.button("Show it").wait_for()
                self.person.press("n")
                self.show(asset)
        elif kind == "demonstrate":
            self.person.press("y")
            self.show(asset)
        else:
            self.person.press("l")

    def is_right(self, asset: str) -> bool:
        """Whether what the program makes of an asset now is what is wanted."""
        project = Project.open(self.folder)
        program = project.program()
        if program is None:
            return False
        try:
            return volumes_of(program.run(project.mesh(asset)).mesh) == self.volumes[asset]
        except MeshForgeError:
            return False

    # Acting without the mouse

    def open_asset(self, asset: str) -> None:
        """Open an asset by the list of commands."""
        self.person.press("Control+k")
        self.person.page.get_by_role("combobox").wait_for()
        self.person.type(asset)
        self.person.press("Enter")
        self.person.drawn(asset)

    def choose(self, asset: str, hulls: frozenset[str]) -> None:
        """Select hulls of the asset that is open, in the list of hulls."""
        self.person.drawn(asset)
        self.person.choose(hulls)

    def label(self, hulls: list[tuple[str, str]]) -> None:
        """Say of some hulls what they are, one asset and label after the other."""
        words = [row["name"] for row in self.studio.settled()["project"]["vocabulary"]]
        wanted = dict[tuple[str, str], set[str]]()
        for asset, hull in hulls:
            wanted.setdefault((asset, self.truth[asset][hull]), set()).add(hull)
        self.person.press("Alt+1")
        for (asset, word), names in wanted.items():
            self.open_asset(asset)
            self.choose(asset, frozenset(names))
            self.person.press("0" if word == NO_PART else str(words.index(word) + 1))

    def show(self, asset: str) -> None:
        """Demonstrate on an asset all that is wanted of it, where earlier demonstrations say what the rules do."""
        self.person.drawn(asset)
        for step, wanted in enumerate(self.selections[asset], 1):
            guessed(self.person, step)
            if frozenset(self.person.page.evaluate("window.meshforgeViewport.selected()")) != wanted:
                self.choose(asset, wanted)
            self.person.press("Enter")
            stepped(self.person, step)

    def show_first(self, asset: str, keys: Sequence[Sequence[str]]) -> None:
        """Demonstrate the rules on the first asset."""
        self.open_asset(asset)
        for step, (own, hulls) in enumerate(zip(keys, self.selections[asset], strict=True), 1):
            self.choose(asset, hulls)
            for key in own:
                if len(key) == 1:
                    self.person.press(key)
                else:
                    self.person.click(key)
            self.person.press("Enter")
            stepped(self.person, step)


def _asks_another(last: dict[str, Any] | None, hello: dict[str, Any]) -> bool:
    """Whether all is worked out, and something else is asked than before."""
    over = not hello["learning"] and not hello["assessing"]
    known = hello["outcome"] and hello["assessment"] is not None
    return bool(over and known) and open_question(hello) != last


def open_question(hello: dict[str, Any]) -> dict[str, Any] | None:
    """What is asked."""
    found: dict[str, Any] | None = (hello["assessment"] or {}).get("question")
    return found


def is_up_to_date(cards: dict[str, dict[str, Any]]) -> bool:
    return all(card["output"] == "edited" and not card["stale"] for card in cards.values())


def volumes_of(mesh: SymbolicMesh) -> list[float]:
    """The volumes of the hulls of a mesh [m³], in order."""
    return sorted(round(hull.volume, 6) for hull in mesh.hulls)
