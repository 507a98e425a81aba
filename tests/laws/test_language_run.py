"""Laws of running programs: what comes out is sound, and what is not edited is untouched."""

import itertools
import re
from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from meshforge.common import MeshForgeError
from meshforge.geometry import Shape, digest
from meshforge.language import All, Delete, Each, Is, Merge, Program, Rule, Scale, select_mask
from meshforge.language.actions.base import Axis
from meshforge.symbolic import Hull, SymbolicMesh
from meshforge.synthesis import memoize
from tests.examples import examples
from tests.strategies import TEMPLATES, VOCABULARY, meshes, programs, rules, seeds, shape_of
from tests.unit.language.scenes import apply_action

DIRECTIONS = np.array([d for d in itertools.product((-1.0, 0.0, 1.0), repeat=3) if any(d)])


def supports(shape: Shape) -> list[float]:
    return [float(shape.support(d) @ d) for d in DIRECTIONS]


def alike(a: Shape, b: Shape, tolerance: float) -> bool:
    """Whether two shapes reach equally far in many directions and have one volume."""
    near = np.abs(np.subtract(supports(a), supports(b))).max() <= tolerance
    return bool(near) and bool(np.isclose(a.volume, b.volume, rtol=1e-6, atol=tolerance**3))


def assert_sound(shape: Shape) -> None:
    vertices, faces = shape.vertices, shape.faces
    assert np.isfinite(vertices).all() and shape.volume > 0
    edges = Counter((int(a), int(b)) for f in faces for a, b in zip(f, np.roll(f, -1), strict=True))
    assert set(edges.values()) == {1} and all((b, a) in edges for a, b in edges)
    polytope = shape.tessellate()
    size = float(np.ptp(vertices, axis=0).max())
    hull = ConvexHull(vertices / size, qhull_options="QJ Pp" if np.ptp(vertices, axis=0).min() < 1e-3 * size else "")
    assert np.isclose(hull.volume, polytope.volume / size**3, rtol=1e-6, atol=1e-6)


@given(meshes(), programs(VOCABULARY, st.none()))
@examples(100)
def test_every_hull_made_is_sound_one_that_no_rule_touches_is_the_same(mesh: SymbolicMesh, program: Program) -> None:
    if program.labels_asked and not mesh.labels:
        return
    result = program.run(mesh, TEMPLATES)
    for hull in result.mesh.hulls:
        assert_sound(hull.shape)
    assert len({hull.name for hull in result.mesh.hulls}) == len(result.mesh.hulls)
    selected = {name for rule in result.trace for name in rule.selected}
    after = {hull.name: hull for hull in result.mesh.hulls}
    for hull in mesh.hulls:
        if hull.name not in selected:
            assert after[hull.name] is hull
        elif hull.name in after:
            assert after[hull.name].shape is hull.shape and after[hull.name].parent is None
    made = [hull for name, hull in after.items() if name not in mesh.index]
    assert all(hull.parent in mesh.index for hull in made)
    if result.mesh.hulls == mesh.hulls:
        assert result.mesh is mesh
    assert result.mesh.scale is None and result.mesh.epsilon == mesh.epsilon


@given(meshes(), st.lists(programs(VOCABULARY), min_size=1, max_size=3))
@examples(25)
def test_runs_that_keep_what_was_made_come_to_the_same(mesh: SymbolicMesh, some: list[Program]) -> None:
    for program in [*some, *some]:
        try:
            wanted = program.run(mesh, TEMPLATES)
        except MeshForgeError as error:
            with pytest.raises(type(error), match=re.escape(error.message)):
                program.run(mesh, TEMPLATES, memo=memoize)
            continue
        found = program.run(mesh, TEMPLATES, memo=memoize)
        assert found.trace == wanted.trace
        assert [(h.name, h.body, h.annotation, h.parent) for h in found.mesh.hulls] == [
            (h.name, h.body, h.annotation, h.parent) for h in wanted.mesh.hulls
        ]
        for one, other in zip(found.mesh.hulls, wanted.mesh.hulls, strict=True):
            assert digest(one.shape) == digest(other.shape)


