"""An asset put on a plane in MuJoCo: whether it rests, and which bodies reach into each other before anything moves."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from meshforge.checks.base import LEAST_SIZE, MOST_SIZE, CheckFindings, CheckSubject, Measure, MeasureCheck
from meshforge.checks.legality import check_legality
from meshforge.checks.physics.mechanism import JointTree, check_masses
from meshforge.checks.physics.model import STEP, compile_model, pose_on_floor
from meshforge.checks.physics.overlaps import (
    DEEP,
    WITHOUT_BODIES,
    BodyOverlap,
    check_joints,
    check_loose_pieces,
    find_body_overlaps,
    report_overlaps,
)
from meshforge.common import GeometryError, join_names, pluralize, require_mujoco
from meshforge.engines import Finding, Severity
from meshforge.geometry import Floats, convex_hull
from meshforge.symbolic import Hull, SymbolicMesh

BEFORE = "physics_before"
"""The key of the physics of the hulls before an edit."""
SETTLE_SECONDS, WATCH_SECONDS = 6.0, 0.5
"""Seconds that an asset has at most to come to rest, and then is watched."""
JITTER = 0.005
"""Of the speed of a fall from the asset's own height, the share that counts as jitter at rest."""
APART = 0.05
"""Of the diagonal: a free body that moves farther from the heaviest one has come off."""
TILT, LEAN = 15.0, 5.0
"""Degrees from which on an asset has fallen over, and from which on it leans."""
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
    mass: of all bodies, by the file, or of water where that tells none that can be [kg]; apart: bodies that come off;
    may_lie: whether it may not be meant to stand: it falls as it is shown, too, or its file does not say what is up.
    """

    jitter: float
    fastest: float
    moved: float
    tilt: float
    sunk: float
    mass: float
    apart: tuple[str, ...] = ()
    may_lie: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class Physics(Measure):
    """What MuJoCo says of an asset; rest: None where it could not be simulated, for the reason `refused`."""

    scale: float
    rest: Rest | None
    overlaps: tuple[BodyOverlap, ...]
    refused: str | None
    mass_problems: tuple[Finding, ...]
    problems: tuple[Finding, ...] = ()

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
        return (*self.mass_problems, *_report_start(self), *self.problems, *_report_unrest(self))

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
        overlaps = tuple(one for one in find_body_overlaps(sound, tree) if not one.at_axis)
        rest = _simulate_rest(sound, tree)
        problems = (*check_joints(sound, tree, DEEP * sound.diagonal), *check_loose_pieces(sound, tree))
    except ValueError as error:  # MuJoCo's compiler
        reason = str(error).splitlines()[0].removeprefix("Error: ")
        return Physics(sound.diagonal, None, (), f"MuJoCo refuses it: {reason}", mass_problems)
    refused = None if rest else "the simulation blew up"
    return Physics(sound.diagonal, rest, overlaps, refused, mass_problems, problems)


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
    ways = data.xipos[moving][roots] - start[roots]
    heaviest = int(np.argmax(model.body_subtreemass[moving[roots]]))
    gone = np.linalg.norm(ways - ways[heaviest], axis=1) > APART * mesh.diagonal
    apart = tuple(model.body(int(moving[k])).name.removeprefix("body ") for k in np.array(roots)[gone])
    sunk = max((-float(c.dist) for c in data.contact[: data.ncon] if 0 in c.geom), default=0.0)
    return Rest(jitter, fastest, moved, tilt, sunk, mass, apart, tilt > TILT and _may_lie(mesh))


def _may_lie(mesh: SymbolicMesh) -> bool:
    """Whether nobody knows that a mesh is meant to stand: also by the convex hull of what is shown."""
    from meshforge.checks.physics.motion import try_stand  # lazy: MuJoCo takes 0.3 s

    surfaces = [surface.vertices[np.unique(surface.faces)] for surface in mesh.asset.visuals] if mesh.asset else []
    if not sum(map(len, surfaces)):
        return mesh.asset is not None and mesh.asset.format in WITHOUT_BODIES
    try:
        shown = convex_hull(pose_on_floor(mesh).apply(np.concatenate(surfaces)), name="what is shown")
    except GeometryError:
        return False
    return try_stand([Hull("shown", "", shown)], mesh.diagonal) is not None


def _report_start(found: Physics) -> Iterator[Finding]:
    """What is wrong before anything moves."""
    if found.refused and "blew up" in found.refused:
        message = "it does not come to rest: the simulation blew up"
        yield Finding("physics-unstable", "error", (), message, "Look at overlaps of bodies, masses and thin hulls.")
    elif found.refused and "refuses" in found.refused:
        yield Finding("physics-refused", "error", (), found.refused, "Fix what the message names.")
    if found.rest and not LEAST_SIZE <= found.scale <= MOST_SIZE:
        message = f"it is {found.scale:.3g} m large, so its file is probably in another unit"
        yield Finding("physics-size", "warning", (), message, "Write the file in metres, or scale it where it is used.")
    yield from report_overlaps(found.overlaps, found.scale)


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
    if rest.apart:
        message = f"it falls apart, as no joint holds {join_names(rest.apart)}"
        yield Finding("physics-apart", "error", (), message, "Join it by a joint, a fixed one where it does not move.")
    if rest.tilt > TILT:
        message = f"it does not stand: it turned by {rest.tilt:.0f}°"
        severity: Severity = "warning" if rest.may_lie else "error"
        yield Finding("physics-tilt", severity, (), message, "Give it a flat base; or it is not meant to stand.")
    elif rest.tilt > LEAN:
        message = f"it leans: it turned by {rest.tilt:.0f}° until it came to rest"
        yield Finding("physics-tilt", "warning", (), message, "Give it a flat base; or it is not meant to stand.")
