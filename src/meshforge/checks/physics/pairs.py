"""Pairs of bodies that reach into each other, at rest or as a joint moves: proposed to be excluded from contact, drawn,
and excluded where a person names them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Any

from meshforge.checks.base import CheckFindings, CheckSubject, Measure, MeasureCheck
from meshforge.checks.physics.mechanism import JointTree
from meshforge.checks.physics.overlaps import DEEP, NEARLY, find_body_overlaps, list_sweeps, measure_near
from meshforge.checks.physics.scene import mm
from meshforge.checks.physics.simulation import BODIES, HULLS
from meshforge.common import AssetError, UsageError, join_names, pluralize, require_mujoco, suggest_among
from meshforge.symbolic import SymbolicMesh

if TYPE_CHECKING:
    from PIL.Image import Image

    from meshforge.rendering import LengthUnit

ALL = "all"
"""What stands for all proposals but those that may hide a fault."""
_MOST_DRAWN = 12


@dataclass(frozen=True, slots=True)
class PairProposal:
    """Two bodies that may be excluded from contact; hulls: where they are deepest in each other; depth: there [m].

    where: `at rest`, or as which joint moves, and from where on; fault: why to exclude them may hide one, or empty.
    """

    bodies: tuple[str, str]
    hulls: tuple[str, str]
    depth: float
    where: str
    fault: str = ""

    def __str__(self) -> str:
        reason = f"; not in `all`: {self.fault}" if self.fault else ""
        return f"{':'.join(self.bodies)} {self.where}, {self.hulls[0]} is {mm(self.depth)} in {self.hulls[1]}{reason}"


@dataclass(frozen=True, eq=False, slots=True)
class PairProposals(Measure):
    """What may be excluded from contact, the deepest first."""

    pairs: tuple[PairProposal, ...]

    @property
    def description(self) -> str:
        if not self.pairs:
            return "no bodies reach into each other, at rest or as joints move"
        head = f"{pluralize(len(self.pairs), 'pair')} of bodies could be excluded from contact:"
        return "\n".join([head, *(f"    - {pair}" for pair in self.pairs)])

    def to_json(self) -> dict[str, Any]:
        """Return the pairs as JSON-able data; depths in metres."""
        return {"proposed": [asdict(pair) for pair in self.pairs]}

    def draw(
        self, mesh: SymbolicMesh, name: str, size: tuple[int, int], unit: LengthUnit
    ) -> Iterator[tuple[str, str, Image]]:
        from meshforge.rendering import render  # lazy: only pictures need it

        for k, pair in enumerate(self.pairs[:_MOST_DRAWN], 1):
            hulls = frozenset(hull.name for hull in mesh.hulls if hull.body in pair.bodies)
            shown = render(mesh, size=size, highlight=hulls, title=" and ".join(pair.bodies), caption=pair.where)
            yield f"{name}-{k}", str(pair), shown


class PairsCheck(MeasureCheck):
    """Which pairs of bodies may be excluded from contact."""

    name = "pairs"
    compares = False

    def measure(self, subject: CheckSubject) -> CheckFindings:
        try:
            return CheckFindings((), {self.name: PairProposals(propose_pairs(subject.sound))})
        except AssetError as error:
            return CheckFindings(notes=(error.problem,))


def propose_pairs(mesh: SymbolicMesh) -> tuple[PairProposal, ...]:
    """Return the pairs of bodies that reach into each other by more than 0.5% of the diagonal, at rest or as one joint
    goes through its limits while the others are at rest, and that the file lets touch; the deepest first.

    What is around the axis of a hinge counts, too. Raises AssetError where MuJoCo refuses the mesh, or it has more
    hulls or bodies than are simulated; MeshForgeError where MuJoCo is not installed.
    """
    require_mujoco("the check of pairs")
    where, tree = str(mesh.asset.path) if mesh.asset else "", JointTree.of(mesh)
    if len({hull.body for hull in mesh.hulls}) < 2:
        return ()
    if len(mesh.hulls) > HULLS or len(tree.bodies) > BODIES:
        problem = f"no pairs are proposed: it has more than {HULLS:,} hulls or {BODIES:,} bodies"
        raise AssetError(problem, where=where, remedy="Name the pairs yourself: --exclude BODY:BODY.")
    try:
        return _find_pairs(mesh, tree, DEEP * mesh.diagonal)
    except ValueError as error:  # MuJoCo's compiler
        reason = str(error).splitlines()[0].removeprefix("Error: ")
        raise AssetError(f"no pairs are proposed: MuJoCo refuses it: {reason}", where=where) from None


def _find_pairs(mesh: SymbolicMesh, tree: JointTree, least: float) -> tuple[PairProposal, ...]:
    overlaps, found = find_body_overlaps(mesh, tree), dict[frozenset[str], PairProposal]()
    wrong = {frozenset(one.bodies) for one in overlaps if one.is_wrong(mesh.diagonal)}
    for overlap in overlaps:
        if overlap.depth > least and not overlap.excluded:
            fault = "`--physics` finds an error in it" if frozenset(overlap.bodies) in wrong else ""
            pair = PairProposal(overlap.bodies, overlap.hulls, overlap.depth, "at rest", fault)
            found.setdefault(frozenset(overlap.bodies), pair)
    for pair in _list_swept(mesh, tree, least):
        first = found.setdefault(frozenset(pair.bodies), pair)
        deeper = max(first, pair, key=lambda one: one.depth)
        found[frozenset(pair.bodies)] = replace(deeper, where=first.where, fault=first.fault or pair.fault)
    return tuple(sorted(found.values(), key=lambda pair: (-pair.depth, pair.bodies)))


def _list_swept(mesh: SymbolicMesh, tree: JointTree, least: float) -> Iterator[PairProposal]:
    """Pairs that meet as joints move, again and again, each joint from rest on."""
    from meshforge.checks.physics.motion import describe_place  # lazy: MuJoCo takes 0.3 s

    rigid, bodies = tree.rigid_roots(), {hull.name: hull.body for hull in mesh.hulls}
    for sweep in list_sweeps(mesh, tree, least):
        joint, near, known = sweep.joint, measure_near(sweep.joint, sweep.moving), set[frozenset[str]]()
        for at, touches in sweep.looks:
            known |= {touch.pair for touch in touches} if at == sweep.start else set()
            where = f"as {joint.name or joint.child} moves, {describe_place(at, sweep.motion)} and on"
            for touch in touches:
                hulls = [name.rpartition(" (")[0] for name in (touch.mover, touch.other)]
                own, other = (bodies[name] for name in hulls)
                alone = {rigid[own], rigid[other]} == {rigid[joint.child], rigid[joint.parent]}
                early = abs(at - sweep.start) < NEARLY * abs(sweep.end - sweep.start)
                stops = early and touch.pair not in known and joint.measure_distance(touch.at[None]) > near
                fault = f"it stops {joint.name or joint.child} on its way" if stops else ""
                fault = fault if alone else "they are no neighbours, so that the contact may be meant"
                yield PairProposal((own, other), (hulls[0], hulls[1]), touch.depth, where, fault)


def exclude_pairs(mesh: SymbolicMesh, wanted: Sequence[str]) -> tuple[SymbolicMesh, tuple[str, ...]]:
    """Return a mesh whose bodies of some pairs never touch, and these pairs; those that never did are left out.

    wanted: `BODY:BODY`, or `all` for all that `propose_pairs` has and that hide no fault. Raises UsageError for a body
    that is not there, others as `propose_pairs`.
    """
    asset = mesh.asset
    if asset is None or not wanted:
        return mesh, ()
    names = {body.name for body in asset.bodies}
    chosen = [pair.bodies for pair in propose_pairs(mesh) if not pair.fault] if ALL in wanted else []
    chosen += [_parse_pair(text, names) for text in wanted if text != ALL]
    known = {frozenset(pair) for pair in asset.mechanism.apart}
    new = tuple({frozenset(pair): pair for pair in chosen if frozenset(pair) not in known}.values())
    both = replace(asset.mechanism, apart=(*asset.mechanism.apart, *new), added=(*asset.mechanism.added, *new))
    return replace(mesh, asset=replace(asset, mechanism=both)), tuple(":".join(pair) for pair in new)


def _parse_pair(text: str, names: set[str]) -> tuple[str, str]:
    """The two bodies of `BODY:BODY`, whose names may have colons themselves."""
    parts = text.split(":")
    ways = [(":".join(parts[:k]), ":".join(parts[k:])) for k in range(1, len(parts))]
    pair = next((way for way in ways if names.issuperset(way)), None)
    if pair and pair[0] != pair[1]:
        return pair
    wrong = next((name for name in (ways[0] if ways else (text,)) if name not in names), None)
    problem = f"there is no body {wrong!r}" if wrong else "it needs two bodies"
    near = suggest_among(wrong, sorted(names), "Bodies are") if wrong else f"Bodies are: {join_names(sorted(names))}."
    raise UsageError(f"--exclude {text}: {problem}", remedy=f"Write it so: BODY:BODY, or {ALL}. {near}")
