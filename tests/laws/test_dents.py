"""Laws of holes: none that a peg of 5% of the diagonal enters is closed; what is only rounded or rough is a hull."""

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from manifold3d import Manifold

from meshforge.geometry import Floats, convex_hull, split_pieces
from tests.examples import examples
from tests.unit.geometry.solids import block, surface

PEG = 0.05
SHARE = st.floats(0.0, 1.0)


@examples(150)
@given(
    size=st.tuples(st.floats(0.15, 1.0), st.floats(0.15, 1.0), st.floats(0.02, 1.0)),
    at=st.tuples(SHARE, SHARE),
    width=st.floats(1.0, 3.0),
    through=st.booleans(),
    depth=st.floats(1.0, 3.0),
    sides=st.sampled_from([4, 5, 24]),
    seed=st.integers(0, 999),
)
def test_no_hole_that_a_peg_enters_is_closed_in_silence(
    size: tuple[float, float, float],
    at: tuple[float, float],
    width: float,
    through: bool,
    depth: float,
    sides: int,
    seed: int,
) -> None:
    diagonal = float(np.linalg.norm(size))
    peg = PEG * diagonal
    radius = min(width * peg / 2, 0.4 * min(size[:2])) / np.cos(np.pi / sides)  # the peg fits between flat sides, too
    radius = max(radius, peg / 2 / np.cos(np.pi / sides))
    room = np.array(size[:2]) - 2.1 * radius
    assume(room.min() > 0 and (through or depth * peg < 0.95 * size[2]))
    x, y = (np.array(at) - 0.5) * room
    deep = 2 * size[2] if through else depth * peg
    hole = Manifold.cylinder(2 * deep, radius, radius, sides, True).translate((x, y, size[2] / 2))
    solid = (block(size, (0, 0, 0)) - hole).rotate((seed, 2 * seed, 3 * seed))
    assert all(piece.shape is None for piece in split_pieces(*surface(solid), name="solid"))


@examples(60)
@given(
    points=st.lists(st.tuples(SHARE, SHARE, SHARE), min_size=8, max_size=20),
    radius=st.floats(0.05, 0.3),
    noise=st.floats(0.0, 0.005),
    seed=st.integers(0, 999),
)
def test_rough_ones_stay_hulls(
    points: list[tuple[float, float, float]], radius: float, noise: float, seed: int
) -> None:
    ball = np.asarray(surface(Manifold.sphere(radius, 16))[0])
    around: Floats = (np.array(points)[:, None] + ball).reshape(-1, 3)
    hull = convex_hull(around)
    rough = np.random.default_rng(seed).normal(scale=noise * hull.aabb.size.min(), size=hull.vertices.shape)
    (piece,) = split_pieces(hull.vertices + np.clip(rough, -0.01, 0.01), hull.faces, name="hull")
    assert piece.shape is not None
