"""What is missing on disk is an error in info, check and apply, with the file's name and a remedy."""

from pathlib import Path

import pytest

from tests.mjcf_engines import model
from tests.unit.cli.in_process import Run

BOX = '<geom type="box" size=".1 .1 .1"/>'
MESH = '<asset><mesh name="m" file="gone.obj"/></asset>'
SEEN = '<geom type="mesh" mesh="m" contype="0" conaffinity="0"/>'
LINK = '<robot name="r"><link name="a"><{0}><geometry><mesh filename="gone.obj"/></geometry></{0}>{1}</link></robot>'
SOLID = '<collision><geometry><box size="1 1 1"/></geometry></collision>'
STAGE = """#usda 1.0
(
    defaultPrim = "r"
)
def Xform "r" (
    prepend apiSchemas = ["PhysicsRigidBodyAPI"]
)
{
    def Cube "box" (
        prepend apiSchemas = ["PhysicsCollisionAPI"]
    )
    {
    }
    def Xform "part" (
        references = @./gone.usda@
    )
    {
    }
}
"""
LOST = {
    "seen.xml": (model(f'<body name="b">{BOX}{SEEN}</body>', MESH), "gone.obj"),
    "solid.xml": (model(f'<body name="b">{BOX}<geom type="mesh" mesh="m"/></body>', MESH), "gone.obj"),
    "solid.urdf": (LINK.format("collision", SOLID), "gone.obj"),
    "part.usda": (STAGE, "gone.usda"),
}


@pytest.mark.parametrize("name", LOST)
def test_a_file_that_is_needed_and_not_there_is_an_error(name: str, run: Run) -> None:
    text, gone = LOST[name]
    if name.endswith("usda"):
        pytest.importorskip("pxr")
    Path(name).write_text(text)
    Path("merge.mf").write_text("All => Merge\n")
    for words in (("info", name), ("check", name), ("apply", "merge.mf", name, "-o", "out")):
        told = run(*words)
        said = told.out + told.err
        assert told.code in (1, 2) and gone in said and "not there" in said and "correct the reference" in said, words
        assert "legal" not in said
    assert not Path("out", name).exists()


def test_a_visual_file_that_is_not_there_stays_a_note(run: Run) -> None:
    Path("cup.urdf").write_text(LINK.format("visual", SOLID))
    assert run("info", "cup.urdf").code == run("check", "cup.urdf").code == 0
