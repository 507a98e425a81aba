"""Looks for an orientation in which rules that have extractors have more believable ones.

An extractor is doubted for its nodes and for what fits by accident, as in `readings/belief.py`; a direction most where
no landmarks lie along its axis on nearly all meshes, since the meshes then lie in different frames.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence

import numpy as np

from meshforge.common import MeshForgeError
from meshforge.language import All, Attach, Extractor, Geo, Is, Orient, Program, Template, orient_mesh, size_of
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.demonstration import Demonstration, RuleSpec
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.orientation.attempts import OrientationSearch
from meshforge.synthesis.orientation.landmarks import ALONG, NEARLY_ALL, Landmarks
from meshforge.synthesis.orientation.suggest import Directives
from meshforge.synthesis.readings.belief import ALL, NODE, SELF, UPRIGHT

UNSUPPORTED = 2.6
"""For a direction along whose axis no landmarks lie on nearly all meshes [nats]."""
DIRECTIVE = 1.2
"""For an orientation [nats]: it costs the reader a line, and there are many that could fit by accident."""
CLEARLY = 0.9
"""A directive is preferred to one that comes before it where its extractors cost so much less [nats]."""
SLACK = 2
"""So many nodes more than now the rules may have in another frame, where they are less doubted all the same."""
MAX_TRIED = 16
"""So many directives are tried at most, those first that hold on most meshes."""
MAX_MESHES, MAX_TURNED = 100, 24
"""So many meshes say at most how landmarks lie, and are turned to see whether they lie so already."""


def find_more_believable(
    demos: Sequence[Demonstration],
    rules: Sequence[RuleSpec],
    frame: Program,
    templates: Mapping[str, Template],
    options: Options,
    budget: TimeBudget,
    extractors: Sequence[Extractor],
    batch: Sequence[SymbolicMesh],
) -> Orient | None:
    """The directive of one pair in whose frame the rules are most believable, if they are clearly more so than now.

    frame: the program without its rules, and without an orientation; extractors: of the rules, as they were learned.
    Raises OutOfTime.
    """
    least = sum(min(cost_extractor(one, "XYZ"), NODE * 2 + UPRIGHT) for one in extractors)
    askew = UNSUPPORTED - UPRIGHT if any(rule.action.depends_on_frame for rule in rules) else 0.0
    if cost_extractors(extractors, "") + askew - least <= DIRECTIVE:
        return None
    shown, others = [demo.mesh for demo in demos], batch[:MAX_MESHES]
    landmarks = Landmarks([*shown, *others], frame.labels)
    most = cost_extractors(extractors, [letter for letter in "XYZ" if landmarks.supports(letter)]) - DIRECTIVE
    if most + askew <= least:
        return None
    orients = _rank(Directives(shown, others, frame.labels), landmarks)[:MAX_TRIED]
    if askew and orients and _turns_many([*shown, *others][:MAX_TURNED], orients[0]):
        most += askew
    if most <= least:
        return None
    sizes = [size_of(one) for one in extractors]
    search = OrientationSearch(demos, rules, frame, templates, options, budget, extractors)
    best: tuple[float, Orient] | None = None
    for orient in orients:
        attempt = search.attempt(orient)
        if attempt and attempt.learn(sum(sizes) + SLACK, max(sizes) + SLACK):
            axes = {pair.axis[1] for pair in orient.pairs}
            cost = sum(min(cost_extractor(one, axes) for one in some) for some in attempt.extractors)
            if cost <= (best[0] - CLEARLY if best else most):
                best = cost, orient
        if best and best[0] - CLEARLY < least:
            break
    return best[1] if best else None


def _turns_many(meshes: Sequence[SymbolicMesh], orient: Orient) -> bool:
    """Whether a directive turns more than a few of some meshes, so that they do not lie in its frame as they are."""
    return sum(_turns(mesh, orient) for mesh in meshes) > (1 - NEARLY_ALL) * len(meshes)


def _turns(mesh: SymbolicMesh, orient: Orient) -> bool:
    try:
        rotation = orient_mesh(mesh, orient)[1].rotation
    except MeshForgeError:
        return False
    return float(np.trace(rotation)) < 1 + 2 * ALONG


def _rank(directives: Directives, landmarks: Landmarks) -> list[Orient]:
    """Directives of one pair: first those that hold on most meshes, then those nearest to where most meshes stand."""
    plain = [orient for orient in directives.with_one_pair() if not orient.snap]

    def key(orient: Orient) -> tuple[int, float, float]:
        (pair,) = orient.pairs
        return -int(landmarks.holds(orient).sum()), round(landmarks.deviation(pair), 2), -landmarks.likeness(pair)

    return sorted(plain, key=key)


def cost_extractors(extractors: Iterable[Extractor], supported: Collection[str]) -> float:
    """What it costs to believe in all of them [nats]; supported: the letters of the axes along which landmarks lie."""
    return sum(cost_extractor(one, supported) for one in extractors)


def cost_extractor(extractor: Extractor, supported: Collection[str]) -> float:
    """What it costs to believe in one [nats]."""
    return NODE * size_of(extractor) + _doubt(extractor, supported)


def _doubt(extractor: Extractor, supported: Collection[str]) -> float:
    match extractor:
        case All():
            return ALL
        case Is():
            return 0.0
        case Attach(selected, anchor):
            return _doubt(selected, supported) + _doubt(anchor, supported) + SELF * (selected == anchor)
        case Geo(base, direction):
            return _doubt(base, supported) + (UPRIGHT if direction[1] in supported else UNSUPPORTED)
        case _:
            return _doubt(extractor.left, supported) + _doubt(extractor.right, supported)
