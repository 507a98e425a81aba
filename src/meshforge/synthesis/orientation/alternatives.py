"""Looks for an orientation in which rules that have extractors have more believable ones.

An extractor is doubted for its nodes and for what fits by accident, as in `candidates/belief.py`; a direction most
where no landmarks lie along its axis on nearly all meshes, since the meshes then lie in different frames.
"""

from collections.abc import Collection, Sequence

import numpy as np

from meshforge import language
from meshforge.common import MeshForgeError
from meshforge.symbolic import SymbolicMesh
from meshforge.synthesis.candidates.belief import NODE
from meshforge.synthesis.demonstration import RuleSpec
from meshforge.synthesis.options import TimeBudget
from meshforge.synthesis.orientation.attempts import OrientationSearch
from meshforge.synthesis.orientation.landmarks import ALONG, NEARLY_ALL, Landmarks
from meshforge.synthesis.orientation.suggest import Directives
from meshforge.synthesis.task import LearningTask

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
    task: LearningTask, budget: TimeBudget, extractors: Sequence[language.Extractor]
) -> language.Orient | None:
    """Return the directive of one pair in whose frame the rules are most believable, if they are clearly more so than
    now, without an orientation.

    extractors: of the rules, as they were learned. Raises OutOfTime.
    """
    costs = FrameCosts(task.rules, extractors)
    if costs.count((), askew=True) - DIRECTIVE <= costs.least:
        return None
    shown, others = [demo.mesh for demo in task.demos], [*task.batch.values()][:MAX_MESHES]
    landmarks = Landmarks([*shown, *others], task.frame.labels)
    supported = [letter for letter in "XYZ" if landmarks.supports(letter)]
    if costs.count(supported, askew=True) - DIRECTIVE <= costs.least:
        return None
    orients = _rank(Directives(shown, others, task.frame.labels), landmarks)[:MAX_TRIED]
    tried = [*shown, *others][:MAX_TURNED] if orients and costs.askew else []
    # where it turns more than a few, meshes do not lie in its frame as they are
    askew = sum(_turns(mesh, orients[0]) for mesh in tried) > (1 - NEARLY_ALL) * len(tried)
    most = costs.count(supported, askew) - DIRECTIVE
    if most <= costs.least:
        return None
    best: language.Orient | None = None
    search, sizes = OrientationSearch(task, budget, extractors), [language.size_of(one) for one in extractors]
    for orient in orients:
        attempt = search.attempt(orient)
        if attempt and attempt.learn(sum(sizes) + SLACK, max(sizes) + SLACK):
            axes = {pair.axis[1] for pair in orient.pairs}
            cost = sum(min(cost_extractor(one, axes) for one in some) for some in attempt.extractors)
            if cost <= most:
                best, most = orient, cost - CLEARLY
        if most < costs.least:
            break
    return best


class FrameCosts:
    """What speaks against rules in the files' own frames.

    least: what extractors cost at least in any frame; askew: what it costs besides that actions went by axes that
    mean nothing [nats].
    """

    def __init__(self, rules: Sequence[RuleSpec], extractors: Sequence[language.Extractor]) -> None:
        self._extractors = tuple(extractors)
        self.least = sum(min(cost_extractor(one, "XYZ"), NODE * 2 + language.UPRIGHT) for one in extractors)
        reach = [k for k, one in enumerate(extractors) if any(leaf.bases for leaf in language.leaves_of(one))]
        acted = [place for place, rule in enumerate(rules) if rule.action.depends_on_frame]
        self.askew = UNSUPPORTED - language.UPRIGHT if acted and reach and acted[0] < reach[-1] else 0.0

    def count(self, supported: Collection[str], askew: bool) -> float:
        """Return the cost where landmarks lie along some axes; askew: whether actions went by axes without meaning."""
        return sum(cost_extractor(one, supported) for one in self._extractors) + (self.askew if askew else 0.0)


def _turns(mesh: SymbolicMesh, orient: language.Orient) -> bool:
    try:
        rotation = language.orient_mesh(mesh, orient)[1].rotation
    except MeshForgeError:
        return False
    return float(np.trace(rotation)) < 1 + 2 * ALONG


def _rank(directives: Directives, landmarks: Landmarks) -> list[language.Orient]:
    """Directives of one pair: first those that hold on most meshes, then those nearest to where most meshes stand."""
    plain = [orient for orient in directives.with_one_pair() if not orient.snap]

    def key(orient: language.Orient) -> tuple[int, float, float]:
        (pair,) = orient.pairs
        return -int(landmarks.holds(orient).sum()), round(landmarks.deviation(pair), 2), -landmarks.likeness(pair)

    return sorted(plain, key=key)


def cost_extractor(extractor: language.Extractor, supported: Collection[str]) -> float:
    """Return what it costs to believe in one [nats]; supported: the axes along which directions mean something."""
    leaves = (_weigh_leaf(leaf, supported) for leaf in language.leaves_of(extractor))
    return NODE * language.size_of(extractor) + sum(leaves)


def _weigh_leaf(leaf: language.Leaf, supported: Collection[str]) -> float:
    """What is believed less of a leaf for its bases, and for directions that mean something or not."""
    if isinstance(leaf, language.BaseExtractor):
        return leaf.cost
    kinds = leaf.arguments().items()
    given = (getattr(leaf, name) for name, kind in kinds if isinstance(kind, language.DirectionArgument))
    costs = sum(language.UPRIGHT if direction[1] in supported else UNSUPPORTED for direction in given)
    return sum(base.cost for base in leaf.bases) + costs
