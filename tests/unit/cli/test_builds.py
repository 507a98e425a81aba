"""Where builds are: SARIF, JUnit and a baseline, the GitHub Action and the pre-commit hooks."""

import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
import yaml

from meshforge.engines import CODES
from meshforge.geometry import convex_hull
from meshforge.project import Project
from tests.cup_project import cup_urdf
from tests.cups import WHOLE
from tests.loop.readme import commands, read_blocks
from tests.unit.batch.families import obj, table_boxes, write_table, write_urdf_table
from tests.unit.cli.in_process import Run
from tests.unit.project.tables import learned

ROOT = Path(__file__).resolve().parents[3]
GRIP = "graspable(Is(top), width = 150 mm)"
BROKEN = "assets/table2/model.obj"


def break_table(path: str = BROKEN) -> None:
    """A top that is too thick for the gripper, and a disc of more vertices than Unity takes."""
    boxes = {**table_boxes(1.2), "top": ((0, 0, 1.2), (2, 1, 1.5))}
    turns = np.linspace(0, 2 * np.pi, 130, endpoint=False)
    disc = convex_hull(np.array([(5 + np.cos(t) / 20, np.sin(t) / 20, z) for t in turns for z in (3, 3.1)]))
    corners = "".join("v {:.9f} {:.9f} {:.9f}\n".format(*point) for point in disc.vertices)
    faces = "".join("f {} {} {}\n".format(*face) for face in disc.faces + 8 * len(boxes) + 1)
    Path(path).write_text(f"{obj(boxes)}o disc\n{corners}{faces}")


def correct_table() -> None:
    write_table(Path(BROKEN), 1.2)


@pytest.fixture
def project(run: Run, tmp_path: Path) -> Project:
    made = learned(tmp_path)
    correct_table()
    made.set_goal("grip", GRIP)
    return made


def read_sarif(path: str | Path) -> list[dict[str, Any]]:
    """The results of a file, which has what SARIF 2.1.0 and GitHub's code scanning ask for."""
    log = json.loads(Path(path).read_text("utf-8"))
    assert log["version"] == "2.1.0" and log["$schema"].endswith("/sarif-2.1.0.json")
    (made,) = log["runs"]
    driver = made["tool"]["driver"]
    assert driver["name"] == "MeshForge" and made["automationDetails"]["id"].endswith("/")
    ids = [rule["id"] for rule in driver["rules"] if rule["shortDescription"]["text"] and rule["help"]["text"]]
    assert ids == list(CODES)
    for result in made["results"]:
        assert ids[result["ruleIndex"]] == result["ruleId"] and result["level"] in ("error", "warning", "note")
        assert result["message"]["text"]
        (location,) = result["locations"]
        place = location["physicalLocation"]
        assert place["artifactLocation"]["uriBaseId"] == "%SRCROOT%" and place["region"] == {"startLine": 1}
        assert not re.match(r"/|\w+:|\.\.", place["artifactLocation"]["uri"])
        assert re.fullmatch(r"[0-9a-f]{32}:1", result["partialFingerprints"]["primaryLocationLineHash"])
    return list(made["results"])


def read_junit(path: str | Path) -> dict[tuple[str, str], str]:
    """What became of each test case, by asset and check; the counts are those of the cases."""
    (suite,) = ElementTree.parse(path).getroot()
    found = {}
    for case in suite:
        kinds = {child.tag for child in case}
        state = "failure" if "failure" in kinds else "skipped" if "skipped" in kinds else "passed"
        found[case.attrib["classname"], case.attrib["name"]] = state
        assert Path(case.attrib["file"]).exists() or "\\x" in case.attrib["file"]
    states = list(found.values())
    counts = (len(suite), states.count("failure"), states.count("skipped"))
    assert (
        len(found) == len(suite)
        and tuple(int(suite.attrib[name]) for name in ("tests", "failures", "skipped")) == counts
    )
    return found


