"""An asset put on a plane in MuJoCo: whether it rests, and which bodies reach into each other before anything moves."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from meshforge.checks.base import CheckFindings, CheckSubject, Measure, MeasureCheck
from meshforge.checks.legality import check_legality
from meshforge.checks.physics.mechanism import ContactRules, JointTree, check_masses
from meshforge.checks.physics.model import FLOOR, STEP, compile_model
from meshforge.common import join_names, pluralize, require_mujoco
from meshforge.engines import Finding
from meshforge.geometry import Floats
from meshforge.symbolic import SymbolicMesh

BEFORE = "physics_before"
"""The key of the physics of the hulls before an edit."""
SETTLE_SECONDS, WATCH_SECONDS = 6.0, 0.5
"""Seconds that an asset has at most to come to rest, and then is watched."""
JITTER = 0.005
"""Of the speed of a fall from the asset's own height, the share that counts as jitter at rest."""
DEEP = 0.005
"""Hulls of two bodies that reach into each other by more than this share of the diagonal are findings."""
TILT = 15.0
"""Degrees from which on an asset has fallen over."""
HULLS = 1000
"""Hulls of an asset at most; beyond, a simulation would take minutes."""
BODIES = 500
"""Bodies of an asset at most, for the same reason."""
_GRAVITY = 9.81
_STEPS, _START = round(WATCH_SECONDS / STEP), round(0.2 / STEP)


@dataclass(frozen=True, slots=True)
class Rest:
    """How an asset came to rest.

    jitter: root mean square of the speed of its shakiest body about its mean, at half its size from the centre [m/s];
    fastest: the highest speed of any body in the first 0.2 s [m/s]; moved: how far it wandered sideways [m];
    tilt: how far it turned from upright [degrees]; sunk: how deep it reaches into the plane at the end [m];
    mass: of all bodies, by the file, or of water where that tells none that can be [kg].
    """

    jitter: float
    fastest: float
    moved: float
    tilt: float
    sunk: float
    mass: float


