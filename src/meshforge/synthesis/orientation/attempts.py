"""Learning tried in one frame after another: how far each comes, and what frames have in common, done once."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from meshforge import language
from meshforge.common import MeshForgeError
from meshforge.geometry import Pose
from meshforge.language import HullTable, Replay
from meshforge.symbolic import NEAR_MISS, SymbolicMesh
from meshforge.synthesis.demonstration import Example, RuleSpec, name_demonstrations
from meshforge.synthesis.options import Options, TimeBudget
from meshforge.synthesis.search.observation_table import select_all
from meshforge.synthesis.search.smallest import Search
from meshforge.synthesis.search.terms import enumerate_leaves
from meshforge.synthesis.task import LearningTask, example_of, memoize

Signature = tuple[bytes, bool]
"""Which leaf extractors select a hull, and whether it was selected."""

_MAX_STRETCH = 2.0
"""No turn makes the diagonal of a mesh longer than 3 ** 0.5 times, so no contact distance either."""


class OrientationSearch:
    """The rules of a task to be learned, and the attempts to learn them in the frames tried so far.

    known: extractors of all rules in the present frame; empty where some rule has none; floors: nodes that each rule
    needs in whatever frame.
    """

    def __init__(self, task: LearningTask, budget: TimeBudget, known: Sequence[language.Extractor] = ()) -> None:
        self.task, self.rules, self.known = task, task.rules, tuple(known)
        sizes = [language.size_of(one) for one in known]
        self._closed = all(demo.step(rule.number) for demo in task.demos for rule in task.rules)
        self.floors = [min(nodes, 2) if self._closed else 1 for nodes in sizes or [1] * len(self.rules)]
        self._budget = budget
        self._demos = dict(name_demonstrations(task.demos))
        self._turners = [MeshTurner(demo.mesh, task.frame.contact) for demo in task.demos]
        self._by_orient: dict[language.Orient, FrameAttempt | None] = {}
        self._by_turns: dict[tuple[bytes, ...], FrameAttempt] = {}
        self._extractors: dict[frozenset[Signature], language.Extractor] = {}
        self._none_up_to: dict[frozenset[Signature], int] = {}

    def attempt(self, orient: language.Orient) -> "FrameAttempt | None":
        """Return learning in the frame of a directive, as far as it came; None where a mesh cannot be turned so."""
        if orient not in self._by_orient:
            self._budget.check()
            self._by_orient[orient] = self._begin(orient)
        return self._by_orient[orient]

    def _begin(self, orient: language.Orient) -> "FrameAttempt | None":
        """Directives that turn every mesh alike share one attempt."""
        try:
            turned = [turner.turn(orient) for turner in self._turners]
        except MeshForgeError:
            return None
        turns = tuple((pose.rotation.round(9) + 0.0).tobytes() for _, pose in turned)
        if turns not in self._by_turns:
            rows = zip(self._demos.items(), turned, strict=True)
            replays = [
                Replay(demo.mesh, pose, mesh, mesh, name, demo.selections, memo=memoize)
                for (name, demo), (mesh, pose) in rows
            ]
            self._by_turns[turns] = FrameAttempt(self, replays)
        return self._by_turns[turns]

    def analyze(self, rule: RuleSpec, replays: Sequence[Replay]) -> "RuleInFrame":
        """Return the next rule of some replays. Raises MeshForgeError where what was shown cannot be done."""
        examples = [shown for replay in replays if (shown := example_of(replay, self._demos[replay.name], rule))]
        found = analyze_rule(examples, self.task.frame.labels, self.task.options)
        if not found.base and self._closed:  # bases select the same in every frame, unless open steps differ
            self.floors[rule.number - 1] = 2
        return found

    def find_smallest(self, rule: "RuleInFrame", most: int) -> language.Extractor | None:
        """Return the extractor that learning finds, if it has at most that many nodes. Raises OutOfTime."""
        if rule.base or rule.strays or most < rule.least:
            return rule.base
        if rule.signatures not in self._extractors and self._none_up_to.get(rule.signatures, 0) < most:
            options = replace(self.task.options, max_size=most)
            if hit := Search(rule.examples, self.task.frame.labels, self._budget, options).find_hit():
                self._extractors[rule.signatures] = hit.extractor
            else:
                self._none_up_to[rule.signatures] = most
        found = self._extractors.get(rule.signatures)
        return found if found and language.size_of(found) <= most else None


class FrameAttempt:
    """One frame's rules, learned one by one, each with its smallest extractor.

    sizes: nodes of those learned so far; extractors: which, and others that select what was shown; strays: hulls that
    no extractor of the next rule can get right.
    """

    def __init__(self, search: OrientationSearch, replays: Sequence[Replay]) -> None:
        self._search, self._replays = search, list(replays)
        self._next: RuleInFrame | None = None
        self.sizes: list[int] = []
        self.extractors: list[tuple[language.Extractor, ...]] = []
        self.strays = 0
        self._over = False

    def learn(self, limit: int, most: int) -> bool:
        """Learn on; whether every rule has an extractor, of at most `limit` nodes in all and `most` each."""
        count = len(self._search.rules)
        while not self._over and len(self.sizes) < count:
            room = min(most, limit - sum(self.sizes) - sum(self._search.floors[len(self.sizes) + 1 :]))
            if room < self._search.floors[len(self.sizes)] or not self._learn_next(room):
                break
        return len(self.sizes) == count and sum(self.sizes) <= limit

    def _learn_next(self, most: int) -> bool:
        """Whether the next rule has an extractor of at most so many nodes; if so, it is applied."""
        rule = self._search.rules[len(self.sizes)]
        try:
            self._next = self._next or self._search.analyze(rule, self._replays)
            extractor = self._search.find_smallest(self._next, most)
            if extractor:
                self._apply(extractor, self._next)
            elif self._next.strays:
                self.strays = self._next.strays
                self._stop()
        except MeshForgeError:  # what was shown cannot be done in this frame
            self._stop()
            return False
        return extractor is not None

    def _apply(self, extractor: language.Extractor, found: "RuleInFrame") -> None:
        place, task, self._next = len(self.sizes), self._search.task, None
        rule, known, delta = task.rules[place], self._search.known[place : place + 1], task.options.geo_extremity
        fits = [
            one
            for one in known
            if all(language.select_mask(one, shown.mesh, delta) == shown.selection for shown in found.examples)
        ]
        self.extractors.append((extractor, *found.leaves, *fits))
        done = language.Rule(extractor, rule.action, rule.label)
        self._replays = [replay.advance(done, task.templates, task.frame.extremity) for replay in self._replays]
        self.sizes.append(language.size_of(extractor))

    def _stop(self) -> None:
        self._over, self._next, self._replays = True, None, []  # there may be hundreds of attempts


@dataclass(frozen=True, eq=False, slots=True)
class RuleInFrame:
    """What the demonstrations say about a rule in one frame.

    base: a base that selects what was shown; it does so in every frame, so nothing needs to be searched for.
    signatures: of all hulls; rules with equal signatures have the same extractors.
    strays: how many hulls any extractor takes or leaves wrongly, since others of their signature were not or were.
    least: an extractor has at least that many nodes; leaves: those that select what was shown, where no base does.
    """

    examples: tuple[Example, ...]
    base: language.BaseExtractor | None
    signatures: frozenset[Signature] = frozenset()
    strays: int = 0
    least: int = 1
    leaves: tuple[language.Extractor, ...] = ()


def analyze_rule(examples: Sequence[Example], vocabulary: Sequence[str], options: Options) -> RuleInFrame:
    """Return a rule as it is met on some examples."""
    chosen = (*enumerate_leaves(tuple(vocabulary), options.layers), *options.leaves)
    hulls = HullTable([example.mesh for example in examples], extremity=options.geo_extremity)
    shown = [bool(e.selection >> index & 1) for e in examples for index in range(len(e.mesh.hulls))]
    for leaf in chosen:
        if isinstance(leaf, language.BaseExtractor) and (language.select_hulls(leaf, hulls) == shown).all():
            return RuleInFrame(tuple(examples), leaf)
    table = select_all(chosen, hulls)
    fits = (table == np.array(shown, dtype=np.bool_)).all(axis=1)
    leaves = tuple(chosen[row] for row in np.flatnonzero(fits))
    least = min((leaf.size for leaf in leaves), default=3)
    seen = Counter(zip([column.tobytes() for column in np.packbits(table.T, axis=1)], shown, strict=True))
    strays = sum(min(count, seen[signature, False]) for (signature, selected), count in seen.items() if selected)
    return RuleInFrame(tuple(examples), None, frozenset(seen), strays, least, leaves)


class MeshTurner:
    """One mesh as the first rule sees it under any directive; contact: the program's epsilon, None keeps the mesh's.

    Does what `to_canonical_frame` does, but measures the distances, which no turn changes, only once.
    """

    def __init__(self, mesh: SymbolicMesh, contact: float | None) -> None:
        epsilon = mesh.epsilon if contact is None else contact
        self._mesh = replace(mesh, epsilon=epsilon)
        self._wide = replace(mesh, epsilon=epsilon * _MAX_STRETCH, scale=None)

    def turn(self, orient: language.Orient | None) -> tuple[SymbolicMesh, Pose]:
        """Return the mesh in the frame of a directive, and the pose oriented_T_incoming.

        Raises ProgramError where the orientation fails.
        """
        oriented, pose = language.orient_mesh(self._mesh, orient)
        staged = replace(oriented, scale=oriented.diagonal)
        reach = staged.contact_distance * NEAR_MISS
        staged.set_known_graph({pair: gap for pair, gap in self._wide.graph.items() if gap <= reach})
        return staged, pose
