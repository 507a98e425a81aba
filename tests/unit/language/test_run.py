"""Running programs: orientation, rules in order, the trace, and what can go wrong."""

from pathlib import Path

import numpy as np
import pytest

from meshforge.common import GeometryError, MeshForgeError, ProgramError
from meshforge.geometry import Box, Pose, convex_hull
from meshforge.language import Delete, Is, Program, Rule
from meshforge.symbolic import Asset, Body, Document, Geom, Label, SymbolicMesh
from tests.unit.language.scenes import box, hull, mesh, table, wedge

TABLES = """
labels panel, leg, misc
orient +Z: Is(leg) -> Is(panel)
Is(misc)  => Delete
Is(panel) => Replace(box)
Is(leg)   => Each(Merge) as leg
"""


def lying() -> SymbolicMesh:
    """The table on its side, turned by 30 degrees as well."""
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    side = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]) @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])
    return table().with_hulls(h.move(Pose(side, np.array([1.0, 2, 3]))) for h in table().hulls)


def test_the_rules_run_in_order_and_the_trace_tells_what_each_did() -> None:
    result = Program.parse(TABLES).run(table())
    legs = tuple(h.name for h in table().hulls if h.label == "leg")
    assert [(t.rule, t.selected, t.made) for t in result.trace] == [
        (1, ("splinter",), ()),
        (2, ("top",), ("top~1",)),
        (3, legs, tuple(f"leg{k}_high~1" for k in range(4))),
    ]
    assert len(result.mesh.hulls) == 5


def test_the_trace_says_why_a_rule_made_nothing() -> None:
    trace = Program.parse("Is(misc) => Delete\nIs(leg) => Delete\nIs(leg) => Merge\nAll => Merge").run(table()).trace
    assert [(t.rule, t.selected, t.made, t.note, t.sources) for t in trace[2:]] == [
        (3, (), (), "nothing selected", ()),
        (4, ("top",), (), None, ()),
    ]


def test_the_edited_mesh_lies_where_the_mesh_lay() -> None:
    scene = lying()
    result = Program.parse(TABLES).run(scene)
    for before, after in zip(scene.hulls[1::2], result.mesh.hulls[1:], strict=False):
        assert np.linalg.norm(before.shape.centroid - after.shape.centroid) < 0.5
    top = result.mesh.hull_of("top~1").shape
    assert isinstance(top, Box) and np.allclose(sorted(top.half), [0.05, 0.5, 1.0])
    assert np.allclose(top.centroid, scene.hull_of("top").shape.centroid)


def test_a_program_that_changes_nothing_gives_back_the_very_mesh() -> None:
    scene = lying()
    program = Program.parse("labels leg, panel, door\norient +Z: Is(leg) -> Is(panel)\nIs(door) => Delete")
    assert program.run(scene).mesh is scene


def test_contact_is_measured_by_the_mesh_before_the_first_rule() -> None:
    """Deleting a far splinter does not cut apart what was joined."""
    scene = mesh(
        hull("a", box([0, 0, 0], [1, 1, 1]), "x"),
        hull("b", box([1.01, 0, 0], [2, 1, 1]), "x"),
        hull("far", box([10, 0, 0], [11, 1, 1]), "misc"),
    )
    result = Program.parse("Is(misc) => Delete\nIs(x) => Each(Merge)").run(scene)
    assert result.trace[1].made == ("a~1",)
    assert Program.parse("Is(x) => Each(Merge)").run(scene.with_hulls(scene.hulls[:2])).trace[0].made == ()


def test_thresholds_of_the_program_count() -> None:
    scene = mesh(hull("a", box([0, 0, 0], [1, 1, 1]), "x"), hull("b", box([1.5, 0, 0], [2.5, 1, 1.2]), "x"))
    assert Program.parse("contact 0.5\nIs(x) => Each(Merge)").run(scene).trace[0].made == ("b~1",)
    geo = "Geo(Is(x), +Z) => Delete"
    assert Program.parse(geo).run(scene).trace[0].selected == ("b",)
    assert Program.parse(f"extremity 0.1\n{geo}").run(scene).trace[0].selected == ("a", "b")
    assert Program.parse("contact 0.5\nAll => Scale(all, 2)").run(scene).mesh.epsilon == scene.epsilon


