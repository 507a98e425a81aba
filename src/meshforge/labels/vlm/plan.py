"""What is asked about: every hull of each asset, or exemplars; drawn in worker processes, with examples before it."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from functools import partial

from meshforge import symbolic
from meshforge.batch import WorkerFailure, execute
from meshforge.common import AssetError, UsageError, describe_error
from meshforge.label_model import choose_exemplars
from meshforge.labels.family_comparison import FamilyDescription
from meshforge.labels.labeler import LabelFamily
from meshforge.labels.vlm.prompt import (
    MOST_COLORS,
    AskedMesh,
    HullKey,
    HullQuestion,
    PromptConfig,
    ask_every_hull,
    build_questions,
    example_messages,
)
from meshforge.labels.vlm.question import Message
from meshforge.store import AssetFiles, Store, hull_digests
from meshforge.symbolic import GIVEN_SOURCES

_QUESTIONS, _TOGETHER = 7, 3  # about exemplars at most, and assets in each
_EXAMPLES = 2  # labelled assets that are shown at most, where the settings name none


@dataclass(frozen=True, slots=True)
class QuestionPlan:
    """What is asked about together. name: of the page that shows it; hulls: by asset, None for all of them."""

    name: str
    hulls: Mapping[str, Sequence[str] | None]


@dataclass(frozen=True, slots=True)
class DrawnQuestions:
    """Questions, drawn. assets: digests of the hulls of each, by name; wanted: the hulls asked about that may change.

    error: why nothing can be asked.
    """

    plan: QuestionPlan
    assets: Mapping[str, Mapping[str, str]]
    wanted: frozenset[HullKey] = frozenset()
    questions: tuple[HullQuestion, ...] = ()
    error: str | None = None


def plan_exemplars(described: FamilyDescription) -> list[QuestionPlan]:
    """Return questions about a few hulls that all others are like; they do not depend on labels that there are."""
    hulls = dict[str, list[str]]()
    for mesh, places in choose_exemplars(described.table, _QUESTIONS * _TOGETHER, MOST_COLORS).items():
        asset, begin = described.assets[mesh], described.table.spans[mesh].start
        names = [*described.hulls[asset]]
        hulls[asset] = [names[place - begin] for place in places]
    rows = [*hulls.items()]
    starts = range(0, len(rows), _TOGETHER)
    return [QuestionPlan(f"exemplars_{k + 1}", dict(rows[at : at + _TOGETHER])) for k, at in enumerate(starts)]


def plan_every_hull(store: Store) -> list[QuestionPlan]:
    """Return a question for each asset."""
    return [QuestionPlan(asset, {asset: None}) for asset in store.assets()]


def draw_questions(
    family: LabelFamily, plans: Sequence[QuestionPlan], config: PromptConfig
) -> Generator[DrawnQuestions, None, None]:
    """Yield the questions as soon as they are drawn, in their order; some are drawn ahead of the others."""
    examples = _find_examples(family, config)
    items = [(plan, family.store.asset_files([*plan.hulls])) for plan in plans]
    with closing(execute(partial(_draw, config, examples), items, family.execution)) as work:
        for plan, found in zip(plans, work, strict=True):
            if isinstance(found, WorkerFailure):
                found = DrawnQuestions(plan, {asset: {} for asset in plan.hulls}, error=f"{plan.name}: {found.why}")
            yield found


def _draw(
    config: PromptConfig, examples: tuple[Message, ...], item: tuple[QuestionPlan, Sequence[AssetFiles]]
) -> DrawnQuestions:
    """Nothing is asked where no hull is wanted; else about all, so that answers can be found again by then."""
    plan, places = item
    try:
        meshes = {asset: place.read_mesh() for asset, place in zip(plan.hulls, places, strict=True)}
        asked = [AskedMesh(name, mesh, plan.hulls[name] or [*mesh.index]) for name, mesh in meshes.items()]
        every = ((one.name, one.mesh.hull_of(hull)) for one in asked for hull in one.hulls)
        wanted = frozenset((asset, hull.name) for asset, hull in every if hull.source not in GIVEN_SOURCES)
        digests = {asset: hull_digests(mesh) for asset, mesh in meshes.items()}
        if not wanted:
            return DrawnQuestions(plan, digests)
        whole = None in plan.hulls.values()
        drawn = ask_every_hull(asked[0].name, asked[0].mesh, config) if whole else build_questions(asked, config)
        return DrawnQuestions(plan, digests, wanted, tuple(one.show_examples(examples) for one in drawn))
    except Exception as error:  # one asset that cannot be drawn must not cost the others their labels
        return DrawnQuestions(plan, {asset: {} for asset in plan.hulls}, error=describe_error(error, plan.name))


def _find_examples(family: LabelFamily, config: PromptConfig) -> tuple[Message, ...]:
    """The labelled assets that are shown: those that the settings name, or some of which every hull has a label of a
    person or a file."""
    store, named = family.store, config.settings.examples
    assets = named or [asset for asset, _ in zip(_iterate_labelled(family), range(_EXAMPLES), strict=False)]
    found = list[Message]()
    for asset in assets:
        mesh = store.mesh(asset)
        guessed = {hull.name: None for hull in mesh.hulls if hull.source not in GIVEN_SOURCES}
        if len(guessed) == len(mesh.hulls):
            remedy = "Label its hulls by hand, or take it out of examples in [vlm]."
            raise UsageError("this example has no label that a person or a file gave", where=asset, remedy=remedy)
        found += example_messages(asset, mesh.with_labels(guessed), config)
    return tuple(found)


def _iterate_labelled(family: LabelFamily) -> Iterator[str]:
    for asset, facts in family.iterate_facts():
        try:
            labels = symbolic.match_labels(family.store.labels(asset), facts.hulls).labels
        except AssetError:  # it is named where it is asked about
            continue
        if facts.hulls and all(hull in labels and labels[hull].source in GIVEN_SOURCES for hull in facts.hulls):
            yield asset
