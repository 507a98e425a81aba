"""Which edited assets a person has accepted, and which are flagged for another look.

A result that is accepted by itself was looked at: what each rule selected there is what was meant, and learning
keeps to it. Who accepts many at once says nothing of each.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeVar

from meshforge.batch import Stamp, program_digest, read_stamp, text_digest
from meshforge.common import ProjectError
from meshforge.store import Review, RuleSelection, Store, Verdict, action_text_without_each

Item = TypeVar("Item")

MOST_ACCEPTED = 100
"""Of more accepted results so many are learned from: each is one more mesh on which every rule must be right."""


def pick_evenly(items: Sequence[Item], most: int) -> Sequence[Item]:
    """The items in their order; of more than `most` so many, the first among them."""
    if len(items) <= most:
        return items
    return [items[place * len(items) // most] for place in range(most)]


def review_assets(store: Store, assets: Iterable[str], verdict: Verdict | None, note: str | None) -> None:
    """Set or take back what is said about the outputs of some assets, in one write.

    Raises ProjectError, with nothing written, where one of them has no output that a verdict could be about.
    """
    assets = tuple(assets)
    own = {asset: _build_review(store, asset, verdict, note) for asset in assets}
    if verdict == "accepted" and len(assets) == 1 and (review := own[assets[0]]):
        own = {assets[0]: review.model_copy(update={"seen": _read_selections(store, assets[0])})}
    store.write_reviews(own)


def _build_review(store: Store, asset: str, verdict: Verdict | None, note: str | None) -> Review | None:
    store.path(asset)
    output = output_digest(read_stamp(store.layout.edited, asset))
    if verdict and not output:
        raise ProjectError(
            f"{asset} has no output to be {verdict}",
            where=str(store.folder),
            remedy=f"Make it: meshforge apply {store.folder}",
        )
    return Review(verdict=verdict, note=note, output=output) if verdict else None


def find_accepted_results(store: Store) -> dict[str, tuple[RuleSelection, ...]]:
    """What the program did on the results that were looked at and accepted, by asset; of very many some, evenly."""
    rows = sorted(
        (asset, review) for asset, review in store.reviews().items() if review.seen and asset in store.found.ids
    )
    some = pick_evenly(rows, MOST_ACCEPTED)
    present = {asset: output_digest(read_stamp(store.layout.edited, asset)) for asset, _ in some}
    return {asset: review.seen for asset, review in some if review.output == present[asset]}


def _read_selections(store: Store, asset: str) -> tuple[RuleSelection, ...]:
    """What the rules selected on an asset; nothing where another program did that, or it was edited by hand."""
    stamp, program = read_stamp(store.layout.edited, asset), store.program()
    made = stamp and stamp.inputs
    if not stamp or not made or not program or made.corrections or made.program != program_digest(program):
        return ()
    actions = {
        number: action_text_without_each(rule.action, rule.label) for number, rule in enumerate(program.rules, 1)
    }
    return tuple(
        RuleSelection(rule=line.rule, action=actions[line.rule], select=tuple(sorted(line.selected)))
        for line in stamp.rules
    )


def output_digest(stamp: Stamp | None) -> str | None:
    """One digest of all files of an output, None where there is none."""
    if not stamp or stamp.status not in ("edited", "unchanged"):
        return None
    return text_digest("\n".join(f"{name} {digest}" for name, digest in sorted(stamp.outputs.items())))
