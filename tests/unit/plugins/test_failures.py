"""What plug-ins do wrong: one clear message that names the package, the asset fails by name, the rest goes on."""

import json
import pickle
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path

import pytest

from meshforge.batch import IN_PROCESS, Failed, apply, expand, make_jobs, read_stamp
from meshforge.checks import CheckOptions, check, examine_mesh
from meshforge.checks.goals.base import GoalSubject, try_goal
from meshforge.checks.goals.registry import parse_goal
from meshforge.common import PluginError, plugins
from meshforge.formats import load, read
from meshforge.language import All, Each, Program, Rule
from meshforge.project import Project
from tests.plugin_packages import build_wheel, unpack
from tests.program_parts import parse_action
from tests.unit.batch.families import write_table
from tests.unit.cli.in_process import Run, runner
from tests.unit.plugins import broken

Install = Callable[..., str]
_numbers = count()
_TARGETS = {"formats": "Cubes", "labelers": "Namer", "checks": "Look", "goals": "Odd"}
FAULTS = {
    "convex": "is not convex",
    "closed": "is not closed",
    "finite": "has coordinates that are not finite numbers",
    "volume": "has no positive volume",
}


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Run:
    """Runs the command line in a folder with a table and its labels."""
    work = tmp_path / "work"
    write_table(work / "table.obj")
    monkeypatch.chdir(work)
    return runner(monkeypatch, capsys)


@pytest.fixture
def install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Install]:
    """Installs a package of one module with one plug-in."""

    def put(kind: str, name: str, code: str, package: str = "mf-broken", target: str = "") -> str:
        number = next(_numbers)  # a module of one name is imported once in a process
        module = f"mf_plug_{number}"
        points = {f"meshforge.{kind}": {name: f"{module}:{target or _TARGETS.get(kind, name)}"}}
        wheel = build_wheel(tmp_path / "wheels", package, f"1.{number}", {f"{module}.py": code}, points)
        monkeypatch.syspath_prepend(unpack(wheel, tmp_path / f"site{number}"))
        forget_plugins()
        return f"{package} 1.{number}"

    yield put
    monkeypatch.undo()
    forget_plugins()


def forget_plugins() -> None:
    """Look for plug-ins anew, as after a package was installed."""
    plugins._adopted.clear()
    plugins._find.cache_clear()


def format_code(body: str) -> str:
    return broken.HEAD + broken.FORMAT.format(body=body)


def action_code(body: str, name: str = "Spoil") -> str:
    return broken.HEAD + broken.ACTION.format(name=name, body=body)


def asset_code(shape: str) -> str:
    return f"return {broken.CUBE_ASSET.format(shape=shape)}"


MADE = "return GroupEdit((NewShape(cube_of({fault!r}), group.hulls[0], group.hulls),))"


# A plug-in that cannot be imported


def test_a_program_with_an_action_that_cannot_be_imported_says_so_at_its_place(run: Run, install: Install) -> None:
    package = install("actions", "Spoil", "import mf_library_that_is_not_there")
    Path("p.mf").write_text("All => Spoil\n")
    done = run("apply", "p.mf", "table.obj", "--out", "out")
    assert done.code == 2
    assert f"p.mf:1:8: the action Spoil of the package {package} cannot be loaded: No module named" in done.err
    assert not Path("out").exists()
    assert run("fmt", "p.mf").code == 2


@pytest.mark.parametrize("kind", ["labelers", "checks"])
def test_a_name_that_cannot_be_imported_is_said_before_the_work(run: Run, install: Install, kind: str) -> None:
    package = install(kind, "odd", "1 / 0")
    assert run("new", "home", "table.obj").code == 0
    words = ("check", "table.obj", "--check", "odd") if kind == "checks" else ("label", "home", "--with", "odd")
    done = run(*words)
    assert done.code == 2
    assert f"odd of the package {package} cannot be loaded: ZeroDivisionError: division by zero" in done.err


@pytest.mark.parametrize(
    ("kind", "code", "why"),
    [
        ("formats", "class Cubes: pass", "it is no subclass of meshforge.formats.Format"),
        (
            "formats",
            format_code("pass").replace("(.cube", "(.box").replace('".cube"', '".box"'),
            "none of its suffixes",
        ),
        ("formats", format_code("pass").replace('"cubes"', '"obj"'), "MeshForge has a format named 'obj'"),
        ("actions", "class Spoil: pass", "it is no subclass of meshforge.language.Action"),
        ("actions", action_code("pass").replace("frozen=True, ", ""), "it is no frozen dataclass"),
        (
            "actions",
            action_code("pass").replace("def edit", "x: float = 1.0\n    def edit"),
            "its field x lacks metadata",
        ),
        ("labelers", broken.HEAD + "class Namer(AssetLabeler): pass", "it has no method label"),
        ("checks", broken.HEAD + "class Look(Check): pass", "it has no method examine"),
        ("checks", "", "cannot be loaded: AttributeError"),
        ("goals", broken.HEAD + "class Odd(Goal): pass", "it has no method find_failure"),
    ],
)
def test_the_list_says_why_a_plug_in_does_not_fit(run: Run, install: Install, kind: str, code: str, why: str) -> None:
    package = install(kind, {"formats": "cube", "actions": "Spoil"}.get(kind, "odd"), code)
    done = run("plugins", "--json")
    (row,) = done.json
    assert done.code == 1
    assert (row["kind"], f"{row['package']} {row['version']}", row["loads"]) == (kind, package, False)
    assert why in row["reason"]
    assert why.split(" ")[0] in run("plugins").out


