"""The command line: every command, its exit codes, its JSON shapes, and errors without tracebacks."""

import json
import re
import shlex
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest
from PIL import Image

import meshforge
from meshforge.cli.main import COMMANDS, load_command
from meshforge.store import Store
from tests.unit.batch.families import obj, tree, write_table, write_tables
from tests.unit.cli.in_process import Run

ROW = {"left": ((0, 0, 0), (1, 1, 1)), "middle": ((1, 0, 0), (2, 1, 1)), "far": ((4, 0, 0), (5, 1, 1))}
BAR = {"bar": ((0, 0, 0), (3, 1, 1))}


@pytest.fixture
def run(run: Run) -> Run:
    """Runs the command line in a folder that holds `row.obj` with labels: three cubes in a row, the last apart."""
    Path("row.obj").write_text(obj(ROW))
    Path("row.labels.json").write_text('{"hulls": {"left": "leg", "middle": "panel", "far": "leg"}}')
    return run


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_explains_itself(run: Run, command: str) -> None:
    told = run(command, "--help")
    assert told.code == 0
    assert f"Usage: meshforge {command}" in told.out


@pytest.mark.parametrize("command", COMMANDS)
def test_the_list_of_commands_shows_the_first_clause_of_each_ones_help(command: str) -> None:
    first = re.split(r"[;:.]", (load_command(command).help or "").strip(), maxsplit=1)[0]
    assert " ".join(first.split()) == COMMANDS[command]


def test_the_version_is_that_of_the_installed_package(run: Run) -> None:
    assert run("--version").out == f"meshforge {meshforge.__version__}\n" == f"meshforge {version('meshforge')}\n"


def test_an_unknown_command_names_the_nearest(run: Run) -> None:
    told = run("appl")
    assert told.code == 2 and "Did you mean 'apply'?" in told.err
    assert all(command in run().out + run("--help").out for command in COMMANDS)


def test_help_loads_no_command_and_nothing_heavy() -> None:
    code = """
import sys
sys.argv = ["meshforge", "--help"]
from meshforge.cli import main
try:
    main()
except SystemExit:
    pass
heavy = {"numpy", "scipy", "coal", "trimesh", "lxml", "jinja2", "lark", "pydantic", "rich.table", "PIL", "manifold3d"}
print(*(name for name in sys.modules if name.startswith("meshforge.") or name in heavy))
"""
    shown = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    assert set(shown.splitlines()[-1].split()) == {
        *("meshforge.common", "meshforge.common.exports"),
        *("meshforge.cli", "meshforge.cli.main", "meshforge.cli.main", "meshforge.cli.terminal"),
    }


