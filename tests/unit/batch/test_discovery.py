from glob import glob
from pathlib import Path

import pytest

from meshforge.batch import expand, make_jobs
from meshforge.common import UsageError, expand_glob
from meshforge.formats import load_many
from tests.unit.batch.families import obj, write_table, write_tables


def ids(*patterns: str | Path, root: Path | None = None) -> list[str]:
    return list(expand(patterns, root).ids)


def one_box(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(obj({"box": ((0, 0, 0), (1, 1, 1))}))
    return path


def test_a_glob_counts_ids_from_the_folder_before_its_first_star(tmp_path: Path) -> None:
    write_tables(tmp_path / "assets", 2)
    assert ids(tmp_path / "assets/**/*.obj") == ["table0/model.obj", "table1/model.obj"]
    assert expand([str(tmp_path / "assets/*/*.obj")]).base == tmp_path / "assets"


def test_files_count_from_their_common_folder_and_come_once_in_order(tmp_path: Path) -> None:
    paths = write_tables(tmp_path, 3)
    assert ids(paths[2], paths[0], paths[2]) == ["table0/model.obj", "table2/model.obj"]
    assert ids(paths[1]) == ["model.obj"]


def test_parts_of_models_and_other_xml_are_no_assets_unless_named(tmp_path: Path) -> None:
    model = '<?xml version="1.0"?><!-- <a> -- b --><!DOCTYPE x>\n<mujoco><include file="part.xml"/></mujoco>'
    texts = {"model.xml": model, "part.xml": "<mujocoinclude/>", "package.xml": "<package/>", "odd.xml": "no element"}
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    one_box(tmp_path / "mesh.obj")
    assert ids(tmp_path) == ids(tmp_path / "*.xml") == ["model.xml", "odd.xml"]
    assert ids(tmp_path / "part.xml") == ["part.xml"]


def test_mesh_files_of_one_hull_each_are_the_pieces_of_one_asset(tmp_path: Path) -> None:
    for name in ("a/1.obj", "a/2.obj", "b/1.obj", "b/2.obj"):
        one_box(tmp_path / name)
    assert ids(tmp_path) == ["a", "b"]
    assert ids(tmp_path / "a") == ["a"]


def test_mesh_files_of_several_hulls_are_assets_of_their_own(tmp_path: Path) -> None:
    one_box(tmp_path / "a.obj")
    write_table(tmp_path / "b.obj")
    assert ids(tmp_path) == ["a.obj", "b.obj"]


def test_what_was_written_before_is_passed_over_unless_named_outright(tmp_path: Path) -> None:
    write_table(tmp_path / "assets" / "t.obj")
    write_table(tmp_path / "assets" / "out" / "t.obj")
    (tmp_path / "assets" / "out" / ".meshforge").mkdir()
    for pattern in ("assets", "assets/**/*.obj", "assets/*"):
        assert ids(pattern, root=tmp_path) == ["t.obj"]
    assert ids("assets/out", root=tmp_path) == ["t.obj"]
    assert expand(["assets/out/*.obj"], tmp_path).paths == (tmp_path / "assets/out/t.obj",)


def test_the_folders_of_a_project_hold_no_assets(tmp_path: Path) -> None:
    (tmp_path / "meshforge.toml").touch()
    for name in ("templates/knob.obj", "edited/t.obj", "assets/t.obj"):
        write_table(tmp_path / name)
    assert ids(tmp_path) == ids("**/*.obj", root=tmp_path) == ["assets/t.obj"]


@pytest.mark.parametrize("pattern", ["absent.obj", "*.urdf", "empty"])
def test_an_argument_that_matches_nothing_is_named(tmp_path: Path, pattern: str) -> None:
    (tmp_path / "empty").mkdir()
    with pytest.raises(UsageError, match=pattern.replace("*", r"\*")):
        expand([pattern], tmp_path)


def test_labels_are_found_beside_the_assets_or_in_a_folder_that_mirrors_them(tmp_path: Path) -> None:
    write_tables(tmp_path / "assets", 3)
    found = expand([tmp_path / "assets"])
    assert [job.labels for job in make_jobs(found)] == [p.with_suffix(".labels.json") for p in found]
    mirror = tmp_path / "labels"
    for name in ("table0/model.obj.json", "table1/model.labels.json"):
        (mirror / name).parent.mkdir(parents=True)
        (mirror / name).touch()
    given = [job.labels for job in make_jobs(found, mirror)]
    assert given == [mirror / "table0/model.obj.json", mirror / "table1/model.labels.json", None]


def test_one_labels_file_serves_one_asset_only(tmp_path: Path) -> None:
    paths = write_tables(tmp_path, 2)
    labels = paths[0].with_suffix(".labels.json")
    assert make_jobs(expand(paths[1:]), labels)[0].labels == labels
    with pytest.raises(UsageError, match="one labels file cannot serve 2 assets"):
        make_jobs(expand(paths), labels)
    with pytest.raises(UsageError, match="no such labels file or folder"):
        make_jobs(expand(paths[:1]), tmp_path / "absent")


def test_links_that_lead_in_circles_are_followed_once(tmp_path: Path) -> None:
    for name in ("one", "two"):
        one_box(tmp_path / "assets" / name / "cube.obj")
    circles = {"one/self": "one", "one/up": "", "one/two": "two", "two/one": "one", "two/twin": "two"}
    for link, target in circles.items():
        (tmp_path / "assets" / link).symlink_to(tmp_path / "assets" / target)
    found = ["one/cube.obj", "one/two/cube.obj", "two/cube.obj", "two/one/cube.obj"]
    assert ids(tmp_path / "assets/**/*.obj") == found
    assert ids(tmp_path / "assets/**/cube.*") == found
    assert ids(tmp_path / "assets") == found
    assert len(list(load_many(tmp_path / "assets/**/*.obj"))) == len(found)


@pytest.mark.parametrize(
    "pattern", ["**/*.obj", "a/**", "**", "*/**/b/*.obj", "**/b/**/*.obj", "a/*.obj", "./a/../**/c.obj"]
)
def test_a_glob_matches_what_python_matches(pattern: str, tmp_path: Path) -> None:
    for name in ("c.obj", "a/c.obj", "a/b/c.obj", "a/b/b/d.obj", "e/b/c.obj", ".hidden/c.obj", "a/.hidden.obj"):
        one_box(tmp_path / name)
    (tmp_path / "linked").symlink_to(tmp_path / "a")
    ours = {Path(name) for name in expand_glob(pattern, tmp_path)}
    theirs = {Path(name) for name in glob(pattern, root_dir=tmp_path, recursive=True)}  # noqa: PTH207
    assert {path for path in ours if (tmp_path / path).is_file()} == {p for p in theirs if (tmp_path / p).is_file()}
    assert ours <= theirs