@given(meshes(), st.lists(rules(), max_size=3))
@examples(80)
def test_a_program_is_its_rules_one_after_the_other(mesh: SymbolicMesh, given_rules: list[Rule]) -> None:
    """Names of made hulls follow each other, so that later rules may count on them."""
    program = Program(VOCABULARY, None, tuple(given_rules))
    if program.labels_asked and not mesh.labels:
        return
    trace = program.run(mesh, TEMPLATES).trace
    made = [name for rule in trace for name in rule.made]
    assert len(set(made)) == len(made) and not set(made) & set(mesh.index)
    known = set(mesh.index)
    for rule in trace:
        assert set(rule.selected) <= known
        assert len(rule.sources) == len(rule.made)
        assert all(set(sources) <= set(rule.selected) for sources in rule.sources)
        known |= set(rule.made)


@given(meshes(max_size=6))
@examples(60)
def test_merge_is_idempotent(mesh: SymbolicMesh) -> None:
    everything = select_mask(All(), mesh)
    once = apply_action(mesh, everything, Merge()).mesh
    twice = apply_action(once, select_mask(All(), once), Merge())
    assert twice.mesh is once and twice.made == ()
    assert len(once.hulls) == len({hull.body for hull in mesh.hulls})


@given(meshes(), st.sampled_from(VOCABULARY), rules())
@examples(80)
def test_a_rule_on_what_was_deleted_does_nothing(mesh: SymbolicMesh, label: str, rule: Rule) -> None:
    if not mesh.labels:
        return
    deleting = Rule(Is(label), Delete())
    after = Program(rules=(deleting, Rule(Is(label), rule.action))).run(mesh, TEMPLATES)
    assert after.trace[1].selected == () and after.trace[1].note == "nothing selected"
    assert after.mesh.hulls == Program(rules=(deleting,)).run(mesh).mesh.hulls


ANGULAR = st.builds(
    lambda kind, seed: shape_of(kind, np.random.default_rng(seed)), st.sampled_from(("box", "polytope")), seeds
)


@given(
    st.one_of(
        st.tuples(meshes(), st.just("all")),
        st.tuples(meshes(ANGULAR), st.sampled_from(("X", "Y", "Z"))),  # round ones become polytopes, which are others
    ),
    st.floats(0.1, 10.0),
)
@examples(80)
def test_scaling_by_a_factor_and_back_is_the_identity(scene: tuple[SymbolicMesh, Axis], factor: float) -> None:
    mesh, axis = scene
    there_and_back = (Rule(All(), Scale(axis, factor)), Rule(All(), Scale(axis, 1 / factor)))
    result = Program(rules=there_and_back).run(mesh)
    for before, after in zip(mesh.hulls, result.mesh.hulls, strict=True):
        same_kind = before.shape.kind == after.shape.kind
        one, two = (hull.shape if same_kind else hull.shape.tessellate() for hull in (before, after))
        assert alike(one, two, tolerance=1e-9 * mesh.diagonal * max(factor, 1 / factor))
        assert (after.label, after.body, after.parent) == (before.label, before.body, before.name)


@given(meshes())
@examples(60)
def test_merging_each_component_covers_it_and_no_more(mesh: SymbolicMesh) -> None:
    action = Each(Merge())
    mask = select_mask(All(), mesh)
    applied = apply_action(mesh, mask, action)
    groups = [[mesh.hulls[k] for k in range(len(mesh.hulls)) if part >> k & 1] for part in action.groups(mesh, mask)]
    several = [group for group in groups if len(group) > 1]
    assert len(applied.made) == len(several) and len(applied.mesh.hulls) == len(groups)
    for name, group in zip(applied.made, several, strict=True):
        assert_hull_of(applied.mesh.hull_of(name), group, mesh.diagonal)


def assert_hull_of(made: Hull, group: list[Hull], diagonal: float) -> None:
    reach = [supports(hull.shape.tessellate()) for hull in group]
    assert np.abs(np.max(reach, axis=0) - supports(made.shape)).max() <= 2e-4 * diagonal
    assert made.body == group[0].body
