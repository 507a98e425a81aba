"""Random shapes, meshes and programs for the laws (hypothesis strategies)."""

from __future__ import annotations

from typing import cast

import numpy as np
from hypothesis import strategies as st

from meshforge.geometry import Box, Floats, Polytope, Pose, Shape, Sphere, convex_hull
from meshforge.language import (
    AXES,
    DIRECTIONS,
    PRIMITIVES,
    Action,
    Add,
    All,
    Attach,
    BaseExtractor,
    Delete,
    Diff,
    Direction,
    Each,
    Extractor,
    Geo,
    Intersect,
    Is,
    LandmarkPair,
    Merge,
    Orient,
    Program,
    Replace,
    Rule,
    Scale,
    Template,
    Union,
)
from meshforge.symbolic import Hull, Label, SymbolicMesh
from tests.loads.readers.base import Place
from tests.shape_strategies import make_shape

VOCABULARY = ("panel", "leg", "handle", "drawer", "misc")
BODIES = ("base", "drawer_link")


def wedge(length: float = 1.0) -> Polytope:
    """A roof shape along X, which differs from its mirror images across Z only."""
    points = [[x * length, y, 0.0] for x in (0, 1) for y in (0, 1)] + [[0.0, 0.5, 0.7], [length, 0.5, 0.7]]
    return convex_hull(np.array(points))


TEMPLATES = {
    "bar.obj": Template((wedge(4.0),), "bar.obj"),
    "knob.obj": Template((wedge(), Sphere(Pose.of_translation([0.5, 0.5, 1.0]), 0.4)), "knob.obj"),
}
"""Two templates that random actions name: one hull, longest along X; and two hulls."""

seeds = st.integers(0, 2**32 - 1)
directions = st.sampled_from(DIRECTIONS)


def rotation_of(rng: np.random.Generator) -> Floats:
    """A random proper rotation (3, 3)."""
    w, *xyz = rng.normal(size=4)
    return Place.of_quaternion(np.zeros(3), (*xyz, w)).rotation


rotations = seeds.map(lambda seed: rotation_of(np.random.default_rng(seed)))


def shape_of(kind: str, rng: np.random.Generator) -> Shape:
    """A random shape of a kind, about half a metre in size, at most a metre off the origin."""
    pose = Pose(rotation_of(rng) if rng.random() < 0.5 else np.eye(3), rng.uniform(-1, 1, 3))
    sides = rng.uniform(0.05, 0.5, 3)
    return make_shape(kind, pose, sides, lambda: rng.uniform(-0.5, 0.5, (int(rng.integers(5, 13)), 3)))


KINDS = ("box", "sphere", "cylinder", "capsule", "ellipsoid", "polytope")
shapes = st.builds(lambda kind, seed: shape_of(kind, np.random.default_rng(seed)), st.sampled_from(KINDS), seeds)


@st.composite
def grid_boxes(draw: st.DrawFn) -> Shape:
    """A box on a coarse grid, so that boxes touch, coincide and tie often."""
    low = np.array([draw(st.integers(0, 4)) for _ in range(3)])
    size = np.array([draw(st.integers(1, 3)) for _ in range(3)])
    return Box(Pose.of_translation((low + size / 2) * 0.1), size * 0.05)


_ANY_SHAPE = shapes | grid_boxes()


@st.composite
def meshes(
    draw: st.DrawFn,
    shape: st.SearchStrategy[Shape] = _ANY_SHAPE,
    vocabulary: tuple[str, ...] = VOCABULARY,
    min_size: int = 1,
    max_size: int = 8,
) -> SymbolicMesh:
    """A mesh of a few labelled hulls in one or two bodies; some hulls have no label."""
    hulls = []
    for index in range(draw(st.integers(min_size, max_size))):
        label = draw(st.sampled_from((*vocabulary, None)))
        confidence = draw(st.sampled_from((0.5, 1.0)))
        annotation = Label(label, confidence, "vlm") if label else None
        hulls.append(Hull(f"h{index}", draw(st.sampled_from(BODIES)), draw(shape), annotation))
    return SymbolicMesh(tuple(hulls))


