"""How the studio decomposes what has no hulls, where nobody says how."""

from pathlib import Path

import pytest

from meshforge.batch import IN_PROCESS
from meshforge.geometry import CoacdSettings, VhacdSettings
from meshforge.project import DecompositionPlan, Project
from meshforge.studio.jobs.preparation import choose_decomposition
from meshforge.studio.wire.jobs import DecomposeJob
from tests.unit.project.stools import write_bare_stool

pytestmark = pytest.mark.slow  # CoACD

ASKED = DecomposeJob(assets=("b.urdf",))


def test_later_assets_are_decomposed_as_the_others_unless_these_differ_or_a_person_chooses(tmp_path: Path) -> None:
    for name in "abc":
        write_bare_stool(tmp_path / "assets", name)
    project = Project.create(tmp_path / "p", [tmp_path / "assets"])
    assert choose_decomposition(project, ASKED) == DecompositionPlan(CoacdSettings())
    settings = CoacdSettings(threshold=0.2)
    (done,) = project.decompose(["a.urdf"], settings, hollow=True, by="parts", execution=IN_PROCESS)
    assert len(done.hulls) == 5
    assert choose_decomposition(project, ASKED) == DecompositionPlan(settings, hollow=True, by="parts")
    chosen = ASKED.model_copy(update={"method": "vhacd", "most": 9})
    assert choose_decomposition(project, chosen) == DecompositionPlan(VhacdSettings(max_convex_hulls=9))
    chosen = ASKED.model_copy(update={"method": "coacd", "most": 7, "threshold": 0.4})
    assert choose_decomposition(project, chosen) == DecompositionPlan(CoacdSettings(0.4, 7))
    list(project.decompose(["c.urdf"], CoacdSettings(threshold=0.3), by="parts", execution=IN_PROCESS))
    assert choose_decomposition(project, ASKED) == DecompositionPlan(CoacdSettings())