def test_edges_are_those_of_the_mesh_as_it_stands() -> None:
    scene = mesh(
        hull("a", box([0, 0, 0], [1, 1, 1]), "x"),
        hull("b", box([1, 0, 0], [2, 1, 1]), "bridge"),
        hull("c", box([2, 0, 0], [3, 1, 1]), "x"),
    )
    trace = (
        Program.parse("Attach(Is(x), Is(bridge)) => Each(Scale(X, 0.5))\nAttach(Is(x), All) => Delete").run(scene).trace
    )
    assert trace[0].selected == ("a", "c") and trace[1].selected == ()


def test_an_asset_without_labels_fails_under_a_program_that_asks_for_them() -> None:
    bare = mesh(hull("a", box([0, 0, 0], [1, 1, 1])))
    with pytest.raises(ProgramError, match="no labels"):
        Program.parse("Is(leg) => Delete").run(bare)
    with pytest.raises(ProgramError, match="no labels"):
        Program.parse("orient +Z: All -> Is(leg)").run(bare)
    assert Program.parse("All => Delete").run(bare).mesh.hulls == ()
    assert Program.parse("All => Scale(X, 2) as leg").run(bare).mesh.hulls[0].label == "leg"


def test_a_missing_template_fails_even_where_nothing_is_selected() -> None:
    program = Program.parse('Geo(Is(door), +X) => Add(+X, "knob.obj")')
    with pytest.raises(ProgramError, match=r'no template "knob.obj" \(templates given: wedge.obj\)'):
        program.run(table(), {"wedge.obj": wedge()})


def test_a_hull_that_cannot_be_is_refused_by_name() -> None:
    scene = mesh(hull("a", convex_hull(wedge().shapes[0].vertices), "leg"))
    with pytest.raises(GeometryError, match="a: a coordinate is not a finite number"):
        Program.parse("All => Scale(all, 1e300)").run(scene)


def in_file(scene: SymbolicMesh) -> SymbolicMesh:
    geoms = tuple(Geom(h.name, h.body, h.shape) for h in scene.hulls)
    asset = Asset(Path("table.urdf"), "urdf", (Body("body", Pose.identity()),), geoms, Document())
    return SymbolicMesh.of(asset, {h.name: h.annotation for h in scene.hulls if h.annotation})


def test_an_error_is_about_the_file_of_the_mesh() -> None:
    with pytest.raises(MeshForgeError) as error:
        Program.parse("orient +Z: All -> Is(door)").run(in_file(table()))
    assert error.value.where == "table.urdf"


def test_names_of_the_file_are_not_given_again_though_their_hulls_are_gone() -> None:
    scene = in_file(mesh(hull("a", box([0, 0, 0], [1, 1, 1])), hull("a~1", box([1, 0, 0], [2, 1, 1]), "misc")))
    rest = Program.parse("Is(misc) => Delete").run(scene).mesh
    assert Program.parse("All => Scale(X, 2)").run(rest).trace[0].made == ("a~2",)


def test_an_edited_mesh_lowers_to_an_asset_whose_made_geoms_name_their_parent() -> None:
    geoms = Program.parse(TABLES).run(in_file(table())).mesh.to_asset().geoms
    assert [(g.name, g.parent) for g in geoms][:2] == [("top", "top"), ("leg0_high~1", "leg0_high")]


def test_a_replay_gives_the_mesh_that_each_rule_meets() -> None:
    program = Program.parse(TABLES)
    scene = lying()
    first, *later = program.replay(scene, {})
    assert first.mesh.scale == first.mesh.diagonal
    for replay, line in zip([first, *later], program.run(scene).trace, strict=False):
        assert set(line.selected) <= replay.mesh.index.keys()
        assert replay.number == line.rule
    assert [h.name for h in later[-1].edited.hulls] == [h.name for h in program.run(scene).mesh.hulls]


def test_a_label_set_by_the_program_is_sure_and_one_taken_over_is_as_sure_as_before() -> None:
    scene = table().with_labels({"top": Label("panel", 0.3, "vlm")})
    made = Program.parse("Is(panel) => Scale(X, 2)\nIs(leg) => Merge as foot").run(scene).mesh
    assert made.hull_of("top~1").annotation == Label("panel", 0.3, "edit")
    assert made.hull_of("leg0_high~1").annotation == Label("foot", 1.0, "edit")


def test_a_program_is_a_value() -> None:
    rule = Rule(Is("leg"), Delete())
    assert Program(("leg",), None, (rule,)) == Program(rules=(rule,)) == Program.parse("Is(leg) => Delete  # why")
    assert hash(Program(rules=(rule,))) == hash(Program.parse("Is(leg) => Delete"))
