"""An engine that is installed is asked itself; what it refuses is never called legal."""

import json
import os
import subprocess
import sys
from pathlib import Path

import mujoco
import pytest

from meshforge.batch import CheckTask, check_asset
from meshforge.checks import CheckOptions
from tests.corpus_case import ROOT
from tests.mjcf_engines import model, put
from tests.unit.cli.in_process import Run

BOX = '<geom type="box" size=".1 .1 .1"/>'
TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
MOVING = '<body name="b"><freejoint/>{}</body>'
ONLY_MUJOCO_MINDS = {
    "a massless body": model(MOVING.format(BOX.replace("/>", ' mass="0"/>'))),
    "a visual mesh that is not there": model(
        MOVING.format(BOX + '<geom type="mesh" mesh="m" contype="0" conaffinity="0"/>'),
        '<asset><mesh name="m" file="gone.obj"/></asset>',
    ),
    "a visual mesh of three vertices": model(
        MOVING.format(BOX + '<geom type="mesh" mesh="m" contype="0" conaffinity="0"/>'),
        '<asset><mesh name="m" vertex="0 0 0 1 0 0 0 1 0"/></asset>',
    ),
    "an unknown element": model(MOVING.format(BOX + "<blah/>")),
    "an actuator of no joint": model(MOVING.format(BOX)).replace(
        "</mujoco>", '<actuator><motor joint="nope"/></actuator></mujoco>'
    ),
    "two sites of one name": model(MOVING.format(BOX + '<site name="s"/><site name="s"/>')),
}
ALSO_UNREADABLE = {
    "two geoms of one name": model(MOVING.format(2 * BOX.replace("<geom", '<geom name="g"'))),
    "a mesh of coplanar vertices": model(
        MOVING.format('<geom type="mesh" mesh="m"/>'),
        '<asset><mesh name="m" vertex="0 0 0 1 0 0 0 1 0 1 1 0"/></asset>',
    ),
    "an include that is not there": f'<mujoco><include file="gone.xml"/><worldbody>{BOX}</worldbody></mujoco>',
}


def refusal(path: Path) -> str | None:
    """What MuJoCo says when it is given the file."""
    try:
        mujoco.MjModel.from_xml_path(str(path))
    except (ValueError, RuntimeError, mujoco.FatalError, mujoco.UnexpectedError) as error:
        return str(error)
    return None


def words(text: str) -> list[str]:
    return [word.strip(";") for word in text.replace("XML ", "").replace("Error: ", "").split()]


@pytest.mark.parametrize("name", ONLY_MUJOCO_MINDS)
def test_a_file_that_mujoco_refuses_is_an_error_in_its_own_words(name: str, tmp_path: Path, run: Run) -> None:
    path = put(tmp_path, {"cup.xml": ONLY_MUJOCO_MINDS[name]}, "cup.xml")
    said = refusal(path)
    assert said
    told = run("check", "cup.xml", "--engine", "mujoco", "--timeout", "60")
    assert told.code == 1 and "legal" not in told.out
    line, *others = [line for line in told.out.splitlines() if line.startswith("  error ")]
    assert others == ["  error MF602: not there: gone.obj"] * ("gone.obj" in said)
    begin = f"  error MF220: MuJoCo {mujoco.__version__} refuses cup.xml: "
    assert line.startswith(begin) and words(line.removeprefix(begin)) == words(said)
    plain = run("check", "cup.xml")
    assert "legal" not in plain.out and "note: MuJoCo refuses this file" in plain.out


@pytest.mark.parametrize("name", ALSO_UNREADABLE)
def test_a_file_that_cannot_be_read_either_is_an_error(name: str, tmp_path: Path) -> None:
    path = put(tmp_path, {"cup.xml": ALSO_UNREADABLE[name]}, "cup.xml")
    assert refusal(path)
    outcome = check_asset(path, tmp_path, None, CheckTask(CheckOptions(("mujoco",))))
    assert outcome.has_failed and outcome.error


def test_json_says_what_the_file_was_held_against(tmp_path: Path, run: Run) -> None:
    put(tmp_path, {"bad.xml": ONLY_MUJOCO_MINDS["a massless body"], "good.xml": model(MOVING.format(BOX))})
    bad, good = (
        json.loads(run("check", name, "--engine", "mujoco", "--json").out)["engine"] for name in ("bad.xml", "good.xml")
    )
    assert (bad["against"], bad["asked"], bad["given"]) == ("engine", f"MuJoCo {mujoco.__version__}", "file")
    assert "mjMINVAL" in bad["refused"] and good["refused"] is None
    by_table = json.loads(run("check", "good.xml", "--engine", "unreal", "--json").out)["engine"]
    assert (by_table["against"], by_table["asked"], by_table["refused"]) == ("limits", None, None)


