"""What a program is learned from besides demonstrations: answers, results that were accepted or corrected, and repairs
that are not to be proposed."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

from meshforge import batch, label_model, symbolic, synthesis
from meshforge.project import demonstrations
from meshforge.project.run import find_accepted_results
from meshforge.store import Feedback, Store
from meshforge.symbolic import NO_PART

TEACHES = 0.8
"""A result that was corrected is learned from where the labels of the hulls that differ are right with this
probability; elsewhere the labels may be at fault, and no rule."""
UNSURE_PRICE = 1.6
"""Of a reading that does otherwise than a result which nothing fits [nats]: what labels cost that are right at 80%."""
_LEAST_CHANCE = 0.05  # that labels on an asset are at fault


def sort_answers(
    feedback: Feedback, demos: Mapping[str, synthesis.Demonstration]
) -> tuple[list[synthesis.Answer], list[synthesis.Answer]]:
    """Return the answers to learn from, and those to a rule that does something else by now."""
    actions = demonstrations.actions_of([demo.steps for demo in demos.values()])
    fitting = [line.answer for line in feedback.answers.values() if line.fits(actions)]
    return fitting, [line.answer for line in feedback.answers.values() if not line.fits(actions)]


def list_accepted(
    store: Store, demos: Mapping[str, synthesis.Demonstration], feedback: Sequence[synthesis.Answer]
) -> list[synthesis.Answer]:
    """Return what rules select on results that were accepted, but for what was said otherwise, and other rules."""
    known = {(answer.rule, answer.asset) for answer in feedback}
    every = (one for asset, seen in find_accepted_results(store).items() for one in _number(demos, asset, seen))
    return [one for one in every if (one.rule, one.asset) not in known]


def list_wrong(
    feedback: Feedback, demos: Mapping[str, synthesis.Demonstration], meshes: Mapping[str, symbolic.SymbolicMesh]
) -> list[synthesis.Answer]:
    """Return what rules should have selected on results that were called wrong, or that they should not have selected
    what they did where one rule alone did anything there; unsure where labels may be the reason."""
    last = {asset: some[-1] for asset, some in feedback.verdicts.items() if asset in meshes and asset not in demos}
    wrong = {asset: one for asset, one in last.items() if one.meant or one.verdict == "wrong"}
    if not wrong:
        return []
    every = [hull.annotation for mesh in meshes.values() for hull in mesh.hulls]
    posterior = label_model.model_family(list(meshes.values())).infer(every)
    columns = {label: column for column, label in enumerate(posterior.seen.labels)}
    found = list[synthesis.Answer]()
    for place, (asset, mesh) in enumerate(meshes.items()):
        if one := wrong.get(asset):
            pairs = zip(one.seen, one.meant, strict=False)
            differing = frozenset[str]().union(*({*was.select} ^ {*now.select} for was, now in pairs))
            rows = zip(mesh.hulls, posterior.chances_of(place), strict=True)
            share = math.prod(
                float(row[columns[hull.label or NO_PART]]) if (hull.label or NO_PART) in columns else 0.0
                for hull, row in rows
                if hull.name in differing or not differing
            )
            price = -math.log(max(1 - share, _LEAST_CHANCE))
            answers = list(_number(demos, asset, one.meant or one.seen))
            if one.meant:
                found += answers if share >= TEACHES else soften(answers, price)
            elif len(active := [answer for answer in answers if answer.select]) == 1:
                found += [synthesis.Answer(a.rule, asset, None, [a.select or ()], price) for a in active]
    return found


def list_corrected(feedback: Feedback, demos: Mapping[str, synthesis.Demonstration]) -> list[synthesis.Answer]:
    """Return what a person said that rules should have selected on results that were wrong."""
    last = {asset: some[-1] for asset, some in feedback.verdicts.items() if asset not in demos}
    return [answer for asset, one in last.items() if one.meant for answer in _number(demos, asset, one.meant)]


def soften(answers: Iterable[synthesis.Answer], price: float = UNSURE_PRICE) -> list[synthesis.Answer]:
    """Return the same answers, which no reading has to keep to; what is unsure stays so."""
    return [
        synthesis.Answer(one.rule, one.asset, one.select, one.refused, price if one.price is None else one.price)
        for one in answers
    ]


def _number(
    demos: Mapping[str, synthesis.Demonstration], asset: str, selections: Sequence[batch.RuleSelection]
) -> Iterator[synthesis.Answer]:
    actions = demonstrations.actions_of([demo.steps for demo in demos.values()])
    yield from (
        synthesis.Answer(one.rule, asset, one.select) for one in selections if actions.get(one.rule) == one.action
    )


def list_rejections(feedback: Feedback) -> list[synthesis.LabelFix]:
    """Return what is not to be proposed: what was refused, and what would undo a fix that was made."""
    undone = (line.fix.reverse for line in feedback.fixes.values() if line.accepted)
    refused = (line.fix for line in feedback.fixes.values() if not line.accepted)
    return [*refused, *(reverse for reverse in undone if reverse)]
