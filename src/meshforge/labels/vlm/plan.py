"""What is asked about: every hull of each asset, or exemplars; drawn in worker processes, with examples before it."""

from collections.abc import Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from functools import partial

from meshforge import symbolic
from meshforge.batch import WorkerFailure, execute
from meshforge.common import AssetError, describe_error
from meshforge.label_model import FamilyTable, choose_exemplars
from meshforge.labels.family_comparison import FamilyDescription, describe_assets
from meshforge.labels.labeler import LabelFamily
from meshforge.labels.vlm import prompt
from meshforge.labels.vlm.prompt import PromptConfig
from meshforge.labels.vlm.question import Message
from meshforge.store import AssetFiles, Store, hull_digests
from meshforge.symbolic import GIVEN_SOURCES

_QUESTIONS, _TOGETHER = 7, 3  # about exemplars at most, and assets in each
_EXAMPLES = 2  # labelled assets that are shown at most


QuestionPlan = Mapping[str, Sequence[str]]
"""Hulls that are asked about together, by asset; none for all of them."""


@dataclass(frozen=True, slots=True)
class QuestionBatch:
    """Questions, drawn. assets: digests of the hulls of each, by name; wanted: the hulls asked about that may change.

    error: why nothing can be asked.
    """

    plan: QuestionPlan
    assets: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    wanted: frozenset[prompt.HullKey] = frozenset()
    questions: tuple[prompt.HullQuestion, ...] = ()
    error: str | None = None


def plan_questions(family: LabelFamily, config: PromptConfig) -> tuple[FamilyDescription | None, list[QuestionPlan]]:
    """Return a question for each asset; or those about exemplars, a few hulls that all others are like, and the family
    in which these were found. Which they are does not depend on labels."""
    if config.settings.every_hull:
        return None, [{asset: ()} for asset in family.store.assets()]
    described, rows = describe_assets(family), list[tuple[str, list[str]]]()
    assets, table = [*described.rows], FamilyTable.of([*described.rows.values()])
    for mesh, places in choose_exemplars(table, _QUESTIONS * _TOGETHER, prompt.MOST_COLORS).items():
        asset, begin = assets[mesh], table.spans[mesh].start
        names = [*described.hulls[asset]]
        rows.append((asset, [names[place - begin] for place in places]))
    starts = range(0, len(rows), _TOGETHER)
    return described, [dict(rows[at : at + _TOGETHER]) for at in starts]


def draw_questions(
    family: LabelFamily, plans: Sequence[QuestionPlan], config: PromptConfig
) -> Generator[QuestionBatch, None, None]:
    """Yield the questions as soon as they are drawn, in their order; some are drawn ahead of the others."""
    config = replace(config, examples=_find_examples(family, config))
    items = [(plan, family.store.asset_files([*plan])) for plan in plans]
    with closing(execute(partial(_draw, config), items, replace(family.execution, stop=None))) as work:
        for plan, found in zip(plans, work, strict=True):
            if isinstance(found, WorkerFailure):
                found = QuestionBatch(plan, error=f"{', '.join(plan)}: {found.why}")
            yield found


def _draw(config: PromptConfig, item: tuple[QuestionPlan, Sequence[AssetFiles]]) -> QuestionBatch:
    """Nothing is asked where no hull is wanted; else about all, so that answers can be found again by then."""
    plan, places = item
    try:
        meshes = {asset: place.read_mesh() for asset, place in zip(plan, places, strict=True)}
        asked = [prompt.MeshHulls(asset, mesh, plan[asset] or [*mesh.index]) for asset, mesh in meshes.items()]
        every = ((one.name, one.mesh.hull_of(hull)) for one in asked for hull in one.hulls)
        wanted = frozenset((asset, hull.name) for asset, hull in every if hull.source not in GIVEN_SOURCES)
        digests = {asset: hull_digests(mesh) for asset, mesh in meshes.items()}
        if not wanted:
            return QuestionBatch(plan, digests)
        return QuestionBatch(plan, digests, wanted, prompt.build_questions(asked, config))
    except Exception as error:  # one asset that cannot be drawn must not cost the others their labels
        return QuestionBatch(plan, error=describe_error(error, ", ".join(plan)))


def _find_examples(family: LabelFamily, config: PromptConfig) -> tuple[Message, ...]:
    """Some labelled assets that are shown: those of which every hull has a label of a person or a file."""
    store, found = family.store, list[Message]()
    labelled = (asset for asset, facts in family.iterate_facts() if _is_labelled(store, asset, facts.hulls))
    for asset, _ in zip(labelled, range(_EXAMPLES), strict=False):
        found += prompt.example_messages(asset, store.mesh(asset), config)
    return tuple(found)


def _is_labelled(store: Store, asset: str, hulls: Mapping[str, str]) -> bool:
    try:
        labels = symbolic.match_labels(store.labels(asset), hulls).labels
    except AssetError:  # it is named where it is asked about
        return False
    return bool(hulls) and all(hull in labels and labels[hull].source in GIVEN_SOURCES for hull in hulls)
