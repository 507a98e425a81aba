"""What makes a sign-off void, and what does not: every kind of change, one after the other."""

import json
import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from meshforge.batch import IN_PROCESS
from meshforge.common import write_atomically
from meshforge.language import Add, Delete, Program
from meshforge.project import Project, make_manual_edit, run_with_manual_edits
from meshforge.store import ANSWERS
from meshforge.synthesis import Answer, Step
from tests.unit.batch.families import obj, write_tables, write_urdf_table
from tests.unit.project.tables import FIRST, SECOND, STEPS, THIRD

ACCEPTED = "urdf/table.urdf"
FAMILY = (FIRST, SECOND, THIRD, ACCEPTED)

Voids = dict[str, tuple[str, ...]]
NONE: Voids = {}
SHOWN: Voids = dict.fromkeys((FIRST, SECOND, THIRD), (ANSWERS,))  # what a person accepted rests on that look
SETTINGS: Voids = dict.fromkeys(SHOWN, ("settings",))
EVERY: Voids = {**SHOWN, ACCEPTED: (ANSWERS,)}


def knob(size: float) -> bytes:
    return obj({"knob": ((0, 0, 0), (size, size, size))}).encode()


def add_knob(project: Project) -> None:
    """Edit the third table by hand, as a file from elsewhere does: nobody says that its result was wrong."""
    mesh = run_with_manual_edits(project, THIRD, project.mesh(THIRD), project.program()).mesh
    edit = make_manual_edit(mesh, THIRD, ["top"], Add("+Z", "knob.obj", keep=True), None)
    project.write_manual_edits(THIRD, [edit])


