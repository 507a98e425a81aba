"""Second opinions: simcheck and SimReady are run as they are installed."""

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest
from pxr import Usd, UsdGeom, UsdPhysics

from meshforge.batch import CheckOutcome, CheckTask, check_asset, validators
from meshforge.checks import CheckOptions
from meshforge.formats import load, save
from meshforge.samples import family_of, write_family
from tests.loop.command import meshforge_here
from tests.usd_stages import written

NEEDS_PROFILES = pytest.mark.skipif(sys.version_info >= (3, 13), reason="the profiles of SimReady need Python 3.12")
LABELS = ("FET_011_STANDARD", "FET_011_RTX", "FET_046_STANDARD")
OTHERS = {"NP.005", "SR.002", "SR.004", "VM.MAT.001", "VG.027"}
INERTIA = '<inertial><mass value="{}"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
BLOCK = '<collision><geometry><box size="{}"/></geometry></collision>'
CABINET = f"""<robot name="r"><link name="carcass">{INERTIA.format(20)}{BLOCK.format("0.5 0.5 0.5")}</link>
<link name="drawer">{INERTIA.format(5)}{BLOCK.format("0.4 0.4 0.2")}</link>
<joint name="slide" type="prismatic"><parent link="carcass"/><child link="drawer"/><axis xyz="1 0 0"/>
<limit lower="0" upper="0.3" effort="50" velocity="1"/></joint></robot>"""


def ask(name: str, path: Path) -> CheckOutcome:
    return check_asset(path, path.parent, None, CheckTask(CheckOptions.of([name])))


@pytest.mark.slow
def test_a_drawer_in_a_solid_carcass_is_an_error_of_simcheck_in_its_own_words(tmp_path: Path) -> None:
    path = written(tmp_path, CABINET, "cabinet.urdf")
    said = meshforge_here("check", path, "--second-opinion", "simcheck", cwd=tmp_path, code=1).out
    assert "error MF231: simcheck " in said and "engine.rest_contacts (mujoco): " in said
    assert "overlap" in said and "simcheck explain engine.rest_contacts" in said
    assert "simcheck: " in said and " FAIL, " in said and str(tmp_path) not in said.split("cabinet.urdf:", 1)[1]


@pytest.mark.slow
def test_a_format_that_simcheck_lacks_is_tried_as_mjcf(tmp_path: Path) -> None:
    write_family(family_of("chairs"), tmp_path)
    found = ask("simcheck", tmp_path / "kitchen_chair.glb").examination
    assert found and not found.has_failed and "of what `meshforge convert` makes of it: PASS" in str(found)


@NEEDS_PROFILES
@pytest.mark.slow
@pytest.mark.parametrize(
    ("asset", "others"), [("cups/mug/model.urdf", set()), ("bottles/shampoo.obj", {"RB.001"})], ids=["shown", "drawn"]
)
def test_labels_and_purposes_of_a_sample_as_usd_pass_simready(tmp_path: Path, asset: str, others: set[str]) -> None:
    write_family(family_of(asset.partition("/")[0]), tmp_path / asset.partition("/")[0])
    mesh = load(tmp_path / asset)
    out = save(mesh, tmp_path / "out.usda").path
    found = ask("simready", out).examination
    assert found
    features = found.to_json()["simready"]["features_summary"]
    assert all(features[name]["passed"] for name in LABELS)
    cited = {finding.message.partition("com.nvidia.")[2].partition(" of ")[0] for finding in found.findings}
    assert {one.partition(".")[2] for one in cited} == OTHERS | others  # what docs/checks.md lists
    # which looks at purposes of invisible prims only
    stage = Usd.Stage.Open(str(out))
    gprims = [prim for prim in stage.Traverse() if prim.IsA(UsdGeom.Gprim)]
    purposes = {prim.HasAPI(UsdPhysics.CollisionAPI): UsdGeom.Imageable(prim).ComputePurpose() for prim in gprims}
    assert purposes == ({True: "default"} if others else {True: "guide", False: "default"})


@pytest.mark.parametrize("name", ["simcheck", "simready"])
def test_without_the_validator_a_warning_names_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.setattr(validators, "find_version", lambda _: "")
    (finding,) = ask(name, written(tmp_path, CABINET, "cabinet.urdf")).findings
    assert (finding.code, finding.severity, finding.check) == ("MF233", "warning", name)
    assert finding.message == f"not tried in {name}: it is not installed"
    assert "pip install 'meshforge[referees]'" in finding.remedy


def test_a_validator_that_fails_or_never_ends_is_no_pass(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = written(tmp_path, CABINET, "cabinet.urdf")

    def run(command: Sequence[str], **_: object) -> subprocess.CompletedProcess[str]:
        if "simcheck" in command:
            return subprocess.CompletedProcess(command, 2, "", "first\nno such check\n")
        raise subprocess.TimeoutExpired(command, 1.0)

    monkeypatch.setattr(subprocess, "run", run)
    (finding,) = ask("simcheck", path).findings
    assert finding.message == "not tried in simcheck: it gave no report: no such check"
    (finding,) = ask("simready", path).findings
    assert finding.message == "not tried in simready: it reads USD only"
    (finding,) = ask("simready", save(load(path), tmp_path / "cabinet.usda").path).findings
    assert finding.message == "not tried in simready: it took longer than 120 s"
