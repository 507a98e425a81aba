from pathlib import Path

import pytest

from meshforge.common import ProjectError
from tests.unit.project.tables import FIRST, SECOND, labelled


def test_of_labels_of_several_assets_all_are_written_or_none(tmp_path: Path) -> None:
    project = labelled(tmp_path)
    hull = next(iter(project.mesh(FIRST).index))
    project.set_labels(FIRST, {hull: project.vocabulary[0]})
    before = [project.layout.labels(asset).read_bytes() for asset in (FIRST, SECOND)]
    with pytest.raises(ProjectError, match="no hull"):
        project.set_labels_of({FIRST: {hull: None}, SECOND: {"nowhere": project.vocabulary[0]}})
    assert [project.layout.labels(asset).read_bytes() for asset in (FIRST, SECOND)] == before