def test_check_writes_findings_with_codes_places_and_hulls(run: Run, project: Project) -> None:
    break_table()
    Path("assets/odd & <\x01\ufffe>.obj").write_text("v 1 2\n")
    words = ("check", "assets", "--engine", "unity", "--fit", "--sarif", "out/s.sarif", "--junit", "out/j.xml")
    done = run(*words)
    assert done.code == 1 and "error MF201: disc (260): more than 255 vertices" in done.out
    (round_one,) = (one for one in read_sarif("out/s.sarif") if one["ruleId"] == "MF201")
    assert round_one["level"] == "error" and round_one["properties"] == {"rule": "unity-vertices", "check": "unity"}
    assert round_one["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == BROKEN
    assert [one["name"] for one in round_one["locations"][0]["logicalLocations"]] == ["disc"]
    states = read_junit("out/j.xml")
    assert states["table2/model.obj", "unity"] == "failure" and states["table2/model.obj", "legality"] == "passed"
    assert states["table0/model.obj", "unity"] == "passed"
    assert states["table0/model.obj", "fit"] == "skipped"  # an OBJ shows nothing, so nothing was measured
    assert states[r"odd & <\x01\ufffe>.obj", "read"] == "failure"
    first = Path("out/s.sarif").read_bytes(), Path("out/j.xml").read_bytes()
    run(*words)
    assert first == (Path("out/s.sarif").read_bytes(), Path("out/j.xml").read_bytes())
    assert str(Path.cwd()) not in first[0].decode() + first[1].decode()  # the same on every machine
    rows = run("check", BROKEN, "--engine", "unity", "--json").json["findings"]
    (row,) = (one for one in rows if one["severity"] == "error")
    assert (row["code"], row["rule"], row["check"], row["known"]) == ("MF201", "unity-vertices", "unity", False)


def test_goals_and_outliers_are_cases_too(run: Run, project: Project) -> None:
    words = ("--sarif", "s.sarif", "--junit", "j.xml")
    project.set_goal("swing", "swings(Is(top))")
    assert run("goal", "tables", *words).code == 1  # one goal was tried on none
    assert set(read_junit("j.xml").values()) == {"passed", "skipped"}
    assert {(one["ruleId"], one["level"]) for one in read_sarif("s.sarif")} == {("MF503", "note")}
    project.set_goal("swing", None)
    break_table()
    assert run("apply", "tables", *words).code == 1
    states = read_junit("j.xml")
    assert states["table2/model.obj", "goal grip"] == "failure" and states["table0/model.obj", "goal grip"] == "passed"
    (failed,) = (one for one in read_sarif("s.sarif") if one["level"] == "error")
    assert failed["ruleId"] == "MF501" and failed["message"]["text"].startswith(f"{project.read_goals()['grip']}: ")
    Path("block.mf").write_text("All => Merge\n")
    Path("assets/table1/model.obj").write_text("v 1 2\n")
    assert run("apply", "block.mf", "assets", "--out", "blocks", *words).code == 1
    kinds = {(one["ruleId"], one["level"]) for one in read_sarif("s.sarif")}
    assert kinds == {("MF511", "warning"), ("MF601", "error")}


def test_a_baseline_passes_over_what_is_unchanged_and_fails_on_what_is_new(run: Run, project: Project) -> None:
    words = ("check", "assets", "--engine", "unity", "--baseline", "known.json")
    assert run(*words).err.startswith("error: known.json: there is no such baseline\n")
    break_table()
    first = run(*words, "--update-baseline")  # what is new fails, also where it becomes known by that
    assert first.code == 1 and "3 assets, 1 with new errors, 0 findings known, 0 not checked again" in first.out
    before = Path("known.json").read_bytes()
    again = run(*words, "--sarif", "s.sarif", "--junit", "j.xml")
    assert again.code == 0 and "known error MF201" in again.out
    assert re.search(r"\n3 assets, 0 with new errors, \d findings? known, 3 not checked again\n$", again.out)
    assert "unchanged since the baseline, not checked again" in again.out
    assert {one.get("baselineState") for one in read_sarif("s.sarif")} == {"unchanged"}
    assert set(read_junit("j.xml").values()) == {"skipped"}
    asked = run(*words, "--physics").out  # another question: all are checked
    assert asked.endswith(" known, 0 not checked again\n")
    write_table(Path("assets/table1/model.obj"), 1.3)
    break_table()
    Path(BROKEN).write_text(Path(BROKEN).read_text() + "# the same hulls\n")
    changed = run(*words)
    assert changed.code == 0 and changed.out.endswith(" known, 1 not checked again\n")
    break_table("assets/table0/model.obj")
    assert run(*words).code == 1  # the same rule, on another asset
    assert Path("known.json").read_bytes() == before  # read, not written
    correct_table()
    write_table(Path("assets/table0/model.obj"))
    fine = run(*words, "--update-baseline")
    assert fine.code == 0 and "known error" not in fine.out and "unity-vertices" not in Path("known.json").read_text()
    Path("known.json").write_text('{"assets": 3}')
    refused = run(*words)
    assert refused.code == 2 and "it is no baseline of `meshforge check`" in refused.err


def test_a_baseline_holds_on_another_machine_until_any_file_of_an_asset_changes(run: Run) -> None:
    write_urdf_table(Path("here/assets"))
    Path("here/assets/odd.urdf").write_text("<robot")
    assert run("check", "here/assets", "--baseline", "here/known.json", "--update-baseline").code == 1
    Path("here").rename("there")
    words = ("check", "there/assets", "--baseline", "there/known.json")
    done = run(*words)
    assert done.code == 0 and "odd.urdf:\n  known error MF601: " in done.out
    assert "table.urdf:\n  unchanged since the baseline, not checked again; nothing was found then\n" in done.out
    assert done.out.endswith("2 assets, 0 with new errors, 1 finding known, 1 not checked again\n")
    mesh = Path("there/assets/meshes/crumb.obj")
    mesh.write_text(mesh.read_text() + "# changed\n")
    assert run(*words, "--junit", "j.xml").out.endswith("0 not checked again\n")
    assert '<skipped message="known: there/assets/odd.urdf' in Path("j.xml").read_text()


ENVIRONMENT = {
    "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}",
    "PYTHONPATH": os.pathsep.join([str(ROOT / "src"), os.environ.get("PYTHONPATH", "")]),
    "GIT_CONFIG_GLOBAL": os.devnull,
}


def call(*words: str, env: dict[str, str] | None = None) -> subprocess.CompletedProcess[str]:
    return subprocess.run(words, env=os.environ | ENVIRONMENT | (env or {}), capture_output=True, text=True)


@pytest.fixture
def repository(project: Project) -> Project:
    who = ("-c", "user.name=a", "-c", "user.email=a@b.c")
    for words in (("init", "-q"), ("add", "-A"), (*who, "commit", "-q", "-m", "assets")):
        assert call("git", *words).returncode == 0
    return project


def run_hook(name: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    """A hook as pre-commit runs it: its entry, its arguments, and the files of the change that it asks for."""
    hooks = {one["id"]: one for one in yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text("utf-8"))}
    hook = hooks[name]
    assert hook["language"] == "python" and hook["require_serial"]
    call("git", "add", "-A")
    staged = call("git", "diff", "--cached", "--name-only", "--diff-filter=ACMRTUXB").stdout.split()
    files = [path for path in staged if re.search(hook["files"], path)] if hook.get("pass_filenames", True) else []
    return call(*shlex.split(hook["entry"]), *arguments, *files)


def test_the_hooks_fail_until_the_family_is_corrected(repository: Project) -> None:
    break_table()
    Path("assets/notes.xml").write_text("<package/>")  # none of ours
    found = run_hook("meshforge-check", "--engine", "unity")
    assert found.returncode == 1 and "error MF201" in found.stdout and "table0" not in found.stdout, found.stderr
    assert run_hook("meshforge-goal", "tables").returncode == 1
    write_table(Path(BROKEN), 1.25)
    fine = run_hook("meshforge-check", "--engine", "unity")
    assert fine.returncode == 0 and "table2/model.obj" in fine.stdout, fine.stderr
    goal = run_hook("meshforge-goal", "tables")
    assert goal.returncode == 0 and "3 of 3 assets" in goal.stdout, goal.stderr


def run_action(results: Path, **inputs: str) -> dict[str, int]:
    """The exit codes of the steps of the Action that run our commands, each by bash as GitHub does; what is installed
    is here already."""
    action = yaml.safe_load((ROOT / "action.yml").read_text("utf-8"))
    values = {name: own["default"] for name, own in action["inputs"].items()}
    assert inputs.keys() <= values.keys()
    known = {f"inputs.{name}": value for name, value in (values | inputs).items()} | {"runner.temp": str(results)}
    codes = {}
    for step in action["runs"]["steps"]:
        if "uses" in step:
            assert re.fullmatch(r"(actions/[\w-]+|github/codeql-action/upload-sarif)@v\d+", step["uses"])
            continue
        asked = re.findall(r"(inputs\.[\w-]+) != ''", step.get("if", ""))
        if step["id"] == "install" or not all(known[name] for name in asked):
            continue
        env = {name: re.sub(r"\$\{\{ (.*?) \}\}", lambda m: known[m[1]], text) for name, text in step["env"].items()}
        done = call("bash", "--noprofile", "--norc", "-e", "-o", "pipefail", "-c", step["run"], env=env)
        assert done.returncode in (0, 1), done.stderr
        codes[step["id"]] = done.returncode
    return codes


@pytest.mark.slow
def test_the_page_of_builds_holds(run: Run) -> None:
    page = ROOT / "docs/builds.md"
    done = [run(*words) for words in commands("", page)]
    assert [one.code for one in done] == [0] * len(done), done[-1].err
    assert "12 assets, 0 with new errors, " in done[3].out and done[3].out.endswith("12 not checked again\n")
    workflow, hooks = map(yaml.safe_load, read_blocks("yaml", page))
    inputs = yaml.safe_load((ROOT / "action.yml").read_text("utf-8"))["inputs"]
    assert workflow["jobs"]["check"]["steps"][1]["with"].keys() <= inputs.keys()
    assert all(f"`{name}`" in page.read_text("utf-8") for name in inputs)
    known = {one["id"] for one in yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text("utf-8"))}
    assert {one["id"] for one in hooks["repos"][0]["hooks"]} == known


