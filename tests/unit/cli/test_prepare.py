"""Preparing from the command line: what is printed, exit codes, JSON, and words that do not fit."""

from pathlib import Path

import pytest

from tests.unit.batch.preparation.samples import write_boxes, write_stand
from tests.unit.cli.in_process import Run
from tests.urdf_sample import boxes_obj

VOXELS = ("--decompose", "vhacd", "--set", "resolution=5000", "--set", "max_convex_hulls=4", "--workers", "1")


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("cache")


@pytest.fixture
def run(run: Run, cache: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Runs the command line in a folder that holds `in/stand.urdf` and `in/row.obj`."""
    monkeypatch.setenv("MESHFORGE_CACHE", str(cache))
    write_stand(Path("in"))
    write_boxes(Path("in/row.obj"))
    return run


@pytest.fixture
def project(run: Run) -> str:
    assert run("new", "p", "in/stand.urdf", "in/row.obj", "--vocabulary", "a,b").code == 0
    return "p"


@pytest.mark.slow
def test_new_with_decompose_makes_hulls_and_says_what_it_made(run: Run) -> None:
    told = run("new", "p", "in/stand.urdf", "in/row.obj", *VOXELS)
    assert told.code == 0
    assert "row.obj: nothing new\n" in told.out and "stand.urdf: 2 pieces into " in told.out
    assert "\n    frame/body: " in told.out
    assert "2 pieces decomposed into" in run("status", "p").out
    assert run("prepare", "p", *VOXELS).out == "row.obj: nothing new\nstand.urdf: nothing new\n"


@pytest.mark.slow
def test_preparing_by_parts_names_hulls_by_them_and_is_kept_and_undone(run: Run) -> None:
    left, right = boxes_obj(((0, 0, 0), (1, 1, 1))), boxes_obj(((1, 0, 0), (3, 1, 1)))
    faces = [line for line in right.splitlines() if line.startswith("f")]
    count = left.count("\nv ") + left.startswith("v ")
    moved = ["f " + " ".join(str(int(word) + count) for word in line.split()[1:]) for line in faces]
    places = [line for line in right.splitlines() if line.startswith("v")]
    Path("in/corner.obj").write_text("o wall\n" + left + "\no handle\n" + "\n".join([*places, *moved]) + "\n")
    assert run("new", "p", "in/stand.urdf", "--by", "parts", *VOXELS).code == 0
    names = [hull["name"] for hull in run("info", "stand.urdf", "--project", "p", "--json").json["hulls"]]
    assert {"cover/wall#0", "cover/handle#0"} <= set(names)
    assert '"by": "parts"' in "".join(path.read_text() for path in Path("p/prepared").rglob("*.json"))
    assert run("prepare", "p", "stand.urdf", "--undo").code == 0
    assert not any(
        "#" in h["name"] and "cover" in h["name"]
        for h in run("info", "stand.urdf", "--project", "p", "--json").json["hulls"]
    )


def test_new_with_decompose_exits_with_1_where_a_piece_fails_and_the_project_is_there(run: Run) -> None:
    Path("in/bad.obj").write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
    told = run("new", "p", "in/bad.obj", "in/stand.urdf", *VOXELS)
    assert told.code == 1 and "bad.obj" in told.out and "failed: " in told.out
    assert "stand.urdf: 2 pieces into " in told.out
    assert Path("p/meshforge.toml").is_file()


def test_a_project_without_a_name_is_not_made_here(run: Run) -> None:
    told = run("new", "", "in/row.obj")
    assert told.code == 2 and "the folder to make has no name" in told.err
    assert not Path("meshforge.toml").exists()
    assert run("new", ".", "in/row.obj").code == 0


@pytest.mark.slow
def test_status_and_info_lead_to_what_can_be_prepared(run: Run, project: str) -> None:
    assert "2 without hulls (meshforge prepare)" in run("status", project).out
    run("prepare", project, "stand.urdf", *VOXELS, "--only", "frame/*")
    assert "1 without hulls (meshforge prepare)" in run("status", project).out
    for asset in ("stand.urdf", "in/stand.urdf"):
        told = run("info", asset, "--project", project, "--json").json
        assert {hull["name"].partition("#")[0] for hull in told["hulls"]} == {"frame/body", "frame/foot"}
        assert told["non_convex"] == []
    assert len(run("info", "in/stand.urdf", "--json").json["non_convex"]) == 1


def test_select_and_render_show_the_project_s_asset_with_its_labels(run: Run, project: str) -> None:
    run("cut", project, "row.obj", "geom0#1", "--at", "2,0,0", "--across", "1,0,0")
    assert run("select", "Geo(All, +X)", "row.obj", "--project", project, "--json").json == {"hulls": ["geom0#2"]}
    assert run("render", "row.obj", "--project", project, "-o", "row.png", "--size", "200x150").code == 0
    assert run("info", "row.obj", "--project", project, "--labels", "x.json").code == 2
    assert "Did you mean 'row.obj'" in run("info", "roww.obj", "--project", project).err


def test_prepare_as_json_has_a_line_for_each_asset(run: Run, project: str) -> None:
    row, stand = run("prepare", project, *VOXELS, "--json").lines
    assert row == {
        "asset": "row.obj",
        "made": [],
        "notes": [],
        "problems": [],
        "undone": [],
        "planned": [],
        "found": [],
        "hulls": [],
    }
    assert [entry["what"] for entry in stand["made"]] == ["frame/body", "cover"]
    assert stand["hulls"] == [name for entry in stand["made"] for name in entry["made"]]


def test_cut_along_a_plane_and_back(run: Run, project: str) -> None:
    told = run("cut", project, "row.obj", "geom0#1", "--at", "1.5,0,0", "--across", "1,0,0")
    assert told.code == 0 and told.out == "row.obj: 1 piece into 2 hulls\n    geom0#1: 2 hulls\n"
    told = run("prepare", project, "row.obj", "--undo")
    assert told.out == "row.obj: taken back\n    geom0#1 cut into 2 hulls\n"
    told = run("prepare", project, "row.obj", "--undo")
    assert told.code == 1 and "failed: row.obj: nothing was done to it" in told.out


@pytest.mark.slow
def test_names_that_no_piece_or_body_has_are_told(run: Run, project: str) -> None:
    told = run("prepare", project, *VOXELS, "--only", "nothing*")
    assert told.code == 0
    assert "note: no piece or body matches nothing*: it has frame/body, cover\n" in told.out
    assert "note: no piece or body matches nothing*: it has none that can be decomposed\n" in told.out
    for _ in ("made", "made before"):
        assert "matches" not in run("prepare", project, "stand.urdf", *VOXELS, "--only", "no", "--only", "frame/*").out


def test_what_cannot_be_taken_back_is_named_and_the_rest_is(run: Run, project: str) -> None:
    run("prepare", project, *VOXELS)
    for asset, hull, x in (("row.obj", "geom0#1", "2"), ("stand.urdf", "frame/foot", "0")):
        run("cut", project, asset, hull, "--at", f"{x},0,-1", "--across", "1,0,0")
    Path("in/stand.urdf").write_text("<robot")
    told = run("prepare", project, "stand.urdf", "row.obj", "--undo")
    assert told.code == 1
    assert "row.obj: taken back\n" in told.out and "failed: " in told.out and "in/stand.urdf" in told.out
    assert run("prepare", project, "stand.urdf", "--remove").code == 0
    assert not Path("p/prepared/stand.urdf").exists()


@pytest.mark.slow
def test_what_is_kept_for_an_asset_that_is_gone_can_be_taken_away(run: Run) -> None:
    run("new", "p", "in/stand.*", "in/row.*", "--vocabulary", "a,b")
    run("cut", "p", "row.obj", "geom0#1", "--at", "2,0,0", "--across", "1,0,0")
    run("cut", "p", "stand.urdf", "frame/foot", "--at", "-0.5,0,-1", "--across", "-1,0,0")
    write_boxes(Path("in/row.2.obj"))
    Path("in/row.obj").unlink()
    assert "kept for an asset that is not there: row.obj" in run("status", "p").out
    told = run("prepare", "p", "--remove")
    assert told.code == 0 and told.out.count("taken back") == 2
    assert "not there" not in run("status", "p").out


@pytest.mark.slow
def test_a_damaged_record_is_taken_back_and_a_folder_in_its_place_is_told(run: Run, project: str) -> None:
    record = Path("p/prepared/row.obj/preparation.json")
    record.parent.mkdir(parents=True)
    record.write_text("[" * 100_000)
    assert "this preparation is damaged: this JSON is nested too deeply" in run("status", project).out
    told = run("prepare", project, "row.obj", "--remove")
    assert told.code == 0 and told.out == "row.obj: taken back\n    what was kept, which was damaged\n"
    record.mkdir(parents=True)
    for words in (("prepare", project, "row.obj", "--remove"), ("prepare", project, "row.obj", "--undo")):
        told = run(*words)
        assert told.code == 1 and "Take away by hand what stands there" in told.out
    assert "Take away by hand what stands there" in run("status", project).out


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (("prepare", "p"), "say what to do"),
        (("prepare", "p", "--decompose", "coacd", "--undo"), "say what to do"),
        (("prepare", "p", "--undo"), "--undo of which asset?"),
        (("prepare", "p", "roww.obj", "--decompose", "vhacd"), "Did you mean 'row.obj'"),
        (("prepare", "p", "row.obj", "--remove", "--only", "geom0"), "--only says nothing without --decompose"),
        (("cut", "p", "row.obj", "geom0#1"), "Missing option '--at'"),
        (("cut", "p", "row.obj", "geom0#1", "--at", "1,0", "--across", "1,0,0"), "--at 1,0: three numbers"),
        (
            ("cut", "p", "row.obj", "geom0#1", "--at", "9,0,0", "--across", "1,0,0"),
            "does not cut it\n  Choose --at within it",
        ),
        (
            ("cut", "p", "row.obj", "geom0#1", "--at", "nan,0,0", "--across", "1,0,0"),
            "needs a point whose coordinates are finite",
        ),
        (
            ("cut", "p", "row.obj", "geom0#1", "--at", "2,0,0", "--across", "0,0,0"),
            "needs a normal that is finite and not zero",
        ),
        (("cut", "p", "row.obj", "geom9", "--at", "2,0,0", "--across", "1,0,0"), "there is no hull 'geom9'"),
    ],
)
def test_words_that_do_not_fit_are_wrong_usage(run: Run, project: str, words: tuple[str, ...], problem: str) -> None:
    told = run(*words)
    assert told.code == 2 and problem in told.err
    assert not (Path(project) / "prepared").exists()