@pytest.fixture(scope="module")
def signed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a project of four tables, all signed off: two are demonstrated, one is accepted; the third is
    prepared, and edited by hand with a template. Its status was asked for, so that all its files are known."""
    root = tmp_path_factory.mktemp("signed")
    write_tables(root / "assets", 3)
    write_urdf_table(root / "assets/urdf")
    third = root / "assets" / THIRD
    third.with_name("look.mtl").write_text("newmtl wood\nmap_Kd wood.png\n")
    third.with_name("wood.png").write_bytes(b"\x89PNG\r\n\x1a\n")
    third.write_text(f"mtllib look.mtl\nusemtl wood\n{third.read_text()}")
    project = Project.create(root / "tables", [root / "assets" / name for name in FAMILY])
    project.label("file")
    project.cut(THIRD, "crumb", (5.05, 5.05, 5.05), (1, 0, 0))
    for asset in (FIRST, SECOND):
        project.demonstrate(asset, STEPS)
    project.synthesize()
    write_atomically(project.layout.own_templates / "knob.obj", knob(0.01))
    add_knob(project)
    list(project.apply(execution=IN_PROCESS))
    project.set_verdict(ACCEPTED, "accepted")
    project.review(0.5, execution=IN_PROCESS)
    assert project.status(workers=0).is_signed_off
    assert {name: one.by for name, one in project.sign_offs().items()}[THIRD] == "tool"
    return root


@pytest.fixture
def project(signed: Path, tmp_path: Path) -> Project:
    """A copy of that: every file has another inode and another time."""
    shutil.copytree(signed, tmp_path / "copy")
    return Project.open(tmp_path / "copy/tables")


def find_voids(project: Project, *, verify: bool = False) -> Voids:
    """What changed of the assets that are not signed off any more."""
    found = Project.open(project.folder).status(workers=0, verify=verify)
    assert {one.result_status.state for one in found.assets} <= {"signed off", "void"}
    assert all(bool(one.result_status.void) == (one.result_status.state == "void") for one in found.assets)
    return {one.id: one.result_status.void for one in found.assets if one.result_status.void}


def output(project: Project, asset: str) -> Path:
    return project.layout.edited / asset


def change_text(path: Path, old: str, new: str) -> None:
    """Change a text file, with its size and its times kept where the texts are of one length."""
    before, text = path.stat(), path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))


def change_asset(project: Project) -> None:
    change_text(project.path(THIRD), "1.6", "1.7")


def lay_out_anew(path: Path) -> None:
    """Write a JSON file in another order of its keys, with other white space and line ends, behind a BOM."""
    turned = json.loads(path.read_text(), object_pairs_hook=lambda pairs: dict(reversed(pairs)))
    path.write_bytes(b"\xef\xbb\xbf" + json.dumps(turned, indent=7).replace("\n", "\r\n").encode())


def lay_all_out_anew(project: Project) -> None:
    kinds = ("labels", "demonstrations", "corrections", "prepared")
    paths = [path for kind in kinds for path in (project.folder / kind).rglob("*.json")]
    assert len(paths) >= 8
    for path in paths:
        lay_out_anew(path)
    for path in (project.layout.events, project.layout.sign_offs):
        rows = (dict(reversed(json.loads(line).items())) for line in path.read_text().splitlines())
        path.write_text("\n\n".join(map(json.dumps, rows)) + "\n")
    project.layout.program.write_text(f"# mine\n{project.layout.program.read_text()}\n")
    project.layout.settings.write_text(f"# mine\n{project.layout.settings.read_text()}")


def set_in_settings(old: str, new: str) -> Callable[[Project], None]:
    def change(project: Project) -> None:
        path = project.layout.settings
        text = path.read_text()
        assert old in text
        path.write_text(text.replace(old, new))

    return change


def edit_output(project: Project) -> None:
    change_text(output(project, THIRD), "1.5", "1.6")


def edit_accepted_output(project: Project) -> None:
    change_text(output(project, ACCEPTED), "1.05", "1.06")


def cut_outputs_to_nothing(project: Project) -> None:
    for asset in FAMILY:
        output(project, asset).write_bytes(b"")


def exchange_outputs(project: Project) -> None:
    one, other = output(project, FIRST), output(project, SECOND)
    one.rename(one.with_name("aside"))
    other.rename(one)
    one.with_name("aside").rename(other)


def change_texture(project: Project) -> None:
    output(project, THIRD).with_name("wood.png").write_bytes(b"other")
    output(project, THIRD).with_name("look.mtl").unlink()


def write_outputs_again(project: Project) -> None:
    shutil.rmtree(project.layout.edited)
    list(project.apply(execution=IN_PROCESS))


def touch_all(project: Project) -> None:
    for path in project.folder.parent.rglob("*"):
        os.utime(path)


@pytest.mark.parametrize(
    ("change", "voids"),
    [
        (change_asset, {THIRD: ("asset",)}),
        (
            lambda project: change_text(project.path(ACCEPTED).with_name("meshes") / "crumb.obj", "0.1", "0.2"),
            {ACCEPTED: ("asset",)},
        ),
        (lambda project: project.set_labels(THIRD, {"left_low": "misc"}), {THIRD: ("labels",)}),
        (lambda project: project.rename_label("leg", "foot"), NONE),
        (lay_all_out_anew, NONE),
        (
            lambda project: project.cut(THIRD, "crumb#0", (5.025, 5.05, 5.05), (1, 0, 0)),
            {THIRD: ("preparation", "labels")},
        ),
        (
            lambda project: project.accept(Program.parse("labels misc\nIs(misc) => Delete\n")),
            dict.fromkeys(FAMILY, ("program",)),
        ),
        (
            lambda project: write_atomically(project.layout.own_templates / "knob.obj", knob(0.02)),
            {THIRD: ("templates",)},
        ),
        (lambda project: project.write_manual_edits(THIRD, ()), {THIRD: ("templates", "manual edits")}),
        (set_in_settings('orient = ""', 'orient = "+Z: Is(leg) -> Is(top)"'), SETTINGS),
        (set_in_settings('"leg"', '"leg", "rail"'), SETTINGS),
        (set_in_settings("# What hulls", "[thresholds]\ncontact = 0.1\n# "), SETTINGS),
        (set_in_settings("# What hulls", "[thresholds]\nextremity = 0.1\n# "), SETTINGS),
        (set_in_settings('name = "tables"', 'name = "desks"'), NONE),
        (
            lambda project: project.demonstrate(
                SECOND, [*STEPS[:1], Step(2, {"left_low", "left_high"}, STEPS[1].action)]
            ),
            SHOWN,
        ),
        (lambda project: project.demonstrate(ACCEPTED, [Step(1, {"body/top"}, Delete())]), SHOWN),
        (lambda project: project.layout.demonstration(SECOND).unlink(), SHOWN),
        (lambda project: project.set_verdict(ACCEPTED, None), EVERY),
        (lambda project: project.add_answer(Answer(1, THIRD, ["crumb#0", "crumb#1"])), SHOWN),
        (edit_output, {THIRD: ("output",)}),
        (edit_accepted_output, {ACCEPTED: ("output",)}),
        (
            lambda project: change_text(output(project, THIRD).with_suffix(".labels.json"), '"leg"', '"top"'),
            {THIRD: ("output",)},
        ),
        (cut_outputs_to_nothing, dict.fromkeys(FAMILY, ("output",))),
        (exchange_outputs, dict.fromkeys((FIRST, SECOND), ("output",))),
        (lambda project: output(project, THIRD).unlink(), {THIRD: ("output",)}),
        (change_texture, NONE),
        (write_outputs_again, NONE),
        (touch_all, NONE),
    ],
)
def test_changes_void_just_what_rests_on_them(
    project: Project, change: Callable[[Project], None], voids: Voids
) -> None:
    assert find_voids(project) == {}, "a copy is signed off as the project is"
    change(project)
    assert find_voids(project) == voids
    assert find_voids(project, verify=True) == voids


def test_a_project_that_moved_is_signed_off_as_before(project: Project) -> None:
    here = project.folder.parent
    there = here.with_name("elsewhere") / "deep"
    there.parent.mkdir()
    here.rename(there)
    shutil.rmtree(there / "tables/.meshforge")
    assert find_voids(Project.open(there / "tables")) == {}


@pytest.mark.parametrize(("memory", "change"), [("survey", change_asset), ("outputs", edit_output)])
def test_what_size_times_and_inode_do_not_tell_is_found_by_looking_at_everything(
    project: Project, memory: str, change: Callable[[Project], None]
) -> None:
    find_voids(project)
    before = find_records(project, memory)
    change(project)
    assert find_voids(project)
    after = find_records(project, memory)
    digests = {name: record["digest"] for name, record in before.items()}
    for name, record in after.items():  # as if nothing but the contents had changed
        record["digest"] = digests[name]
    write_records(project, memory, after)
    assert find_voids(project) == {}
    assert find_voids(project, verify=True).keys() == {THIRD}
    assert find_voids(project).keys() == {THIRD}, "what was found is known from now on"


Records = dict[str, dict[str, object]]


def find_records(project: Project, memory: str) -> Records:
    content = json.loads((project.layout.asset_index.parent / f"{memory}.json").read_text())
    found: Records = content["files"] if memory == "outputs" else content["assets"][THIRD]["files"]
    return found


def write_records(project: Project, memory: str, records: Records) -> None:
    path = project.layout.asset_index.parent / f"{memory}.json"
    content = json.loads(path.read_text())
    if memory == "outputs":
        content["files"] = records
    else:
        content["assets"][THIRD]["files"] = records
    path.write_text(json.dumps(content))


def test_without_a_program_all_that_it_made_is_void_but_what_a_person_accepted(project: Project) -> None:
    project.layout.program.unlink()
    assert find_voids(project) == dict.fromkeys((FIRST, SECOND, THIRD), ("program",))
    edit_accepted_output(project)
    assert find_voids(project)[ACCEPTED] == ("program",)


def test_an_output_that_is_not_as_it_was_written_is_signed_off_by_no_review(project: Project) -> None:
    edit_output(project)
    project.review(0.5, execution=IN_PROCESS)
    assert find_voids(project) == {THIRD: ("output",)}
    list(project.apply(execution=IN_PROCESS))
    assert find_voids(project) == {}


def test_a_sign_off_of_an_earlier_version_is_void_until_a_review(project: Project) -> None:
    path = project.layout.sign_offs
    rows = [json.loads(line) for line in path.read_text().splitlines()]
    for one in rows:
        del one["rests_on"]["answers"], one["rests_on"]["output"]
    path.write_text("".join(f"{json.dumps(one)}\n" for one in rows))
    assert find_voids(project) == dict.fromkeys((FIRST, SECOND, THIRD), ("how sign-offs are kept",))
    project.review(0.5, execution=IN_PROCESS)
    assert find_voids(project) == {}