# Missing in a worker


@pytest.mark.slow
def test_assets_whose_action_is_missing_in_a_worker_fail_by_name(run: Run, install: Install) -> None:
    package = install("actions", "Spoil", broken.IN_WORKER + action_code("return GroupEdit()"))
    write_table(Path("b.obj"))
    Path("b.labels.json").write_text(json.dumps({"hulls": {"top": "top"}}))
    Path("p.mf").write_text("Is(leg) => Each(Spoil)\n")
    done = run("apply", "p.mf", "table.obj", "b.obj", "--out", "out", "--workers", "1", "--json")
    b, table = done.lines
    assert (done.code, b["status"], table["status"]) == (1, "unchanged", "failed")
    assert f"table.obj: the action Spoil of the package {package} is not installed here" in table["error"]
    assert not Path("out/table.obj").exists()


def test_an_action_keeps_its_text_if_its_package_is_missing(install: Install, monkeypatch: pytest.MonkeyPatch) -> None:
    install("actions", "Spoil", action_code("return GroupEdit()").replace("slots=True)", "slots=True)"))
    kept = pickle.dumps(Each(parse_action("Spoil")))
    assert pickle.loads(kept) == Each(parse_action("Spoil"))
    monkeypatch.setattr("meshforge.common.plugins.import_module", _no_module)
    monkeypatch.setattr("meshforge.language.registry.ACTIONS._loaded", {})
    found = pickle.loads(kept)
    assert str(Rule(All(), found)) == "All => Each(Spoil)"
    assert str(pickle.loads(pickle.dumps(found))) == "Each(Spoil)"


def _no_module(name: str) -> None:
    raise ModuleNotFoundError(f"No module named {name!r}", name=name)


# A name that is taken


def test_names_of_meshforge_stay_its_own(run: Run, install: Install) -> None:
    packages = [
        install("formats", "obj", "1 / 0"),
        install("actions", "Merge", "1 / 0"),
        install("labelers", "names", "1 / 0"),
        install("checks", "fit", "1 / 0"),
    ]
    Path("p.mf").write_text("Is(leg) => Merge\n")
    (edited,) = apply(Program.read("p.mf"), make_jobs(expand(["table.obj"])), Path("out"), execution=IN_PROCESS)
    assert not isinstance(edited, Failed)
    assert CheckOptions.of(["fit"]) == CheckOptions(("fit",))
    rows = run("plugins", "--json").json
    assert len(rows) == 1  # one package of this name counts, the last that was installed
    assert packages[-1] in rows[0]["reason"] and "MeshForge itself has this name" in rows[0]["reason"]


@pytest.mark.parametrize("kind", ["formats", "actions", "labelers", "checks"])
def test_a_name_of_two_packages_is_refused_naming_both(run: Run, install: Install, kind: str) -> None:
    name = {"formats": "cube", "actions": "Spoil"}.get(kind, "odd")
    first, second = (install(kind, name, "", package=package) for package in ("mf-first", "mf-second"))
    Path("p.mf").write_text("All => Spoil\n")
    Path("a.cube").write_text("")
    assert run("new", "home", "table.obj").code == 0
    done = run(
        *{
            "formats": ("check", "a.cube"),
            "actions": ("fmt", "p.mf"),
            "labelers": ("label", "home", "--with", name),
            "checks": ("check", "table.obj", "--check", name),
        }[kind]
    )
    assert done.code == (1 if kind == "formats" else 2)
    assert f"is in several packages: {first} and {second}" in done.out + done.err
    assert "Uninstall all but one of them." in done.out + done.err
    assert [row["loads"] for row in run("plugins", "--json").json] == [False, False]


# A hull that is none


@pytest.mark.parametrize("fault", FAULTS)
def test_an_asset_fails_when_an_action_makes_a_hull_that_is_none(run: Run, install: Install, fault: str) -> None:
    package = install("actions", "Spoil", action_code(MADE.format(fault=fault)))
    program = Program.parse("Is(misc) => Spoil\n")
    with pytest.raises(PluginError) as caught:
        program.run(load("table.obj"))
    wanted = f"the action Spoil of the package {package} made a hull of crumb that {FAULTS[fault]}"
    assert caught.value.message.startswith(f"table.obj: {wanted}")


def test_a_hull_that_only_rounding_keeps_from_being_convex_is_made_anew(run: Run, install: Install) -> None:
    install("actions", "Spoil", action_code(MADE.format(fault="rounding")))
    made = Program.parse("Is(misc) => Spoil\n").run(load("table.obj")).mesh
    assert check(made) == ()