def bases(vocabulary: tuple[str, ...] = VOCABULARY) -> st.SearchStrategy[BaseExtractor]:
    """All, or Is of a label."""
    return st.one_of(st.just(All()), st.sampled_from(vocabulary).map(Is))


def extractors(vocabulary: tuple[str, ...] = VOCABULARY, max_leaves: int = 4) -> st.SearchStrategy[Extractor]:
    """Extractors of all kinds, set operators nested."""
    base = bases(vocabulary)
    leaf = st.one_of(base, st.builds(Attach, base, base), st.builds(Geo, base, directions))
    return cast(
        "st.SearchStrategy[Extractor]",
        st.recursive(
            leaf,
            lambda inner: st.one_of(
                st.builds(Union, inner, inner), st.builds(Intersect, inner, inner), st.builds(Diff, inner, inner)
            ),
            max_leaves=max_leaves,
        ),
    )


factors = st.one_of(st.sampled_from((0.5, 2.0, 1.0, 1.25)), st.floats(0.1, 10.0))


def simple_actions(factor: st.SearchStrategy[float] = factors, *, tight: bool = True) -> st.SearchStrategy[Action]:
    """Actions without Each, tight fits on request; template files are those of TEMPLATES."""
    files = st.sampled_from(sorted(TEMPLATES))
    fits = [st.builds(Replace, st.sampled_from(("box", "cylinder", "capsule")), st.just("tight"))] if tight else []
    return cast(
        "st.SearchStrategy[Action]",
        st.one_of(
            st.just(Delete()),
            st.just(Merge()),
            st.builds(Replace, st.sampled_from(PRIMITIVES)),
            *fits,
            st.builds(Replace, st.sampled_from(("cylinder", "capsule", "sphere")), st.just("native")),
            st.builds(Replace, files, st.sampled_from((None, "longest"))),
            st.builds(Add, directions, files, st.booleans()),
            st.builds(Scale, st.sampled_from(AXES), factor),
        ),
    )


def actions(factor: st.SearchStrategy[float] = factors, *, tight: bool = True) -> st.SearchStrategy[Action]:
    """Actions, also inside Each."""
    simple = simple_actions(factor, tight=tight)
    return st.one_of(simple, st.builds(Each, simple))


@st.composite
def rules(
    draw: st.DrawFn, vocabulary: tuple[str, ...] = VOCABULARY, action: st.SearchStrategy[Action] | None = None
) -> Rule:
    """A rule, some with `as LABEL`."""
    act = draw(actions() if action is None else action)
    label = draw(st.sampled_from((None, *vocabulary))) if act.makes_hulls else None
    return Rule(draw(extractors(vocabulary)), act, label)


@st.composite
def orients(draw: st.DrawFn, vocabulary: tuple[str, ...] = VOCABULARY) -> Orient:
    """A directive of one or two pairs, with or without snap."""
    letters = draw(st.lists(st.sampled_from("XYZ"), min_size=1, max_size=2, unique=True))
    signed = [f"{draw(st.sampled_from('+-'))}{letter}" for letter in letters]
    pairs = [LandmarkPair(cast("Direction", axis), draw(bases(vocabulary)), draw(bases(vocabulary))) for axis in signed]
    return Orient(tuple(pairs), draw(st.booleans()))


@st.composite
def programs(
    draw: st.DrawFn,
    vocabulary: tuple[str, ...] = VOCABULARY,
    orient: st.SearchStrategy[Orient | None] | None = None,
    action: st.SearchStrategy[Action] | None = None,
    max_rules: int = 4,
) -> Program:
    """A program that declares the vocabulary, with thresholds in some."""
    threshold = st.one_of(st.none(), st.floats(1e-6, 1.0))
    return Program(
        vocabulary,
        draw(st.none() | orients(vocabulary) if orient is None else orient),
        tuple(draw(st.lists(rules(vocabulary, action), max_size=max_rules))),
        draw(threshold),
        draw(threshold),
    )
