"""Names that were meant to mark collision for an engine and do not: `check` for that engine says so."""

from pathlib import Path

import pytest

from meshforge.checks import check
from meshforge.engines import Finding
from meshforge.formats import load, save
from meshforge.formats.engine_names import EngineName
from tests.soups import box
from tests.unit.cli.in_process import Run
from tests.unit.formats.test_marked_convex import write_nodes


def findings_of(folder: Path, engine: str, *nodes: str, parents: tuple[str, ...] = ()) -> list[Finding]:
    path = write_nodes(folder / "gate.glb", dict.fromkeys(nodes, box()), parents)
    return [finding for finding in check(load(path), engine) if finding.rule == f"{engine}-name"]


@pytest.mark.parametrize(
    ("nodes", "nearest"),
    [
        (("Gate", "UCX_Fence_00"), "Gate"),
        (("Gate", "Post", "UCX_Gte_00"), "Gate"),
        (("Gate", "ubx_gatepost"), "Gate"),
        (("Gate_01", "UCX_Gate"), "Gate_01"),
    ],
)
def test_a_hull_for_unreal_that_no_mesh_takes_is_an_error(tmp_path: Path, nodes: tuple[str, ...], nearest: str) -> None:
    (finding,) = findings_of(tmp_path, "unreal", *nodes)
    assert (finding.severity, finding.hulls) == ("error", (nodes[-1],))
    assert finding.message.startswith(f"{nodes[-1]}: no mesh is called ")
    assert f"The nearest mesh is {nearest}:" in finding.remedy


@pytest.mark.parametrize(
    "nodes",
    [
        ("Gate", "UCX_Gate"),
        ("Gate", "UCX_Gate_00", "UCX_Gate_01"),
        ("GATE", "ucx_gate_7"),
        ("Gate_01", "UCX_Gate_01"),
        ("Gate.001", "UCX_Gate.001", "UCX_Gate.001_00"),
        ("Gate", "UCX_Gate.001"),
        ("Gate", "Ucayali", "UCXPort".lower()),
    ],
)
def test_a_hull_for_unreal_that_a_mesh_takes_is_none(tmp_path: Path, nodes: tuple[str, ...]) -> None:
    assert findings_of(tmp_path, "unreal", *nodes) == []


@pytest.mark.parametrize(("name", "mark"), [("UCX-Gate_00", "UCX_"), ("UXC_Gate_00", "UCX_"), ("UBX.Gate", "UBX_")])
def test_a_prefix_that_is_misspelt_is_an_error(tmp_path: Path, name: str, mark: str) -> None:
    (finding,) = findings_of(tmp_path, "unreal", "Gate", "UCX_Gate_00", name)
    assert (finding.severity, finding.remedy) == ("error", f"Is {mark} meant? Spell it so.")


@pytest.mark.parametrize(
    ("name", "mark"),
    [
        ("Gate-convcolony", "-convcolonly"),
        ("Gate_ConvColOny.001", "-convcolonly"),
        ("Gate-conv-colonlly", "-convcolonly"),
        ("Gateconvcolonly", "-convcolonly"),
        ("Gate-colnly", "-colonly"),
        ("Gate-concol", "-convcol"),
    ],
)
def test_a_suffix_that_godot_does_not_know_is_an_error(tmp_path: Path, name: str, mark: str) -> None:
    (finding,) = findings_of(tmp_path, "godot", "Post", "Post2-convcolonly", name)
    assert (finding.severity, finding.remedy) == ("error", f"Is {mark} meant? Spell it so.")


def test_words_that_only_look_like_marks_are_none(tmp_path: Path) -> None:
    names = ("Gate-convcolonly", "Post-col", "Ant-color", "a_column", "b-control", "c-collection", "d-conveyor", "colt")
    assert findings_of(tmp_path, "godot", *names) == []
    plain = [name for name in names if name not in ("Gate-convcolonly", "Post-col")]
    assert findings_of(tmp_path, "unity", *plain, parents=("Gate_colliders", "colours", "Gate_collection")) == []


@pytest.mark.parametrize("parent", ["Gate_coliders", "Gate_collider", "Gate-colliders"])
def test_a_parent_that_does_not_say_that_its_parts_collide_is_an_error_for_unity(tmp_path: Path, parent: str) -> None:
    (finding,) = findings_of(tmp_path, "unity", "Gate", parents=(parent,))
    assert finding.message == f"{parent}: its name marks no collision"
    assert finding.remedy == "Is _colliders meant? Spell it so."


def test_a_hull_without_any_mesh_is_an_error(tmp_path: Path) -> None:
    (finding,) = findings_of(tmp_path, "unreal", "UCX_Gate_00")
    assert finding.remedy == "There is no mesh to be seen: add Gate."


def test_a_hull_that_an_edit_took_away_is_no_error(tmp_path: Path) -> None:
    mesh = load(write_nodes(tmp_path / "gate.glb", dict.fromkeys(("Gate", "UCX_Gate_00", "UCX_Fence_00"), box())))
    left = mesh.with_hulls(hull for hull in mesh.hulls if hull.name != "UCX_Fence_00")
    assert [one.rule for one in check(left, "unreal")] == []


def test_the_command_fails_and_says_what_to_do(run: Run, tmp_path: Path) -> None:
    path = write_nodes(tmp_path / "gate.glb", {"Gate": box(), "UCX_Fence_00": box()})
    done = run("check", str(path), "--engine", "unreal")
    assert done.code == 1
    assert "error MF212: UCX_Fence_00: no mesh is called Fence, so that in Unreal nothing collides by it" in done.out
    assert "The nearest mesh is Gate: call it UCX_Gate_00." in done.out


MARKS: tuple[EngineName, ...] = ("unreal", "godot", "unity")


@pytest.mark.parametrize(
    ("names", "marks"), [(("Gate", "UCX_Gate_00"), "unreal"), (("Gate", "Gate-convcolonly"), "godot")]
)
def test_marks_of_another_engine_are_an_error(tmp_path: Path, names: tuple[str, str], marks: str) -> None:
    mesh = load(write_nodes(tmp_path / "gate.glb", dict.fromkeys(names, box())))
    for engine in MARKS:
        told = [one for one in check(mesh, engine) if one.rule == f"{engine}-name"]
        if engine == marks:
            assert not told
            continue
        (finding,) = told
        title, other = engine.capitalize(), marks.capitalize()
        assert (finding.severity, finding.hulls) == ("error", (names[1],))
        assert finding.message == f"{names[1]}: {title} takes no mark of {other}, so that nothing collides by it"
        assert finding.remedy == f"Mark it for {title}: meshforge convert FILE OUT --names {engine}."
        save(mesh, tmp_path / f"{engine}.glb", names=engine)
        assert not [one for one in check(load(tmp_path / f"{engine}.glb"), engine) if one.severity == "error"]


def test_a_file_with_marks_of_several_engines_is_right_for_each(tmp_path: Path) -> None:
    names = ("Gate", "UCX_Gate_00", "Gate-convcolonly")
    mesh = load(write_nodes(tmp_path / "gate.glb", dict.fromkeys(names, box()), ("Gate_colliders",)))
    for engine in MARKS:
        assert not [one for one in check(mesh, engine) if one.rule == f"{engine}-name"]
