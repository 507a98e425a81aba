"""Questions about groups of look-alike hulls whose labels are in doubt and matter, to be confirmed at one glance; and
whether assets are turned first, on the asset of a family that shows best what that does."""

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from meshforge.common import MeshForgeError
from meshforge.geometry import Floats
from meshforge.label_model.describe import find_up, find_upright_rotation
from meshforge.signoff.assessment import LEAST, ReviewState
from meshforge.signoff.family import ALIKE, FamilyRun, alternative_shares
from meshforge.signoff.question import (
    NO,
    YES,
    YES_OR_NO,
    HullPlace,
    ReviewChoice,
    ReviewQuestion,
    identify,
    price_group,
)
from meshforge.symbolic import NO_PART
from meshforge.synthesis import OrientationSuggestion

MOST_HULLS = 24
"""Hulls of a group."""
_LEAST_SHARE = 0.003  # a hull whose label is surer than this needs no confirmation
_CLUSTER_RISK = 0.2  # wrong edits of look-alikes that are to be expected, from which on these are asked about
_SEEDS = 8  # hulls about which a group is looked for, those that matter most


@dataclass(frozen=True, slots=True)
class _Suspect:
    """A hull in doubt. mesh, row: its places in the family; label: the likeliest; share: how probable it is that its
    label changes the edit; wrong: that it is not the likeliest one."""

    place: HullPlace
    mesh: int
    row: int
    label: str
    share: float
    wrong: float


@dataclass(frozen=True, slots=True)
class _LookalikeGroup:
    """Hulls that look alike, and what they probably are. gain: assets made right by confirming that; seconds: of it."""

    label: str
    hulls: tuple[HullPlace, ...]
    gain: float
    seconds: float


