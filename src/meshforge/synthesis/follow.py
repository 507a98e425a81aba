"""Tells what became of a program that somebody had in mind: rule by rule, why it was or was not what was learned."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from meshforge.language import (
    All,
    Attach,
    Diff,
    Extractor,
    Geo,
    Intersect,
    Is,
    Program,
    Union,
    labels_used,
    select_mask,
    show,
    show_label,
    size,
)
from meshforge.symbolic import bits
from meshforge.synthesis.agreement import Agreed
from meshforge.synthesis.example import Example
from meshforge.synthesis.guidance import reading_id
from meshforge.synthesis.options import Options
from meshforge.synthesis.readings import Weighed
from meshforge.synthesis.task import Task
from meshforge.words import counted, listed


def unfollowed(task: Task, wanted: Program) -> tuple[str, ...]:
    """What keeps a wanted program from being learned before any rule is searched for."""
    lines = []
    if len(wanted.rules) != len(task.rules):
        lines.append(f"{counted(len(task.rules), 'rule is', 'rules are')} demonstrated, not {len(wanted.rules)}")
    if wanted.orient != task.frame.orient:
        theirs, ours = (show(orient) if orient else "no orientation" for orient in (wanted.orient, task.frame.orient))
        lines.append(f"it has {theirs}, the demonstrations were looked at with {ours}")
    return tuple(lines)


def followed(
    rule: Agreed,
    wanted: Extractor,
    weighed: Weighed | None,
    names: Sequence[str],
    examples: Sequence[Example],
    task: Task,
) -> str:
    """One sentence on a rule; weighed: what was learned for it, with the names of the meshes, None where nothing."""
    text = f"rule {rule.number}, {show(wanted)}: "
    barred = next(_barred(wanted, task), None)
    if barred:
        return text + barred
    wrong = next(_wrong(wanted, examples, task.extremity), None)
    if wrong:
        return text + wrong
    if weighed is None:
        return text + "it selects what was shown, but the search did not get that far"
    return text + _place(rule.number, wanted, weighed, names, task.options)


def _barred(wanted: Extractor, task: Task) -> Iterator[str]:
    """Why it is none of those that are searched."""
    unknown = [label for label in labels_used(wanted) if label not in task.frame.labels]
    if unknown:
        yield f"the label {show_label(unknown[0])} is not in the vocabulary"
    if size(wanted) > task.options.max_size:
        yield f"it has {size(wanted)} nodes, and the search ends at {task.options.max_size}"
    for kind, letter in ((Attach, "T"), (Geo, "G")):
        if letter not in task.options.layers and any(isinstance(leaf, kind) for leaf in _leaves(wanted)):
            yield f"{kind.__name__} is switched off (layers {task.options.layers})"


def _wrong(wanted: Extractor, examples: Sequence[Example], extremity: float) -> Iterator[str]:
    """On which mesh it does something else than was shown."""
    for example in examples:
        found = select_mask(wanted, example.mesh, extremity)
        extra, missing = _names(example, found & ~example.selection), _names(example, example.selection & ~found)
        said = [f"leaves out {listed(missing)}"] if missing else []
        said += [f"selects {listed(extra)} too"] if extra else []
        if said:
            yield f"on {example.name} it {' and '.join(said)}"


def _place(rule: int, wanted: Extractor, weighed: Weighed, names: Sequence[str], options: Options) -> str:
    """Where a consistent extractor stands among the readings."""
    does = weighed.field.bits(wanted)
    place = next((k for k, term in enumerate(weighed.terms) if term.bits == does), None)
    if place is None and options.strategy == "paper":
        return f"it selects what was shown, but {show(weighed.extractor)} comes before it"
    if place is None:
        smallest = min(term.size for term in weighed.terms)
        if size(wanted) > smallest + options.above:
            enough = f"{smallest} suffice{'s' if smallest == 1 else ''}"
            return f"it selects what was shown, but has {size(wanted)} nodes where {enough}"
        return "it selects what was shown, but there were too many readings to get that far"
    reading = weighed.terms[place].extractor
    same = "" if reading == wanted else f" as {show(reading)}, which selects the same on every asset"
    if place == 0:
        return f"learned{same}"
    return f"reading {reading_id(rule, place)}{same}; {_instead(weighed, place, names)}"


def _instead(weighed: Weighed, place: int, names: Sequence[str]) -> str:
    """Why another reading was taken, and what would help."""
    differs = [names[k] for k in weighed.differences(place)]
    first, second = weighed.beliefs[0], weighed.beliefs[place]
    better = "more believable" if first >= second else "smaller, though less believable"
    one = "it" if len(differs) == 1 else "one of these"
    return (
        f"{show(weighed.extractor)} is {better} ({first:.0%} against {second:.0%}). "
        f"They differ on {counted(len(differs), 'asset')}: {listed(differs)}; demonstrate {one}"
    )


def _leaves(extractor: Extractor) -> Iterator[All | Is | Attach | Geo]:
    if isinstance(extractor, Union | Intersect | Diff):
        yield from _leaves(extractor.left)
        yield from _leaves(extractor.right)
    else:
        yield extractor


def _names(example: Example, mask: int) -> list[str]:
    return [example.mesh.hulls[index].name for index in sorted(bits(mask))]
