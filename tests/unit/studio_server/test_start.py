"""The start page: recent projects, folders, and new projects that are there whole or not at all."""

import asyncio
import json
import os
from collections.abc import AsyncIterator, Iterator
from pathlib import Path

import pytest

from meshforge.common import MeshForgeError, UsageError
from meshforge.project import Project
from meshforge.samples import TABLES, family_of
from meshforge.store import ConflictError
from meshforge.studio.host import Host
from meshforge.studio.session.session import StudioOptions
from meshforge.studio.start import folders
from meshforge.studio.start.folders import build_project
from meshforge.studio.start.page import RecentProjects, StartPage, state_folder
from meshforge.studio.wire.start import ProjectOfFamily, ProjectOfFolder, ProjectOfTour, ProjectOfUpload
from tests.unit.batch.families import tree
from tests.unit.project.stools import boxes, write_bare_stool, write_stool


@pytest.fixture
def state(tmp_path: Path) -> Path:
    return tmp_path / "state"


@pytest.fixture
def assets(tmp_path: Path) -> Path:
    folder = tmp_path / "desks"
    folder.mkdir()
    (folder / "table_01.obj").write_bytes((TABLES / "table_01.obj").read_bytes())
    return folder


@pytest.fixture
def page(state: Path) -> Iterator[StartPage]:
    page = StartPage(state)
    yield page
    page.close()


async def _chunks(data: bytes) -> AsyncIterator[bytes]:
    yield data


def send(page: StartPage, path: str, data: bytes) -> None:
    asyncio.run(page.uploads.put(path, _chunks(data)))


def test_what_lacks_files_is_said_and_left_out(page: StartPage, tmp_path: Path) -> None:
    lost = '<mujoco><asset><mesh file="gone.stl" name="m"/></asset><worldbody><geom size="1"/>'
    lost += '<geom type="mesh" mesh="m" contype="0" conaffinity="0"/></worldbody></mujoco>'
    (tmp_path / "home").mkdir()
    (tmp_path / "home/cup.xml").write_text(lost)
    looked = page.look_at_folder(str(tmp_path / "home"))
    assert looked.broken == 1 and looked.problem and "not there: gone.stl" in looked.problem
    send(page, "cup.xml", lost.encode())
    with pytest.raises(MeshForgeError, match=r"cup\.xml refers to 1 file that was not dropped: gone\.stl: drop"):
        page.look_at_upload()


# Recent projects


def test_the_state_folder_is_that_of_the_user() -> None:
    assert state_folder({"MESHFORGE_STATE": "/s"}) == Path("/s")
    assert state_folder({"XDG_STATE_HOME": "/x"}) == Path("/x/meshforge")
    assert state_folder({}) == Path.home() / ".local/state/meshforge"


def test_the_project_that_was_opened_last_comes_first_and_once(state: Path) -> None:
    recent = RecentProjects(state)
    for name in "aba":
        recent.add(Path("/projects") / name, name, 3)
    assert [one.name for one in recent.list()] == ["a", "b"]
    for k in range(101):
        recent.add(Path("/projects") / str(k), str(k), 1)
    assert len(recent.list()) == 100 and recent.list()[0].name == "100", "a hundred stay"


def test_a_project_that_is_gone_is_shown_as_gone_and_can_be_forgotten(state: Path, tmp_path: Path) -> None:
    recent, there = RecentProjects(state), tmp_path / "there"
    there.mkdir()
    (there / "meshforge.toml").write_text("")
    recent.add(tmp_path / "gone", "gone", 1)
    recent.add(there, "there", 1)
    assert [(one.name, one.gone) for one in recent.list()] == [("there", False), ("gone", True)]
    recent.forget(str(tmp_path / "gone"))
    assert [one.name for one in recent.list()] == ["there"]


def test_recent_projects_say_how_far_they_are_until_that_changed(state: Path, tmp_path: Path, assets: Path) -> None:
    recent, folder = RecentProjects(state), Project.create(tmp_path / "p", [assets]).folder
    picture = folder / ".meshforge" / "studio" / "thumbnails" / "a.png"
    assert recent.find_picture(str(folder)) is None
    picture.parent.mkdir(parents=True)
    picture.write_bytes(b"")
    recent.add(folder, "p", 14, "12 of 14 signed off")
    recent.add(folder, "p", 14)  # opened again, then killed
    (one,) = recent.list()
    assert (one.state, one.picture, recent.find_picture(str(folder))) == ("12 of 14 signed off", "a.png", picture)
    assert recent.find_picture(str(tmp_path)) is None
    os.utime(folder / "meshforge.toml", ns=(2**62, 2**62))
    assert recent.list()[0].state == "changed since it was left"
    (folder / "meshforge.toml").write_text("name = [")
    assert "this is no TOML" in recent.list()[0].state