def test_a_command_that_is_interrupted_says_so(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def press_control_c(folder: Path) -> Store:
        raise KeyboardInterrupt

    monkeypatch.setattr(Store, "open", press_control_c)
    left = run("status", "p")
    assert (left.code, left.out, left.err) == (130, "", "stopped\n")


def test_info_as_json_has_the_documented_shape(run: Run) -> None:
    told = run("info", "row.obj", "--json", "--geometry").json
    assert list(told) == ["asset", "format", "diagonal", "notes", "hulls", "non_convex", "contacts", "near_misses"]
    hull = told["hulls"][0]
    assert list(hull) == [
        *("name", "body", "label", "confidence", "source", "aabb", "volume", "vertices", "faces", "primitive", "points")
    ]
    assert (hull["name"], hull["label"], hull["source"]) == ("left", "leg", "file")
    assert hull["aabb"] == {"min": [0, 0, 0], "max": [1, 1, 1]}
    assert sorted(hull["points"]) == sorted(
        [float(x), float(y), float(z)] for x in (0, 1) for y in (0, 1) for z in (0, 1)
    )
    assert told["contacts"] == [["left", "middle"]]


def test_info_for_people_names_hulls_and_counts(run: Run) -> None:
    told = run("info", "row.obj").out
    assert "3 hulls, 1 body, 1 contact" in told
    assert all(name in told for name in ("left", "middle", "far", "leg", "panel"))


def test_select_lists_names_and_as_json(run: Run) -> None:
    assert run("select", "Attach(Is(leg), Is(panel))", "row.obj").out == "left\n"
    assert run("select", "Geo(All, +X)", "row.obj", "--json").json == {"hulls": ["far"]}


def test_select_of_a_label_that_no_hull_has_names_the_nearest(run: Run) -> None:
    told = run("select", "Is(pannel)", "row.obj")
    assert (told.code, told.out) == (2, "")
    assert told.err == "error: row.obj: no hull is labelled 'pannel'\n  Did you mean 'panel'? Labels are leg, panel.\n"
    Path("row.labels.json").unlink()
    said = "no hull is labelled 'panel'\n  Give labels: meshforge label, or --labels."
    assert run("select", "Is(panel)", "row.obj").err == f"error: row.obj: {said}\n"


def test_render_writes_a_picture_of_the_size_asked_for(run: Run) -> None:
    assert run("render", "row.obj", "-o", "row.png", "--size", "300x200", "--views", "iso,top").code == 0
    with Image.open("row.png") as picture:
        assert picture.size == (300, 200)


@pytest.mark.parametrize(
    "words", [("render", "row.obj", "-o"), ("select", "Is(leg)", "row.obj", "-o"), ("diff", "row.obj", "row.obj", "-o")]
)
def test_a_picture_is_a_jpeg_or_png_as_its_suffix_says(run: Run, words: tuple[str, ...]) -> None:
    assert run(*words, "a.jpg").code == 0
    with Image.open("a.jpg") as picture:
        assert picture.format == "JPEG"
    refused = run(*words, "a.gif")
    said = "a.gif: .gif is no picture that can be written\n  Pictures end in .png, .jpg, .jpeg."
    assert (refused.code, refused.out, refused.err) == (2, "", f"error: {said}\n")


QUICK_VOXELS = ("--no-cache", "--decompose", "vhacd", "--set", "resolution=5000")


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".obj", ".urdf", ".xml", ".sdf", ".usda", ".glb"])
def test_hulls_by_parts_are_called_by_them_in_every_format_with_names(run: Run, suffix: str) -> None:
    Path("mug.obj").write_text(obj({n: ((2 * k, 0, 0), (2 * k + 1, 1, 1)) for k, n in enumerate(PARTS)}))
    assert run("decompose", "mug.obj", "-o", f"hulls{suffix}", "--by", "parts", *QUICK_VOXELS).code == 0
    names = {hull["name"].rpartition("/")[2] for hull in run("info", f"hulls{suffix}", "--json").json["hulls"]}
    assert names == {"wall_0", "handle_left_0", "part_3_0", "handle_left_1"}


PARTS = ("wall", "handle left", "3", "handle.left")


def test_a_mesh_of_several_parts_has_a_note_and_one_without_too_where_they_are_asked_for(run: Run) -> None:
    told = run("decompose", "row.obj", "-o", "hulls.obj", *QUICK_VOXELS)
    assert "--by parts keeps them apart" in told.err
    Path("bar.obj").write_text(obj(BAR))
    first, second = Path("bar.obj").read_text().split("\nf ", 1)
    Path("bar.obj").write_text(f"{first}\nusemtl a\nf {second}".replace("\nf ", "\nusemtl b\nf ", 3))  # are no parts
    assert "no parts are known" in run("decompose", "bar.obj", "-o", "h.obj", "--by", "parts", *QUICK_VOXELS).err


def test_convert_reports_what_is_held_and_lost_as_json(run: Run) -> None:
    Path("t.urdf").write_text(
        '<robot name="t"><link name="a"><collision name="pin"><geometry><sphere radius="1"/></geometry></collision>'
        '</link><link name="b"/>'
        '<joint name="hinge" type="continuous"><parent link="a"/><child link="b"/></joint></robot>'
    )
    told = run("convert", "t.urdf", "t.obj", "--json")
    assert told.code == 0
    assert list(told.json) == ["asset", "out", "hulls", "kept", "lost", "notes"]
    assert told.json["kept"] == [{"what": "hull names", "count": 1, "names": ["a/pin"]}]
    spheres = {"why": "OBJ has no spheres", "instead": "written as triangles"}
    assert told.json["lost"][1] == {"what": "spheres", "count": 1, "names": ["a/pin"], **spheres}
    assert [row["what"] for row in told.json["lost"]] == ["bodies", "spheres", "joints"]
    assert told.json["notes"] == ["coordinates are as they were, z-up: OBJ does not say what is up"]
    assert run("convert", "t.urdf", "t2.obj").err.splitlines()[:2] == [
        "note: coordinates are as they were, z-up: OBJ does not say what is up",
        "note: 2 bodies (a, b) are left out: MeshForge does not convert bodies to OBJ",
    ]


