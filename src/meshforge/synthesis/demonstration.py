"""Demonstrations: what a person did, step by step, on one mesh, and what all of them together say about each rule; what
learning leaves open, and what a person says to it: answers, and corrections of labels."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from meshforge import symbolic
from meshforge.common import DemonstrationError
from meshforge.language import Action, Each


@dataclass(frozen=True, slots=True, init=False)
class Step:
    """What one mesh says about one rule.

    rule: its number, from 1. select: the names of the hulls the rule selects (shown); an empty set: the rule selects
    none here (nothing); None: this mesh says nothing about the rule (open).
    action, label: what was done, and the label given to what it makes; they count where the step is shown.
    """

    rule: int
    select: frozenset[str] | None
    action: Action
    label: str | None = None

    def __init__(self, rule: int, select: Iterable[str] | None, action: Action, label: str | None = None) -> None:
        if isinstance(select, str):
            raise DemonstrationError(
                f"rule {rule}: select is a set of hull names, not the text {select!r}", remedy=f"Write {{{select!r}}}."
            )
        object.__setattr__(self, "rule", rule)
        object.__setattr__(self, "select", None if select is None else frozenset(select))
        object.__setattr__(self, "action", action)
        object.__setattr__(self, "label", label)

    @property
    def shown(self) -> bool:
        """Whether hulls were selected."""
        return bool(self.select)

    @property
    def open(self) -> bool:
        """Whether the mesh says nothing about the rule."""
        return self.select is None


@dataclass(frozen=True, eq=False, slots=True, init=False)
class Demonstration:
    """The steps on one mesh, in order, one a rule; rules beyond the last step are open.

    mesh: as it came in, before the orientation; names in later steps may be those of hulls that earlier steps made.
    name: how messages call it; by default the file's path.
    Raises DemonstrationError where the rules are not numbered 1, 2, 3, ...
    """

    mesh: symbolic.SymbolicMesh
    steps: tuple[Step, ...]
    name: str | None = None

    def __init__(self, mesh: symbolic.SymbolicMesh, steps: Iterable[Step], name: str | None = None) -> None:
        object.__setattr__(self, "mesh", mesh)
        object.__setattr__(self, "steps", tuple(steps))
        object.__setattr__(self, "name", name or (str(mesh.asset.path) if mesh.asset else None))
        numbers = [step.rule for step in self.steps]
        if numbers != list(range(1, len(numbers) + 1)):
            raise DemonstrationError(
                f"the steps are numbered {', '.join(map(str, numbers))}",
                where=self.name,
                remedy=f"Number them 1 to {len(numbers)}, in the order in which they were done; "
                "a rule that this mesh says nothing about has the selection null.",
            )

    def step(self, rule: int) -> Step | None:
        """Return the step of that rule, None where the mesh says nothing about it."""
        step = self.steps[rule - 1] if rule <= len(self.steps) else None
        return None if step is None or step.open else step

    @property
    def selections(self) -> dict[int, frozenset[str]]:
        """The hulls of the steps that are not open, by the numbers of their rules."""
        return {step.rule: step.select for step in self.steps if step.select is not None}

    def with_selection(self, rule: int, select: Iterable[str]) -> "Demonstration":
        """Return the same with other hulls selected in a step that is there."""
        steps = [Step(one.rule, select, one.action, one.label) if one.rule == rule else one for one in self.steps]
        return Demonstration(self.mesh, steps, self.name)


def name_demonstrations(demos: Iterable[Demonstration]) -> tuple[tuple[str, Demonstration], ...]:
    """Return each demonstration with the name that messages use; one without a name is `demonstration 1`, `2`, ..."""
    return tuple((demo.name or f"demonstration {k}", demo) for k, demo in enumerate(demos, 1))


def strip_each(action: Action) -> Action:
    """Return the action without `Each` around it."""
    return action.action if isinstance(action, Each) else action


@dataclass(frozen=True, eq=False, slots=True)
class Example:
    """One mesh as the rule meets it, and the hulls that the rule is to select there, as a bit set.

    name: how messages call the mesh.
    """

    name: str
    mesh: symbolic.SymbolicMesh
    selection: int


LabelChange = tuple[int, str]
"""A hull by its index, and the label it gets."""


def to_fix(example: Example, change: LabelChange) -> "LabelFix":
    """Return a change as it is called outside."""
    hull = example.mesh.hulls[change[0]]
    return LabelFix(example.name, hull.name, hull.label, change[1])


@dataclass(frozen=True, slots=True)
class RuleSpec:
    """A rule without its extractor.

    each_in: where the action is `Each`, the name of a demonstration that says so. One that shows the action without
    `Each` agrees with it only where it selects one connected component.
    """

    number: int
    action: Action
    label: str | None
    each_in: str | None


def collect_rule_specs(demos: Sequence[Demonstration]) -> tuple[RuleSpec, ...]:
    """Return the rules in order. Raises DemonstrationError where actions differ, or where a rule is shown nowhere."""
    count = max((len(demo.steps) for demo in demos), default=0)
    if not count:
        raise DemonstrationError("there is no demonstrated step to learn from")
    return tuple(_merge_rule(number, demos) for number in range(1, count + 1))


def _merge_rule(number: int, demos: Sequence[Demonstration]) -> RuleSpec:
    steps = [(name, demo.step(number)) for name, demo in name_demonstrations(demos)]
    shown = [(name, step) for name, step in steps if step and step.shown]
    if not shown:
        remedy = "Show it on a mesh where it has something to do, or leave the step out."
        raise DemonstrationError(f"rule {number} selects no hull in any demonstration", remedy=remedy)
    for other in shown[1:]:
        _check_same_rule(number, shown[0], other)
    eaches = [(name, step) for name, step in shown if isinstance(step.action, Each)]
    name, step = (eaches or shown)[0]
    return RuleSpec(number, step.action, step.label, name if eaches else None)


def _check_same_rule(number: int, one: tuple[str, Step], other: tuple[str, Step]) -> None:
    (one_name, a), (other_name, b) = one, other
    if (strip_each(a.action), a.label) != (strip_each(b.action), b.label):
        raise DemonstrationError(
            f"rule {number} does {_describe_step(a)} in {one_name}, but {_describe_step(b)} in {other_name}",
            remedy="A rule does the same on every mesh: change one of the steps, or make two rules of them.",
        )


def _describe_step(step: Step) -> str:
    return f"{step.action} as {step.label}" if step.label else str(step.action)


@dataclass(frozen=True, slots=True, order=True)
class LabelFix:
    """One hull of a demonstrated mesh gets another label; was: None where it has none.

    asset: how messages call the mesh.
    """

    asset: str
    hull: str
    was: str | None
    to: str

    @property
    def id(self) -> str:
        """What it is called: `ASSET#HULL=LABEL`, with the label that it gives."""
        return f"{self.asset}#{self.hull}={self.to}"

    @property
    def reverse(self) -> "LabelFix | None":
        """The correction that undoes this one, None where the hull had no label."""
        return None if self.was is None else LabelFix(self.asset, self.hull, self.to, self.was)


@dataclass(frozen=True, slots=True)
class OpenRule:
    """A rule that the demonstrations leave open, and the asset where that is best seen.

    selections: what its believable readings select there, names of hulls, each once; that of the program first.
    """

    rule: int
    asset: str
    selections: tuple[frozenset[str], ...]

    @property
    def id(self) -> str:
        return f"{self.rule}:{self.asset}"


@dataclass(frozen=True, slots=True, init=False)
class Answer:
    """What a person said: the hulls that a rule selects on an asset; None: neither of the choices.

    refused: where it is neither, the choices there were. price: of a reading that does otherwise [nats], where labels
    may be at fault; None where an answer is certain.
    """

    rule: int
    asset: str
    select: frozenset[str] | None
    refused: tuple[frozenset[str], ...] = ()
    price: float | None = None

    def __init__(
        self,
        rule: int,
        asset: str,
        select: Iterable[str] | None,
        refused: Iterable[Iterable[str]] = (),
        price: float | None = None,
    ) -> None:
        if isinstance(select, str):
            problem = f"rule {rule}: an answer is a set of hull names, not the text {select!r}"
            raise DemonstrationError(problem, remedy=f"Write {{{select!r}}}.")
        object.__setattr__(self, "rule", rule)
        object.__setattr__(self, "asset", asset)
        object.__setattr__(self, "select", None if select is None else frozenset(select))
        object.__setattr__(self, "refused", tuple(map(frozenset, refused)))
        object.__setattr__(self, "price", price)


@dataclass(frozen=True, slots=True)
class Repair:
    """A label that is probably wrong, with what would be right.

    rule: the first one that needs it; belief: that it is right, in 0..1; why: one sentence.
    """

    fix: LabelFix
    rule: int
    belief: float
    why: str