@pytest.mark.parametrize("text", ["", "{broken", '{"projects": 3}', "[]"])
def test_a_damaged_list_of_projects_is_an_empty_one(state: Path, text: str) -> None:
    state.mkdir()
    (state / "recent.json").write_text(text)
    assert RecentProjects(state).list() == ()
    RecentProjects(state).add(Path("/a"), "a", 1)
    assert [one.name for one in RecentProjects(state).list()] == ["a"]


def test_what_a_newer_version_keeps_of_a_project_stays(state: Path) -> None:
    state.mkdir()
    rows = [{"folder": "/a", "name": "a", "colour": "red"}]
    (state / "recent.json").write_text(json.dumps({"projects": rows, "more": 1}))
    RecentProjects(state).add(Path("/b"), "b", 1)
    kept = json.loads((state / "recent.json").read_text())
    assert kept["more"] == 1 and kept["projects"][1]["colour"] == "red"


def test_a_list_that_cannot_be_written_keeps_nobody_from_opening(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    RecentProjects(tmp_path / "file").add(Path("/a"), "a", 1)
    assert RecentProjects(tmp_path / "file").list() == ()


# Folders


@pytest.mark.parametrize("text", ["", "  ", "relative/path", "a\0b", "/a\nb", "~nobody-of-that-name/x"])
def test_what_is_no_whole_path_is_refused_with_a_remedy(text: str) -> None:
    with pytest.raises(UsageError) as refusal:
        folders.parse_path(text)
    assert refusal.value.remedy


def test_a_tilde_is_the_home_folder() -> None:
    assert folders.parse_path(" ~/x/../y ") == Path.home() / "y"


def test_a_folder_lists_folders_projects_and_how_many_files_there_are(tmp_path: Path, assets: Path) -> None:
    Project.create(tmp_path / "project", [assets])
    (tmp_path / ".hidden").mkdir()
    found = folders.list_folder(tmp_path)
    assert [(one.name, one.project) for one in found.entries] == [("desks", False), ("project", True)]
    assert folders.list_folder(assets).files == 1


@pytest.mark.parametrize("name", ["gone", "desks/table_01.obj", "x" * 300])
def test_what_is_no_folder_is_one_sentence_with_a_remedy(tmp_path: Path, assets: Path, name: str) -> None:
    with pytest.raises(UsageError) as refusal:
        folders.list_folder(tmp_path / name)
    assert refusal.value.remedy and "\n" not in refusal.value.problem


# Making projects


def test_a_project_of_a_folder_leaves_the_assets_where_they_are(page: StartPage, tmp_path: Path, assets: Path) -> None:
    before = tree(assets)
    project = Project.open(page.create(ProjectOfFolder(folder=str(assets), project=str(tmp_path / "new" / "project"))))
    assert (project.name, project.assets()) == ("project", ("table_01.obj",))
    assert tree(assets) == before


def test_a_project_of_a_family_has_its_files_and_its_vocabulary(page: StartPage, tmp_path: Path) -> None:
    project = Project.open(page.create(ProjectOfFamily(family="tables", project=str(tmp_path / "tables"))))
    assert len(project.assets()) == 14 and project.vocabulary == family_of("tables").vocabulary
    assert all(path.is_relative_to(project.folder) for path in project.found.paths)


def test_the_project_of_the_tour_is_that_of_the_demo(page: StartPage, tmp_path: Path) -> None:
    assert Path(page.view.tour).name.startswith("tables-tour")
    project = Project.open(page.create(ProjectOfTour(project=str(tmp_path / "mine"))))
    assert (project.name, len(project.assets()), project.template_names()) == ("mine", 14, ("tray.obj",))
    assert all(hull.label for hull in project.mesh("table_01.obj").hulls) and project.settings.orient


def test_a_look_names_the_parts_of_what_has_no_hulls(page: StartPage, tmp_path: Path) -> None:
    write_bare_stool(tmp_path / "stools", "a")
    write_stool(tmp_path / "stools", "b", boxes(0.2, 0.4), [])
    found = page.look_at_folder(str(tmp_path / "stools"))
    assert (found.assets, found.bare, found.divided, found.parts, found.seen) == (2, 2, 1, ("seat", "leg"), 0)


def test_a_look_counts_what_is_only_seen_beside_what_collides(page: StartPage, tmp_path: Path) -> None:
    box = '<geometry><box size="1 1 1"/></geometry>'
    links = f'<link name="a"><collision>{box}</collision></link><link name="b"><visual>{box}</visual></link>'
    joint = '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
    (tmp_path / "lamp.urdf").write_text(f'<robot name="lamp">{links}{joint}</robot>')
    found = page.look_at_folder(str(tmp_path))
    assert (found.pieces, found.seen, found.bare) == (1, 1, 1)


def test_a_project_of_an_upload_has_what_can_be_read_in_its_own_folder(page: StartPage, tmp_path: Path) -> None:
    send(page, "desks/table_01.obj", (TABLES / "table_01.obj").read_bytes())
    send(page, "desks/bad.obj", b"v 0 0 zero\nf 1 1 1\n")
    send(page, "desks/notes.txt", b"mine")
    found = page.look_at_upload()
    assert (found.assets, found.broken, found.left_out) == (1, 1, True)
    assert Path(found.project).name.split("-")[0] == "desks"
    assert found.problem and "bad.obj" in found.problem
    assert page.uploads.list_files()[1] == ("desks/notes.txt", "desks/table_01.obj")
    project = Project.open(page.create(ProjectOfUpload(project=str(tmp_path / "p"))))
    assert project.assets() == ("table_01.obj",)
    assert project.path("table_01.obj") == tmp_path / "p" / "assets" / "desks" / "table_01.obj"
    home = page.uploads.folder
    page.close()
    assert not home.parent.exists()


def test_an_upload_without_assets_is_one_sentence_and_leaves_nothing(page: StartPage, tmp_path: Path) -> None:
    send(page, "readme.txt", b"hello")
    with pytest.raises(MeshForgeError, match="no asset"):
        page.look_at_upload()
    with pytest.raises(MeshForgeError, match="no asset"):
        page.create(ProjectOfUpload(project=str(tmp_path / "p")))
    assert not (tmp_path / "p").exists()


@pytest.mark.parametrize("what", ["project", "other files", "file", "below a file"])
def test_a_place_that_is_taken_is_refused_and_stays(page: StartPage, tmp_path: Path, assets: Path, what: str) -> None:
    place = tmp_path / "place"
    if what == "project":
        Project.create(place, [assets])
    elif what == "other files":
        place.mkdir()
        (place / "notes.txt").write_text("mine")
    else:
        place.write_text("mine")
    before = tree(tmp_path)
    with pytest.raises(UsageError) as refusal:
        wanted = place / "x" if what == "below a file" else place
        page.create(ProjectOfFolder(folder=str(assets), project=str(wanted)))
    assert refusal.value.remedy
    assert {name: data for name, data in tree(tmp_path).items() if not name.startswith("state/")} == before


def test_an_error_while_a_project_is_made_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(ZeroDivisionError), build_project(tmp_path / "a" / "b" / "c") as draft:
        (draft / "half").write_text("x")
        raise ZeroDivisionError
    assert not (tmp_path / "a").exists()


# Opening and leaving


@pytest.fixture
def host(monkeypatch: pytest.MonkeyPatch, state: Path) -> Iterator[Host]:
    monkeypatch.setitem(os.environ, "MESHFORGE_STATE", str(state))
    found = Host(StudioOptions())
    yield found
    found.close()


@pytest.mark.slow
def test_an_open_project_closes_the_start_page_until_it_is_left(host: Host, tmp_path: Path, assets: Path) -> None:
    folder = Project.create(tmp_path / "project", [assets]).folder
    with pytest.raises(ConflictError):
        _ = host.session
    host.open(folder)
    assert host.session.project.folder == folder
    with pytest.raises(ConflictError):
        _ = host.start
    with pytest.raises(ConflictError):
        host.open(folder)
    host.leave()
    assert [(one.folder, one.gone) for one in host.start.recent.list()] == [(str(folder), False)]
    host.open(folder)  # its lock was let go of


def test_a_folder_that_is_no_project_is_refused_and_the_start_page_stays(host: Host, tmp_path: Path) -> None:
    with pytest.raises(MeshForgeError, match="no project"):
        host.open(tmp_path)
    assert host.start.recent.list() == ()


def test_a_studio_of_one_project_has_no_start_page(
    monkeypatch: pytest.MonkeyPatch, state: Path, tmp_path: Path
) -> None:
    monkeypatch.setitem(os.environ, "MESHFORGE_STATE", str(state))
    host = Host(StudioOptions(tmp_path))
    with pytest.raises(ConflictError):
        _ = host.start
    with pytest.raises(ConflictError):
        host.leave()
    host.close()