MASSLESS = """<robot name="r"><link name="a"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
<link name="c"><inertial><mass value="0"/><inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><box size="2 1 1"/></geometry></collision></link>
<joint name="j" type="continuous"><parent link="a"/><child link="c"/><axis xyz="0 0 1"/></joint></robot>"""


def test_a_urdf_that_mujoco_refuses_but_not_as_mjcf_names_the_command_for_it(tmp_path: Path, run: Run) -> None:
    Path("cup.urdf").write_text(MASSLESS)
    told = run("check", "cup.urdf", "--engine", "mujoco")
    assert told.code == 1 and "refuses cup.urdf: mass and inertia of moving bodies must be larger" in told.out
    command = "meshforge convert cup.urdf cup.xml"
    assert command in told.out
    assert run(*command.split()[1:]).code == 0
    assert run("check", "cup.xml", "--engine", "mujoco").out.startswith(f"{Path('cup.xml').absolute()}: legal (MuJoCo ")


@pytest.mark.parametrize("suffix", ["obj", "stl", "glb"])
def test_a_mesh_file_is_tried_as_it_would_be_converted(suffix: str, run: Run) -> None:
    Path("box.obj").write_text(TETRAHEDRON)
    if suffix != "obj":
        assert run("convert", "box.obj", f"box.{suffix}").code == 0
    told = run("check", f"box.{suffix}", "--engine", "mujoco")
    assert told.code == 0
    assert f"MuJoCo {mujoco.__version__} takes what `meshforge convert` makes of box.{suffix}" in told.out


WITHOUT = """import sys
sys.modules[sys.argv[1]] = None
from pathlib import Path
from meshforge.batch import CheckTask, check_asset
from meshforge.checks import CheckOptions
task = CheckTask(CheckOptions((sys.argv[2],)))
for finding in check_asset(Path("box.urdf"), Path(), None, task).examination.findings:
    print(finding.rule, finding.message, finding.remedy, sep=": ")
"""


@pytest.mark.slow
@pytest.mark.parametrize(("engine", "module"), [("mujoco", "mujoco"), ("bullet", "pybullet")])
def test_an_engine_that_is_not_installed_is_named_with_its_remedy(engine: str, module: str, tmp_path: Path) -> None:
    (tmp_path / "box.urdf").write_text(
        '<robot name="r"><link name="a"><collision><geometry><box size="1 1 1"/></geometry></collision></link></robot>'
    )
    command = [sys.executable, "-c", WITHOUT, module, engine]
    path = os.pathsep.join(str(Path(p).absolute()) for p in sys.path if p)
    done = subprocess.run(command, cwd=tmp_path, env=os.environ | {"PYTHONPATH": path}, capture_output=True, text=True)
    title = {"mujoco": "MuJoCo", "bullet": "Bullet"}[engine]
    said = f"not tried in {title}: {module} is not installed: Install it: pip install {module}"
    assert done.stdout == f"{engine}-untried: {said}\n"


def test_bullet_is_asked_about_what_it_reads_and_only_its_limits_are_known_of_other_files(run: Run) -> None:
    pytest.importorskip("pybullet")
    Path("box.obj").write_text(TETRAHEDRON)
    assert run("convert", "box.obj", "box.glb").code == 0
    Path("cup.urdf").write_text(
        '<robot name="r"><link name="a"><visual><geometry><mesh filename="gone.dae"/></geometry></visual>'
        '<collision><geometry><mesh filename="box.obj"/></geometry></collision></link></robot>'
    )
    told = run("check", "cup.urdf", "box.obj", "box.glb", "--engine", "bullet")
    assert told.code == 1 and "refuses cup.urdf" in told.out and "cannot find 'gone.dae'" in told.out
    assert "box.obj: legal (PyBullet " in told.out
    assert "engine: by the limits of Bullet, which was not asked itself" in told.out


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["xml", "urdf"])
def test_no_file_that_mujoco_refuses_is_legal(suffix: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)  # where MuJoCo writes its log
    paths = sorted(ROOT.glob(f"{'mjcf' if suffix == 'xml' else suffix}/*.{suffix}"))
    assert len(paths) > 50
    outcomes = [check_asset(path, ROOT, None, CheckTask(CheckOptions(("mujoco",)))) for path in paths]
    read = [outcome for outcome in outcomes if outcome.error is None]
    refused = [outcome for outcome in read if refusal(outcome.path)]
    assert refused and all(outcome.has_failed for outcome in refused)
