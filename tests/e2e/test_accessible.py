"""What a screen reader and weak eyes meet in each view, judged by axe-core, light and dark."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from tests.e2e.hand import Hand, chromium, hand
from tests.e2e.studio import opened
from tests.e2e.walk import PAGE, address
from tests.studio_project import demo_project

AXE = Path(__file__).parents[2] / "web" / "node_modules" / "axe-core" / "axe.min.js"
VIEWS = {"label": "Alt+1", "demonstrate": "Alt+2", "learn": "Alt+3", "review": "Alt+4", "help": "?"}
_JUDGE = """
() => axe.run(document, {
  resultTypes: ['violations'],
  rules: { 'label-content-name-mismatch': { enabled: true } },  // experimental, so off unless asked for
})
"""


@pytest.mark.skipif(not AXE.exists(), reason="axe-core is not installed: run script/bootstrap dev")
def test_every_view_can_be_read_and_reached(tmp_path: Path) -> None:
    project = demo_project(tmp_path)
    with opened(tmp_path, project.folder, "--page", str(PAGE)) as studio, chromium() as browser:
        studio.settled()
        for theme in ("light", "dark"):
            person = hand(browser)
            person.page.emulate_media(color_scheme=theme)
            person.page.add_init_script(path=AXE)
            person.open(address(studio))
            for view, key in VIEWS.items():
                person.press(key)
                person.page.wait_for_timeout(800)  # until what glides and fades has come to rest
                assert _found(person) == [], f"{view}, {theme}"
            person.page.context.close()


def _found(person: Hand) -> list[tuple[str, str]]:
    """What is wrong, and where."""
    violations: list[dict[str, Any]] = person.page.evaluate(_JUDGE)["violations"]
    return [(one["id"], node["html"]) for one in violations for node in one["nodes"]]