@pytest.mark.slow
def test_the_action_fails_until_the_family_is_corrected(repository: Project, tmp_path: Path) -> None:
    inputs = {"paths": "assets/table0\nassets/table2\n", "engine": "unity", "options": "--timeout 60\n--workers 1"}
    assert run_action(tmp_path / "first", project="tables", **inputs) == {"check": 0, "project": 0}
    break_table()
    assert run_action(tmp_path / "second", project="tables", **inputs) == {"check": 1, "project": 1}
    made = {path.name: path for path in (tmp_path / "second/meshforge").iterdir()}
    files = {f"{step}.{kind}" for step in ("check", "project") for kind in ("sarif", "xml")}
    assert made.keys() == {*files, "project.html"}
    assert "MF201" in {one["ruleId"] for one in read_sarif(made["check.sarif"])}
    assert {one["ruleId"] for one in read_sarif(made["project.sarif"])} == {"MF501"}
    assert "<img" in made["project.html"].read_text("utf-8")
    words = ("check", "assets", "--engine", "unity", "--baseline", "known.json", "--update-baseline")
    assert call("meshforge", *words).returncode == 1
    assert run_action(tmp_path / "third", baseline="known.json", **inputs) == {"check": 0}
    correct_table()
    assert run_action(tmp_path / "fourth", project="tables", **inputs) == {"check": 0, "project": 0}
    assert call("git", "status", "--porcelain", "--", "assets").stdout == ""
    Path("cup.urdf").write_text(cup_urdf(True, [WHOLE]))
    run_action(tmp_path / "fifth", paths="cup.urdf", options="--workers 1 --fit")
    assert list((tmp_path / "fifth/meshforge/pictures").rglob("*.png"))
