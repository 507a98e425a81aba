"""What holds of every contact graph: it is that of brute force, in any frame, and edits keep it true."""

import numpy as np
import pytest
from hypothesis import given

from meshforge.geometry import Floats, distance
from meshforge.symbolic import Hull, SymbolicMesh
from tests.examples import examples
from tests.shape_strategies import KINDS, generators, shape

LAW = examples(60)
CLEAR = 1e-6  # gaps this close to the threshold, as a share of the diagonal, may fall on either side


def random_mesh(rng: np.random.Generator, count: int) -> SymbolicMesh:
    """Hulls of all kinds, some of them touching, in two bodies; the threshold is large, for many near misses."""
    hulls = []
    for k in range(count):
        made = shape(str(rng.choice(KINDS)), rng, spread=0.4)
        hulls.append(Hull(f"h{k}", str(rng.choice(["base", "door"])), made))
    return SymbolicMesh(tuple(hulls), epsilon=0.03)


def mapped(mesh: SymbolicMesh, linear: Floats, offset: Floats) -> SymbolicMesh:
    hulls = [Hull(h.name, h.body, h.shape.transform(linear, offset)) for h in mesh.hulls]
    return SymbolicMesh(tuple(hulls), epsilon=mesh.epsilon)


def doubtful_pairs(mesh: SymbolicMesh) -> set[tuple[int, int]]:
    slack = CLEAR * mesh.diagonal
    return {pair for pair, gap in mesh.graph.items() if abs(gap - mesh.contact_distance) <= slack}


@LAW
@given(rng=generators())
def test_contacts_and_neighbours_are_those_of_brute_force(rng: np.random.Generator) -> None:
    mesh = random_mesh(rng, 9)
    doubtful = doubtful_pairs(mesh)
    exact = {
        (i, j)
        for i in range(9)
        for j in range(i + 1, 9)
        if distance(mesh.hulls[i].shape, mesh.hulls[j].shape) <= mesh.epsilon * mesh.diagonal
    }
    assert set(mesh.contacts) - doubtful == exact - doubtful
    assert {(min(i, j), max(i, j)) for i in range(9) for j in mesh.neighbours(i)} == mesh.contacts
    assert all(i in mesh.neighbours(j) and i != j for i in range(9) for j in mesh.neighbours(i))


@LAW
@given(rng=generators())
def test_contacts_do_not_depend_on_place_size_or_order_of_axes(rng: np.random.Generator) -> None:
    mesh = random_mesh(rng, 8)
    doubtful = doubtful_pairs(mesh)
    swap = np.eye(3)[rng.permutation(3)] * rng.choice([-1.0, 1.0], size=(3, 1))
    image = mapped(mesh, swap * 10.0 ** rng.uniform(-3, 3), rng.normal(size=3))
    assert set(image.contacts) - doubtful == set(mesh.contacts) - doubtful


@LAW
@given(rng=generators())
def test_near_misses_are_the_pairs_beyond_contact_within_three_times_its_distance(rng: np.random.Generator) -> None:
    mesh = random_mesh(rng, 8)
    for i, j, gap in mesh.near_misses:
        assert mesh.contact_distance < gap <= 3 * mesh.contact_distance
        assert gap == pytest.approx(distance(mesh.hulls[i].shape, mesh.hulls[j].shape), abs=CLEAR * mesh.diagonal)
    assert [row[2] for row in mesh.near_misses] == sorted(row[2] for row in mesh.near_misses)


@LAW
@given(rng=generators())
def test_a_graph_carried_through_an_edit_is_the_graph_made_anew(rng: np.random.Generator) -> None:
    mesh = random_mesh(rng, 10)
    mesh = SymbolicMesh(mesh.hulls, epsilon=mesh.epsilon, scale=mesh.diagonal)
    assert mesh.graph is not None
    kept = [mesh.hulls[k] for k in rng.permutation(10)[: int(rng.integers(0, 11))]]
    made = [Hull(f"m{k}", "base", shape("box", rng, spread=0.4)) for k in range(int(rng.integers(0, 4)))]
    hulls = [(kept + made)[k] for k in rng.permutation(len(kept) + len(made))]
    carried = mesh.with_hulls(hulls)
    anew = SymbolicMesh(tuple(hulls), epsilon=mesh.epsilon, scale=mesh.scale)
    assert carried.known_graph is not None
    assert list(carried.graph) == list(anew.graph)
    assert np.allclose(list(carried.graph.values()), list(anew.graph.values()), rtol=0, atol=CLEAR)
