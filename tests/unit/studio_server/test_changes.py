from __future__ import annotations

from pathlib import Path

import pytest

from meshforge.store import Effect
from meshforge.studio.session.file_sync import FileChanges, changes_of
from tests.unit.project.tables import FIRST, SECOND, fresh

ONE = frozenset({FIRST})
LEARNING: frozenset[Effect] = frozenset({"learning"})


@pytest.mark.parametrize(
    ("name", "means"),
    [
        (f"labels/{FIRST}.json", FileChanges(ONE, effects=LEARNING)),
        (f"demonstrations/{FIRST}.json", FileChanges(ONE, effects=LEARNING)),
        (f"corrections/{FIRST}.json", FileChanges(assets=ONE)),
        (f"edited/.meshforge/stamps/{FIRST}.json", FileChanges(assets=ONE)),
        (f"prepared/{FIRST}/preparation.json", FileChanges(ONE, ONE, LEARNING)),
        (f"../assets/{FIRST}", FileChanges(ONE, ONE, LEARNING)),
        ("program.mf", FileChanges(effects=LEARNING | {"program"})),
        ("learned.json", FileChanges(effects=frozenset({"program"}))),
        ("single_parts.json", FileChanges(effects=frozenset({"questions", "spanning hulls"}))),
        ("signoffs.jsonl", FileChanges()),
        ("labels/gone.obj.json", FileChanges(effects=LEARNING)),
        ("notes.txt", FileChanges()),
    ],
)
def test_a_file_that_changed_means_what_depends_on_it(tmp_path: Path, name: str, means: FileChanges) -> None:
    assert changes_of(fresh(tmp_path), [name]) == means


def test_settings_concern_every_asset(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    found = changes_of(project, ["meshforge.toml"])
    assert found.assets == set(project.assets()) and found.effects == {"settings", "learning"}
    assert SECOND in found.assets and not found.shapes