def test_convert_leaves_labels_that_are_there_alone(run: Run) -> None:
    Path("other.labels.json").write_text('{"hulls": {}}')
    assert "left as it is" in run("convert", "row.obj", "other.obj").err
    assert Path("other.labels.json").read_text() == '{"hulls": {}}'


@pytest.mark.slow
def test_convert_of_many_mirrors_their_tree_and_goes_on_where_it_was(run: Run) -> None:
    write_tables(Path("many"), 3)
    Path("many/table1/model.obj").write_text("v 1 2\n")
    told = run("convert", "many", "made", "--to", "usda", "--dry-run")
    assert told.code == 1 and told.out.endswith("2 written, 1 failed; hulls 12 -> 12 (nothing was written)\n")
    assert not Path("made").exists()
    told = run("convert", "many", "made", "--to", "USDA")
    assert told.code == 1
    assert [line.split(":")[0] for line in told.out.splitlines() if line[0] != " "] == [
        f"written    {Path.cwd() / 'made/table0/model.usda'}",
        "failed     table1/model.obj",
        f"written    {Path.cwd() / 'made/table2/model.usda'}",
        "3 assets",
    ]
    assert told.out.splitlines()[-1] == "3 assets: 2 written, 1 failed; hulls 12 -> 12"
    assert {hull["label"] for hull in run("info", "made/table2/model.usda", "--json").json["hulls"]} == {
        "leg",
        "misc",
        "top",
    }
    write_table(Path("many/table1/model.obj"))
    again = run("convert", "many", "made", "--to", "usda", "--json")
    assert [line["status"] for line in again.lines] == ["skipped", "unchanged", "skipped"]
    elsewhere = run("convert", "many", "made", "--to", "urdf", "--json")
    assert [line["status"] for line in elsewhere.lines] == ["unchanged"] * 3


def test_convert_calls_hulls_as_an_engine_knows_them_and_labels_follow(run: Run) -> None:
    assert run("convert", "row.obj", "made/row.glb", "--names", "unreal").code == 0
    hulls = run("info", "made/row.glb", "--json").json["hulls"]
    assert [(hull["name"], hull["label"]) for hull in hulls] == [
        ("UCX_row_00", "leg"),
        ("UCX_row_01", "panel"),
        ("UCX_row_02", "leg"),
    ]


def test_fmt_prints_the_canonical_form_and_checks_it(run: Run) -> None:
    Path("p.mf").write_text("labels leg,panel\nIs( leg )=>Delete # gone\n")
    assert run("fmt", "p.mf").out == "labels leg, panel\n\nIs(leg) => Delete  # gone\n"
    assert run("fmt", "p.mf", "--check").code == 1
    assert run("fmt", "p.mf", "--in-place").code == 0
    assert run("fmt", "p.mf", "--check").code == 0


def test_check_tells_legal_from_illegal(run: Run) -> None:
    assert run("check", "row.obj").code == 0
    Path("row.obj").write_text(obj({**ROW, "again": ROW["far"]}))
    told = run("check", "row.obj", "--json")
    assert {"far", "again"} <= {name for finding in told.json["findings"] for name in finding["hulls"]}


def test_apply_runs_a_program_on_files_and_names_the_one_that_fails(run: Run) -> None:
    Path("p.mf").write_text("labels leg, panel\n\nIs(leg) => Delete\n")
    Path("bad.obj").write_text("v 0 0 nan\n")
    told = run("apply", "p.mf", "row.obj", "bad.obj", "--out", "out", "--workers", "1", "--json")
    lines = {line["asset"]: line for line in map(json.loads, told.out.splitlines())}
    assert told.code == 1
    assert lines["bad.obj"]["status"] == "failed"
    assert lines["bad.obj"]["error"]
    row = lines["row.obj"]
    assert list(row) == ["asset", "status", "out", "error", "rules", "hulls", "seconds", "alarms"]
    assert row["status"] == "edited" and row["alarms"] == []
    assert row["hulls"] == {"before": 3, "after": 1}
    assert row["rules"] == [{"rule": 1, "selected": ["left", "far"], "made": [], "note": None}]
    assert not Path("out/bad.obj").exists()


