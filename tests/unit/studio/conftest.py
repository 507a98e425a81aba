"""What tests of the studio share: the bundled tables as a project, and a flag that stops work."""

from collections.abc import Iterator

import pytest

from meshforge.project import Project
from meshforge.studio.learning.queue import CancelFlag
from tests.studio_project import demo_project


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Project:
    return demo_project(tmp_path_factory.mktemp("tables"))


@pytest.fixture
def flag() -> Iterator[CancelFlag]:
    made = CancelFlag()
    yield made
    made.close()
    assert not made.path.exists()
