"""A simulated person who replies to the queue's questions: knows what is wanted and what each hull is, and may slip."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

from benchmark.signoff.judge import Judge, Output
from benchmark.signoff.ledger import (
    Ledger,
    price_of_hand,
    price_of_hand_by_keys,
    price_of_mend,
    price_of_mend_by_keys,
)
from benchmark.study.condition import Condition
from benchmark.study.desk import Bench, Desk, Selections
from benchmark.study.keystrokes import (
    ANSWER,
    APPROVAL,
    CONFIRMATION,
    GLANCE,
    KEY,
    STROKE,
    THINK,
    price_group,
    price_group_by_keys,
)
from benchmark.study.person import Person
from benchmark.study.propagation import HandLabels
from meshforge.language import Program
from meshforge.signoff import (
    HullPlace,
    ReviewQuestion,
    ReviewReply,
)
from meshforge.signoff.question import NO, RIGHT, WRONG
from meshforge.synthesis import Demonstration, Step


class Reviewer:
    """Everything that they do is noted in the ledger.

    slipped: assets whose demonstration has a slip of theirs; refused: repairs that they declined as no label was wrong.
    """

    def __init__(self, bench: Bench, seed: int, condition: Condition) -> None:
        self.person, self.judge, self.ledger = Person(bench.truth, seed, condition), Judge(bench), Ledger()
        self.slipped, self.refused = set[str](), 0
        self._looked_at = set[HullPlace]()
        self._truth, self._bench = bench.truth, bench

    def reply(
        self, question: ReviewQuestion, desk: Desk, program: Program | None, output: Output | None
    ) -> ReviewReply:
        """What they say to a question that needs no demonstration; output: of the asset that it is about."""
        match question.kind:
            case "group":
                return self._name_group(question)
            case "candidate" | "label":
                return self._pick(question, desk, program)
            case "selection":
                return self._check_selection(question)
            case "result":
                return self._look(question, output)
            case _:
                return self._confirm(question)

    def _name_group(self, question: ReviewQuestion) -> ReviewReply:
        """The label of most of the hulls, and each exception."""
        labels = [choice.label for choice in question.choices]
        counts = Counter(self._label_of(place) for place in question.hulls)
        best = max(range(len(labels)), key=lambda place: (counts[labels[place] or ""], -place), default=None)
        right = best if best is not None and counts[labels[best] or ""] else None
        told = None if right is None else labels[right]
        odd = {place: self._label_of(place) for place in question.hulls if self._label_of(place) != told}
        strokes, sizes = STROKE * len(set(odd.values())), (len(question.hulls), len(odd))
        self.ledger.add("group", price_group(*sizes) + strokes, price_group_by_keys(*sizes) + strokes)
        seen = {place: label for place, label in odd.items() if not self.person.errs_now()}
        return ReviewReply(question.id, self._slip(question, right), seen)

    def _pick(self, question: ReviewQuestion, desk: Desk, program: Program | None) -> ReviewReply:
        """One of several selections, or none of them."""
        choices = [frozenset(choice.select or ()) for choice in question.choices]
        where = (question.asset, question.rule or 1)
        right = self.person.picks(desk, where, choices, program) if program else None
        self.ledger.add(question.kind, ANSWER, 2 * THINK + KEY)
        return ReviewReply(question.id, self._slip(question, right))

    def _check_selection(self, question: ReviewQuestion) -> ReviewReply:
        """Whether hulls were left out of a demonstration by mistake: what is nearer to what is wanted; or the label of
        the hull where it is the one that is offered."""
        wanted, rule = self._truth.reference[question.asset], question.rule or 1
        meant = wanted[rule - 1] if wanted else frozenset[str]()
        true = self._label_of(question.hulls[0]) if question.hulls else None
        gaps = [
            len(meant ^ frozenset(choice.select or ())) if choice.label is None else -1 if choice.label == true else 1e9
            for choice in question.choices
        ]
        self.ledger.add(question.kind, CONFIRMATION, THINK + KEY)
        return ReviewReply(question.id, self._slip(question, gaps.index(min(gaps))))

    def _confirm(self, question: ReviewQuestion) -> ReviewReply:
        """The label of one hull; an orientation is theirs already, so that another one is declined."""
        if question.kind == "orientation":
            self.ledger.add(question.kind, CONFIRMATION, THINK + KEY)
            return ReviewReply(question.id, self._slip(question, [one.id for one in question.choices].index(NO)))
        labels = [choice.label for choice in question.choices]
        true = self._label_of(question.hulls[0]) if question.hulls else None
        right = labels.index(true) if true is not None and true in labels else None
        self.refused += question.kind == "repair" and right is None
        self.ledger.add(question.kind, CONFIRMATION, THINK + KEY)
        return ReviewReply(question.id, self._slip(question, right))

    def _slip(self, question: ReviewQuestion, right: int | None) -> str | None:
        """The id of the right choice, of another one where they slip."""
        place = self.person.slips_from(right, len(question.choices))
        return None if place is None else question.choices[place].id

    def _look(self, question: ReviewQuestion, output: Output | None) -> ReviewReply:
        """Whether a result is right; set aside what nobody could show."""
        there = question.choice(RIGHT) is not None  # else the program cannot run, or it was called wrong before
        right = (self.judge.looks_right(question.asset, output) != self.person.errs_now()) and there
        self.ledger.add("result", GLANCE + APPROVAL, GLANCE + KEY)
        given_up = self._truth.reference[question.asset] is None
        return ReviewReply(question.id, RIGHT if right else "not-solved" if given_up else WRONG)

    def correct_selections(self, name: str, done: Selections, wanted: Selections) -> dict[int, frozenset[str]]:
        """What rules should have selected on a mesh, by their numbers, of those that selected something else."""
        by_keys = price_of_mend_by_keys(done, wanted, self._bench.find_alike(name))
        self.ledger.add("correction", price_of_mend(done, wanted), by_keys)
        found = dict[int, frozenset[str]]()
        for rule, (one, other) in enumerate(zip(done, wanted, strict=True), 1):
            slip = frozenset(hull for hull in sorted(one ^ other) if self.person.errs_now())
            if one != other:
                found[rule] = other ^ slip
        return found

    def shows(self, desk: Desk, name: str, act: str = "demonstration") -> Demonstration:
        """All of an edit by hand; each hull is left out where they slip. act: what it is noted as."""
        meant = self.person.shows(desk, name)
        steps = [Step(step.rule, self._select(step), step.action, step.label) for step in meant.steps]
        selections = [step.select or () for step in steps]
        self.slipped.discard(name)
        if any(made.select != step.select for made, step in zip(steps, meant.steps, strict=True)):
            self.slipped.add(name)
        by_keys = price_of_hand_by_keys(selections, self._bench.find_alike(name))
        self.ledger.add(act, price_of_hand(selections), by_keys)
        return Demonstration(meant.mesh, steps, name)

    def _select(self, step: Step) -> list[str] | None:
        return None if step.select is None else [name for name in sorted(step.select) if not self.person.errs_now()]

    def name_hulls(self, name: str, hulls: Iterable[str], looked_at: Sequence[str | None] = ()) -> dict[str, str]:
        """The true labels of some hulls of a mesh, given by hand; looked_at: labels of hulls looked at before."""
        labels = {hull: self._label_of(HullPlace(name, hull)) for hull in hulls}
        self.ledger.add_labels(HandLabels.of(self._bench, name, looked_at, labels.items()))
        return labels

    def inspect_labels(self, desk: Desk, name: str, hulls: Sequence[str]) -> dict[str, str]:
        """The labels that were found wrong when some were looked at, one by one; each hull is looked at once."""
        left = [hull for hull in hulls if HullPlace(name, hull) not in self._looked_at]
        self._looked_at.update(HullPlace(name, hull) for hull in left)
        mesh = desk.meshes[name]
        there = [mesh.hull_of(hull).label for hull in left]
        wrong = [
            hull for hull, label in zip(left, there, strict=True) if label != self._label_of(HullPlace(name, hull))
        ]
        return self.name_hulls(name, [hull for hull in wrong if not self.person.errs_now()], there)

    def _label_of(self, place: HullPlace) -> str:
        return str(self._truth.meshes[place.asset].hull_of(place.hull).label)