@pytest.mark.slow
def test_apply_writes_a_report_with_checks_failures_first(run: Run) -> None:
    Path("bad.obj").write_text("v 1 2\n")
    Path("p.mf").write_text("labels leg, panel\n\nIs(leg) => Merge\n")
    told = run("apply", "p.mf", "row.obj", "bad.obj", "--out", "out", "--report", "r.html", "--check", "physics")
    assert told.code == 1
    page = Path("r.html").read_text("utf-8")
    assert page.index('data-name="bad.obj"') < page.index('data-name="row.obj"')
    assert "physics: at rest" in page
    assert "2 assets (2 OBJ" in told.err


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        ("info nope.obj", "nope.obj"),
        ("render row.obj -o x.png --size big", "--size big is not a size"),
        ("render row.obj -o x.png --views under", "there is no view 'under'"),
        ("render row.obj", "nothing says what to write"),
        ("select 'Geo(Is(leg), +W)' row.obj", "+W"),
        ("apply row.obj row.obj", "--out DIR is missing"),
        ("apply row.mf row.obj", "row.mf: there is no such project or program"),
        ("status .", "this is no project"),
        ("new p '*.stl'", "*.stl"),
        ("new p row.obj --hollow", "--hollow says nothing without --decompose METHOD"),
        ("new p row.obj --workers 1", "--workers says nothing without --decompose METHOD"),
        ("check row.obj --engine quake", "quake"),
        ("decompose row.obj", "nothing says what to write"),
        ("check row.obj --update-baseline", "--update-baseline says nothing without --baseline"),
        ("check row.obj --baseline b --max-vertices 9 --fix --out o", "--baseline does not go with --fix"),
        ("decompose row.obj -o h.obj --set treshold=0.1", "threshold=0.05"),
        ("convert row.obj", "there is nothing to write to"),
        ("convert row.obj t.obj out", "several assets and no format"),
        ("convert row.obj out --to wrl", "nothing is written as .wrl"),
        ("convert row.obj out --to .obj --overwrite", "--overwrite is for one asset"),
        ("convert row.obj out.obj --names godot", "OBJ files cannot be named for Godot"),
        ("convert row.obj out --to usda --names unreal", "USD files cannot be named for Unreal"),
        ("convert row.obj out.glb --names blender", "is not one of 'unreal', 'godot', 'unity'"),
        ("apply p.mf row.obj --out out --check fit", "--check says nothing without --report"),
        ("apply p.mf row.obj --out out --report r.html --dry-run", "with --dry-run there is nothing to show"),
        ("apply p.mf row.obj --out out --report r.html --check fits", "there is no check 'fits'"),
        ("apply p.mf row.obj --out out --report r.html --check unity --check bullet", "two engines: unity, bullet"),
        ("apply p.mf row.obj --out out --memory much", "'much' is no number of GiB above 0"),
    ],
)
def test_wrong_usage_is_one_message_and_exit_code_two(run: Run, words: str, problem: str) -> None:
    Path("p.mf").write_text("labels leg, panel\n\nIs(leg) => Merge\n")
    before = tree(Path())
    told = run(*shlex.split(words))
    assert told.code == 2
    assert told.err.startswith("error: ") or "Usage" in told.err
    assert problem in told.err
    assert tree(Path()) == before


@pytest.mark.slow
def test_the_loop_of_a_project_from_the_command_line(run: Run) -> None:
    assert run("new", "rows", "row.obj", "--vocabulary", "leg,panel").code == 0
    taken, summary = map(json.loads, run("label", "rows", "--with", "file", "--json").out.splitlines())
    assert (taken["taken"], summary["labels"]["unlabelled"]) == (3, 0)
    assert run("synthesize", "rows").code == 2  # nothing is demonstrated yet
    assert run("demonstrate", "rows", "row.obj", "l*, far => Delete", "middle => Replace(sphere)").code == 0
    assert run("demonstrate", "rows", "row.obj").out == "1. far, left => Delete\n2. middle => Replace(sphere)\n"
    learned = run("synthesize", "rows", "--json").json
    assert learned["status"] == "found"
    assert [reading["extractor"] for reading in learned["candidates"]] == ["Is(leg)", "Is(panel)"]
    assert run("apply", "rows", "--workers", "1").code == 0
    assert json.loads(Path("rows/edited/row.labels.json").read_text())["hulls"]["middle"]["label"] == "panel"
    assert run("status", "rows", "--json").json["assets"][0]["output"] == "edited"
    assert run("demonstrate", "rows", "row.obj", "--clear").code == 0
    assert run("demonstrate", "rows", "row.obj").out == ""
