from __future__ import annotations

from pathlib import Path

import pytest

from meshforge.studio.state.changes import Changes, changes_of
from tests.unit.project.tables import FIRST, SECOND, fresh

ONE = frozenset({FIRST})


@pytest.mark.parametrize(
    ("name", "means"),
    [
        (f"labels/{FIRST}.json", Changes(assets=ONE, learning=True)),
        (f"demonstrations/{FIRST}.json", Changes(assets=ONE, learning=True)),
        (f"corrections/{FIRST}.json", Changes(assets=ONE)),
        (f"edited/.meshforge/stamps/{FIRST}.json", Changes(assets=ONE)),
        (f"prepared/{FIRST}/preparation.json", Changes(assets=ONE, shapes=ONE, learning=True)),
        (f"../assets/{FIRST}", Changes(assets=ONE, shapes=ONE, learning=True)),
        ("answers.json", Changes(learning=True)),
        ("review.json", Changes(reviews=True, learning=True)),
        ("program.mf", Changes(program=True, learning=True)),
        (".meshforge/learned.json", Changes(program=True)),
        ("labels/gone.obj.json", Changes(learning=True)),
        ("notes.txt", Changes()),
    ],
)
def test_a_file_that_changed_means_what_depends_on_it(tmp_path: Path, name: str, means: Changes) -> None:
    assert changes_of(fresh(tmp_path), [name]) == means


def test_settings_concern_every_asset(tmp_path: Path) -> None:
    project = fresh(tmp_path)
    found = changes_of(project, ["meshforge.toml"])
    assert found.assets == set(project.assets()) and found.settings and found.learning
    assert SECOND in found.assets and not found.shapes