@pytest.mark.parametrize("fault", FAULTS)
def test_an_asset_fails_when_a_format_reads_a_hull_that_is_none(run: Run, install: Install, fault: str) -> None:
    package = install("formats", "cube", format_code(asset_code(f"cube_of({fault!r})")))
    Path("a.cube").write_text("")
    wanted = f"a.cube: the format .cube of the package {package} read the hull 'one', which {FAULTS[fault]}"
    with pytest.raises(PluginError) as caught:
        read("a.cube")
    assert caught.value.message.startswith(wanted)


# Anything else


RAISES = ["raise KeyError('x')", "sys.exit(3)", "return None"]


@pytest.mark.parametrize("body", RAISES)
def test_an_asset_fails_when_an_action_raises(run: Run, install: Install, body: str) -> None:
    package = install("actions", "Spoil", action_code(body))
    jobs, program = make_jobs(expand(["table.obj"])), Program.parse("All => Spoil\n")
    (failed,) = apply(program, jobs, Path("out"), execution=IN_PROCESS)
    assert isinstance(failed, Failed)
    assert f"table.obj: the action Spoil of the package {package} failed: " in failed.error
    assert "fault of MeshForge" not in failed.error
    assert not Path("out/table.obj").exists()


@pytest.mark.parametrize(
    ("body", "why"),
    [
        ("raise KeyError('x')", "failed: KeyError: 'x'"),
        ("return {'top': 'top'}", "gave the hull 'top' a str, not a Label"),
        ("return {'top': Label('top', 2.0)}", "gave the hull 'top' the label 'top' with the confidence 2.0"),
        ("return {'topp': Label('top')}", "there is no hull 'topp'; did you mean 'top'?"),
        ("return {'top': Label('roof')}", "top: the label 'roof' is not in the vocabulary"),
    ],
)
def test_an_asset_gets_no_label_of_a_labeller_that_fails(run: Run, install: Install, body: str, why: str) -> None:
    install("labelers", "odd", broken.HEAD + broken.LABELER.format(body=body))
    project = Project.create("home", ["table.obj"], vocabulary=["top", "leg"])
    (outcome,) = project.label("odd").outcomes
    assert why in outcome.problems[0]
    assert why in project.label("odd", dry_run=True).proposals.problems[0]
    assert not Path("home/labels/table.obj.json").exists()


def test_a_labeller_that_sees_the_family_takes_the_road_of_those_built_in(run: Run, install: Install) -> None:
    install("labelers", "tops", "from meshforge.symbolic import Label\n" + broken.FAMILY_LABELER)
    project = Project.create("home", ["table.obj"], vocabulary=["top", "leg"])
    (row,) = project.label("tops", dry_run=True).proposals.rows
    assert (row.label, row.hulls) == ("top", 6) and not project.labels("table.obj").labels
    (outcome,) = project.label("tops").outcomes
    assert (outcome.taken, project.mesh("table.obj").hull_of("top").source) == (6, "plugin")


@pytest.mark.parametrize("body", [*RAISES, "return ['odd']", "return [Finding('flat', 'error', (), 'odd', '')]"])
def test_a_check_that_fails_is_an_error_among_the_findings(run: Run, install: Install, body: str) -> None:
    package = install("checks", "odd", broken.HEAD + broken.CHECK.format(body=body))
    (finding,) = examine_mesh(load("table.obj"), CheckOptions.of(["odd"])).findings
    assert (finding.rule, finding.severity, finding.code) == ("odd", "error", None)
    assert run("check", "table.obj", "--check", "odd", "--sarif", "s.sarif").code == 1
    assert json.loads(Path("s.sarif").read_text())["runs"][0]["results"][0]["ruleId"] == "odd"
    assert finding.message.startswith(f"the check odd of the package {package} ")


@pytest.mark.parametrize("body", [*RAISES[:2], "return 'odd'"])
def test_a_goal_that_fails_is_broken_and_blamed(run: Run, install: Install, body: str) -> None:
    package = install("goals", "odd", broken.HEAD + broken.GOAL.format(body=body))
    mesh = load("table.obj")
    found = try_goal(parse_goal("odd"), GoalSubject.of(mesh, mesh, Program()))
    assert found.outcome == "broken" and found.why.startswith(f"the goal odd of the package {package} ")


# Besides


def test_outputs_are_made_again_after_an_update_of_the_plug_in(run: Run, install: Install) -> None:
    def edit() -> str:
        jobs, program = make_jobs(expand(["table.obj"])), Program.parse("Is(misc) => Spoil\n")
        (outcome,) = apply(program, jobs, Path("out"), execution=IN_PROCESS)
        return type(outcome).__name__

    install("actions", "Spoil", action_code("return GroupEdit()"))
    assert [edit(), edit()] == ["Edited", "Skipped"]
    package = install("actions", "Spoil", action_code("return GroupEdit()"))
    assert edit() == "Edited"
    stamp = read_stamp(Path("out"), "table.obj")
    assert stamp and stamp.inputs and package in stamp.inputs.software