@dataclass(frozen=True, eq=False, slots=True)
class Physics(Measure):
    """What MuJoCo says of an asset; rest: None where it could not be simulated, for the reason `refused`."""

    scale: float
    rest: Rest | None
    overlaps: tuple[BodyOverlap, ...]
    refused: str | None
    mass_problems: tuple[Finding, ...]

    @property
    def description(self) -> str:
        if self.rest is None:
            return f"not simulated: {self.refused}"
        rest = self.rest
        tilted = f"turned by {rest.tilt:.3g}°, moved by {rest.moved:.3g} m"
        excluded = sum(overlap.excluded for overlap in self.overlaps)
        allowed = f", {excluded} excluded by the file" if excluded else ""
        overlaps = f"{pluralize(len(self.overlaps), 'overlap')} of bodies{allowed}"
        return f"at rest it shakes by {rest.jitter:.2g} m/s; {tilted}; {overlaps}"

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What is odd, the masses first."""
        return (*self.mass_problems, *_report_start(self), *_report_unrest(self))

    def to_json(self) -> dict[str, Any]:
        """Return the behaviour as JSON-able data; lengths in metres, speeds in metres a second, angles in degrees."""
        return {
            "rest": asdict(self.rest) if self.rest else None,
            "refused": self.refused,
            "overlaps": [asdict(overlap) for overlap in self.overlaps],
        }


class PhysicsCheck(MeasureCheck):
    """How an asset comes to rest on a plane in MuJoCo, and overlaps of its bodies; of the mesh before an edit, too."""

    name = "physics"

    def measure(self, subject: CheckSubject) -> CheckFindings:
        now = simulate(subject.mesh)
        before = {BEFORE: simulate(subject.before)} if subject.before else {}
        return CheckFindings(now.findings, {self.name: now} | before)


def simulate(mesh: SymbolicMesh) -> Physics:
    """Return how a mesh behaves on a plane, with the masses of its file, or the density of water where there are none.

    The lowest point is put on the plane; roots may fall, joints move within their limits, damped. What an MJCF says of
    friction and contact bits is kept, and the pairs of bodies that an MJCF or a USD keeps apart. Deterministic: six
    seconds of simulation at most, and no clock. Raises MeshForgeError where MuJoCo is not installed.
    """
    require_mujoco("the check of physics")
    faulty, _ = check_legality(mesh)
    mass_problems = tuple(check_masses(mesh))
    sound = mesh.with_hulls(hull for hull in mesh.hulls if hull.name not in faulty) if faulty else mesh
    if not sound.hulls:
        return Physics(0.0, None, (), "there is no hull", mass_problems)
    if len(sound.hulls) > HULLS:
        return Physics(sound.diagonal, None, (), f"more than {HULLS:,} hulls", mass_problems)
    tree = JointTree.of(sound)
    if len(tree.bodies) > BODIES:
        return Physics(sound.diagonal, None, (), f"more than {BODIES:,} bodies", mass_problems)
    try:
        overlaps = find_body_overlaps(sound, tree)
        rest = _simulate_rest(sound, tree)
    except ValueError as error:  # MuJoCo's compiler
        reason = str(error).splitlines()[0].removeprefix("Error: ")
        return Physics(sound.diagonal, None, (), f"MuJoCo refuses it: {reason}", mass_problems)
    return Physics(sound.diagonal, rest, overlaps, None if rest else "the simulation blew up", mass_problems)


def _simulate_rest(mesh: SymbolicMesh, tree: JointTree) -> Rest | None:
    import mujoco  # lazy: 0.3 s, only the physics checks need it

    model = compile_model(mesh, tree)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    moving = np.arange(1, model.nbody)
    start, upright = data.xipos[moving].copy(), data.xmat[moving].reshape(-1, 3, 3).copy()
    reach = np.zeros(model.nbody)
    np.maximum.at(reach, model.geom_bodyid, model.geom_rbound)
    size = 2 * reach[moving]
    quiet = JITTER * np.sqrt(_GRAVITY * mesh.diagonal)
    fastest, restless = 0.0, 0
    watched: list[Floats] = []
    for step in range(round(SETTLE_SECONDS / STEP) + _STEPS):
        mujoco.mj_step(model, data)
        if any(data.warning[w].number for w in (mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQACC)):
            return None
        turning, going = np.split(data.cvel[moving], 2, axis=1)
        speeds = np.concatenate([going, turning * (size / 2)[:, None]], axis=1)  # (n, 6) [m/s]
        highest = float(np.abs(speeds).max())
        restless = step if highest > quiet else restless
        fastest = max(fastest, highest) if step < _START else fastest
        watched = [*watched[1 - _STEPS :], speeds]
        if step - restless >= _STEPS and step >= 2 * _STEPS:
            break
    shake = np.array(watched)
    jitter = float(np.sqrt(((shake - shake.mean(axis=0)) ** 2).sum(axis=2).mean(axis=0)).max())
    roots = [k for k, body in enumerate(moving) if model.body_parentid[body] == 0]
    ends = data.xmat[moving].reshape(-1, 3, 3)
    turned = [np.clip((upright[k] @ ends[k].T)[2, 2], -1, 1) for k in roots]
    moved = max(float(np.linalg.norm((data.xipos[moving][k] - start[k])[:2])) for k in roots)
    tilt, mass = float(np.degrees(np.arccos(min(turned)))), float(model.body_subtreemass[0])
    sunk = max((-float(c.dist) for c in data.contact[: data.ncon] if 0 in c.geom), default=0.0)
    return Rest(jitter, fastest, moved, tilt, sunk, mass)


def _report_start(found: Physics) -> Iterator[Finding]:
    """What is wrong before anything moves."""
    if found.refused and "blew up" in found.refused:
        message = "it does not come to rest: the simulation blew up"
        yield Finding("physics-unstable", "error", (), message, "Look at overlaps of bodies, masses and thin hulls.")
    elif found.refused and "refuses" in found.refused:
        yield Finding("physics-refused", "error", (), found.refused, "Fix what the message names.")
    deep = [overlap for overlap in found.overlaps if overlap.depth > DEEP * found.scale and not overlap.excluded]
    if not deep:
        return
    overlaps = [f"{o.hulls[0]} and {o.hulls[1]} ({o.depth:.3g} m{', joined' if o.joined else ''})" for o in deep]
    names = tuple(dict.fromkeys(name for overlap in deep for name in overlap.hulls))
    message = f"hulls of bodies that move against each other overlap at rest pose: {join_names(overlaps)}"
    remedy = "Shrink or delete one, or exclude the pair from contact in the file."
    yield Finding("physics-overlap", "warning", names, message, remedy)


def _report_unrest(found: Physics) -> Iterator[Finding]:
    rest = found.rest
    if rest is None:
        return
    fall = float(np.sqrt(_GRAVITY * found.scale))
    if rest.jitter > JITTER * fall:
        message = f"it shakes at rest, by {rest.jitter:.2g} m/s"
        yield Finding("physics-jitter", "warning", (), message, "Look at overlaps of bodies, thin hulls and the base.")
    if rest.fastest > fall:
        message = f"it is thrown apart at the start, at {rest.fastest:.2g} m/s"
        yield Finding("physics-thrown", "warning", (), message, "Hulls of different bodies overlap: shrink one.")
    if rest.tilt > TILT:
        message = f"it does not stand: it turned by {rest.tilt:.0f}°"
        yield Finding("physics-tilt", "warning", (), message, "Give it a flat base; or it is not meant to stand.")


@dataclass(frozen=True, slots=True)
class BodyOverlap:
    """Two bodies that reach into each other at rest pose; depth: at most [m]; joined: whether a joint holds them.

    excluded: whether the file lets these hulls pass through each other, so that it does no harm.
    """

    bodies: tuple[str, str]
    hulls: tuple[str, str]
    depth: float
    joined: bool
    excluded: bool = False


def find_body_overlaps(mesh: SymbolicMesh, tree: JointTree) -> tuple[BodyOverlap, ...]:
    """Return the deepest contact of each pair of bodies that can move against each other, at rest pose, deepest first.

    Contacts that the file excludes count for themselves. Raises ValueError where MuJoCo refuses the model.
    """
    import mujoco  # lazy: 0.3 s, only the physics checks need it

    model = compile_model(mesh, tree, everything=True)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    names = [model.geom(g).name for g in range(model.ngeom)]
    numbers = [-1 if name == FLOOR else int(name.rpartition(" ")[2]) for name in names]
    rigid, touching = tree.rigid_roots(), ContactRules(mesh)
    found: dict[tuple[str, str, bool], BodyOverlap] = {}
    for contact in data.contact[: data.ncon]:
        first, second = sorted(numbers[int(g)] for g in contact.geom)
        if first < 0 or contact.dist >= 0:
            continue
        a, b = mesh.hulls[first], mesh.hulls[second]
        excluded = not touching.may_touch(first, second)
        key = a.body, b.body, excluded
        if rigid[a.body] == rigid[b.body] or (key in found and found[key].depth >= -contact.dist):
            continue
        joined = tree.above.get(a.body) == b.body or tree.above.get(b.body) == a.body
        found[key] = BodyOverlap((a.body, b.body), (a.name, b.name), -float(contact.dist), joined, excluded)
    return tuple(sorted(found.values(), key=lambda overlap: (-overlap.depth, overlap.bodies)))