def _find_groups(family: FamilyRun, open_assets: Sequence[int]) -> Iterator[_LookalikeGroup]:
    from scipy.spatial.distance import cdist  # lazy: 0.5 s, half of all imports

    suspects = list(_suspects(family, open_assets))
    by_label = defaultdict[str, list[_Suspect]](list)
    for one in sorted(suspects, key=lambda one: (-_gain(family, [one]), one.place)):
        by_label[one.label].append(one)
    rows = family.posterior.table.rows * family.posterior.table.metric
    for label, some in sorted(by_label.items()):
        for seed in some[: max(1, _SEEDS // len(by_label))]:
            apart = cdist(rows[[one.row for one in some]], rows[[seed.row]], "cityblock")[:, 0]
            alike = [one for one, gap in zip(some, apart, strict=True) if gap <= ALIKE]
            yield _best_of(family, label, [seed, *(one for one in alike if one is not seed)])


def _suspects(family: FamilyRun, open_assets: Sequence[int]) -> Iterator[_Suspect]:
    posterior = family.posterior
    for mesh in open_assets:
        run = family.runs[mesh]
        span = posterior.table.spans.get(mesh, slice(0, 0))
        index = family.state.meshes[run.asset].index
        for hull, share in alternative_shares(run.alternatives).items():
            row = span.start + index[hull]
            if share < _LEAST_SHARE or posterior.seen.fixed[row]:
                continue
            chances = posterior.chances[row]
            best = int(np.argmax(chances))
            yield _Suspect(
                HullPlace(run.asset, hull), mesh, row, posterior.seen.labels[best], share, float(1 - chances[best])
            )


def _gain(family: FamilyRun, some: Sequence[_Suspect]) -> float:
    """How many assets more are right, as far as can be expected, when the labels of some hulls are told."""
    by_mesh = defaultdict[int, list[_Suspect]](list)
    for one in some:
        by_mesh[one.mesh].append(one)
    found = 0.0
    for mesh, group_places in by_mesh.items():
        if family.runs[mesh].error:  # the labels with which it could be edited
            found += max(one.share for one in group_places)
            continue
        evidence = family.evidence[mesh]
        labels = family.labels_right(mesh, {one.place.hull for one in group_places})
        found += evidence.credit(labels=labels / max(evidence.labels, LEAST))
    return found


def _best_of(family: FamilyRun, label: str, some: Sequence[_Suspect]) -> _LookalikeGroup:
    best: _LookalikeGroup | None = None
    for count in range(1, min(len(some), MOST_HULLS) + 1):
        part = some[:count]
        seconds = price_group(count, sum(one.wrong for one in part))
        group = _LookalikeGroup(label, tuple(sorted(one.place for one in part)), _gain(family, part), seconds)
        if best is None or group.gain / group.seconds > best.gain / best.seconds:
            best = group
    assert best
    return best


def ask_groups(family: FamilyRun, open_assets: Sequence[int]) -> Iterator[ReviewQuestion]:
    """Ask about the hulls that matter most for some assets, each group as large as is worth its seconds."""
    yield from (_ask_group(family, group) for group in _find_groups(family, open_assets))


def ask_clusters(family: FamilyRun) -> Iterator[ReviewQuestion]:
    """Ask once about look-alikes of several assets, which err together, whose labels decide edits that nobody looked
    at, however sure each edit is by itself."""
    known = family.state.reviewed_assets | family.state.excluded.keys()
    unseen = [place for place, one in enumerate(family.runs) if one.asset not in known]
    for group in _find_groups(family, unseen):
        if len({place.asset for place in group.hulls}) > 1 and group.gain >= _CLUSTER_RISK:
            yield _ask_group(family, group)


def _ask_group(family: FamilyRun, group: _LookalikeGroup) -> ReviewQuestion:
    labels_of_group = (family.state.meshes[asset].hull_of(hull).annotation for asset, hull in group.hulls)
    names = Counter(label.name if label else "nothing" for label in labels_of_group)
    counts = dict(sorted(names.items(), key=lambda one: (-one[1], one[0])))
    called = ", ".join(f"{count} {'is' if count == 1 else 'are'} called {name}" for name, count in counts.items())
    known = f": {called}" if len(counts) > 1 else ""
    whether = "Is none of them any part" if group.label == NO_PART else f"Are all of them {group.label}"
    labels = list(dict.fromkeys([group.label, *(name for name in counts if name != "nothing")]))
    choices = tuple(map(ReviewChoice.of_label, labels))
    first = group.hulls[0]
    if len(group.hulls) == 1:
        text = f"{first.hull} of {first.asset} is called {next(iter(counts))}: is it {group.label}?"
    else:
        text = f"These {len(group.hulls)} hulls look alike{known}. {whether}?"
    question = identify(
        ReviewQuestion("group", text, group.seconds, group.gain, first.asset, None, group.hulls, choices)
    )
    other = _find_other_label(family, group) if len(labels) == 1 else None  # no part of what the question is about
    return replace(question, choices=(*choices, ReviewChoice.of_label(other))) if other else question


def _find_other_label(family: FamilyRun, group: _LookalikeGroup) -> str | None:
    posterior, places = family.posterior, family.places
    rows = [
        posterior.table.spans[places[asset]].start + family.state.meshes[asset].index[hull]
        for asset, hull in group.hulls
    ]
    shares = posterior.chances[rows].sum(axis=0)
    others = [place for place, label in enumerate(posterior.seen.labels) if label != group.label]
    return posterior.seen.labels[max(others, key=lambda place: (shares[place], -place))] if others else None


_SEEN = 5.0  # degrees by which an asset must turn, to be seen
_NEAR = 10.0  # degrees by which an asset may still lean where landmarks set it upright


def ask_orientation(
    suggested: OrientationSuggestion | None, state: ReviewState, gain: float
) -> Iterator[ReviewQuestion]:
    """Ask whether all assets are to be turned as is suggested, where it is worth asking."""
    asset = find_turned_asset(state, suggested) if suggested else None
    if suggested and asset:
        text = f"Should {asset} stand like this?"
        yes = ReviewChoice(YES, "yes, turn all assets like this", orient=suggested.orient)
        choices = (ReviewChoice(NO, "no, all stay as they are"), yes)
        yield identify(ReviewQuestion("orientation", text, YES_OR_NO, gain, asset, choices=choices))


def find_turned_asset(state: ReviewState, suggested: OrientationSuggestion) -> str | None:
    """Return the asset to ask about: one that turns neither least nor most, of those whose selections change if there
    are any.

    None where some asset that has labels cannot be turned, or none turns so that it is seen. Beside a program only what
    is set upright counts, and None also where as many assets lean once they are turned.
    """
    turned, leaning = dict[str, float](), 0
    for name, mesh in state.meshes.items():
        if name in state.excluded or not any(hull.label for hull in mesh.hulls):
            continue
        try:
            before, after = (find_upright_rotation(mesh, orient) for orient in (state.frame.orient, suggested.orient))
        except MeshForgeError:
            return None
        turn = _to_degrees(float(np.sum(before * after) - 1) / 2)
        is_tilted = suggested.before and _angle(before[2], after[2]) > _SEEN
        upright = find_up(mesh, after[2]) if is_tilted else after[2]
        if _angle(upright, after[2]) > _NEAR:
            leaning += 1
        elif (_angle(upright, before[2]) if suggested.before else turn) > _SEEN:
            turned[name] = turn
    names = sorted([name for name in suggested.differs_on if name in turned] or turned, key=turned.__getitem__)
    return names[len(names) // 2] if len(turned) > leaning else None


def _angle(a: Floats, b: Floats) -> float:
    return _to_degrees(float(a @ b))


def _to_degrees(cosine: float) -> float:
    return float(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))
