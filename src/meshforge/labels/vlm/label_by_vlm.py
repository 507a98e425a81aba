"""Labels for the hulls of a project from a model, each asset written as soon as it is answered; and a forecast of
what that sends and costs."""

from __future__ import annotations

from collections.abc import Callable, Collection, Generator, Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from functools import partial

from meshforge.batch import IN_PROCESS, ExecutionOptions, WorkerFailure, execute
from meshforge.common import UsageError, describe_error
from meshforge.labels.labeler import AssetLabels, Labeler, LabelFamily, LabelProposal
from meshforge.labels.vlm.approval import check_approved
from meshforge.labels.vlm.cache import write_page
from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.endpoint import TokenCount, endpoint_of
from meshforge.labels.vlm.labeller import Labeller, OpenAnswers
from meshforge.labels.vlm.limits import Usage, estimate_tokens
from meshforge.labels.vlm.prompt import HullQuestion, PromptConfig, build_questions, prompt_config_of
from meshforge.store import AssetFiles, Store, VlmSettings, hull_digests
from meshforge.symbolic import GIVEN_SOURCES, SymbolicMesh


@dataclass(frozen=True, slots=True)
class AssetQuestions:
    """What is asked about an asset. hulls: digests by name, in order; wanted: the hulls whose labels may change.

    error: why it cannot be read or drawn.
    """

    hulls: Mapping[str, str] = field(default_factory=dict)
    wanted: tuple[str, ...] = ()
    questions: tuple[HullQuestion, ...] = ()
    error: str | None = None


def draw_assets(
    store: Store, config: PromptConfig, execution: ExecutionOptions
) -> Generator[tuple[str, AssetQuestions], None, None]:
    """All assets of a project, in their order, as soon as they are drawn; some are drawn ahead of the others."""
    assets = store.assets()
    work = execute(partial(_draw, config), list(zip(assets, store.asset_files(assets), strict=True)), execution)
    try:
        for asset, found in zip(assets, work, strict=True):
            if isinstance(found, WorkerFailure):
                found = AssetQuestions(error=f"{store.path(asset)}: {found.why}")
            yield asset, found
    finally:
        work.close()


def _draw(config: PromptConfig, item: tuple[str, AssetFiles]) -> AssetQuestions:
    asset, place = item
    try:
        mesh = place.read_mesh()
        wanted = tuple(hull.name for hull in mesh.hulls if hull.source not in GIVEN_SOURCES)
        return AssetQuestions(hull_digests(mesh), wanted, tuple(build_questions(mesh, wanted, config, asset)))
    except Exception as error:  # one asset that cannot be drawn must not cost the others their labels
        return AssetQuestions(error=describe_error(error, asset))


@dataclass(frozen=True, slots=True)
class VlmResult:
    """How asking a model went. usage: what was asked, and its cost.

    open: why hulls that were asked about have no label from it, by asset and hull; unasked: assets that were not
    reached, and ended: why, None where all were; blind: the model did not name the colour of a red picture.
    """

    usage: Usage
    open: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    unasked: tuple[str, ...] = ()
    ended: str | None = None
    blind: bool = False


class VlmLabeler(Labeler):
    """Asks a vision-language model; labels of people and files stay. Answers are kept, so that none is paid for twice.

    settings: those of the project when None; typed: addresses that the user typed, who thereby approves them: elsewhere
    but to this machine nothing is sent before `approve_host`. `stop` of the execution ends the asking, and what was
    answered by then is proposed. result: how it went, once all is proposed.
    Raises MeshForgeError where nothing could be asked at all.
    """

    name = "vlm"
    about = "labels by a vision-language model"
    work = "asking"

    def __init__(self, settings: VlmSettings | None = None, typed: Collection[str] = ()) -> None:
        self._settings, self._typed = settings, typed
        self.result = VlmResult(Usage())

    def propose(self, family: LabelFamily) -> LabelProposal:
        settings = self._settings or family.store.settings.vlm
        check_approved(endpoint_of(settings), self._typed)
        return LabelProposal(self._ask(family, settings, prompt_config_of(settings, family.vocabulary)))

    def _ask(
        self, family: LabelFamily, settings: VlmSettings, config: PromptConfig
    ) -> Generator[AssetLabels, None, None]:
        store, stop = family.store, family.execution.stop or (lambda: False)
        endpoint, pending = endpoint_of(settings), dict[str, tuple[Mapping[str, str], OpenAnswers]]()
        client = Client(endpoint, store.layout.vlm, max_cost=settings.max_cost, stop=stop)
        reached, left = set[str](), dict[str, Mapping[str, str]]()
        with (
            closing(client),
            closing(Labeller(client, config, examples_of(store, settings))) as labeller,
            closing(draw_assets(store, config, replace(family.execution, stop=None))) as drawn,
        ):

            def finish(assets: Iterable[str]) -> Iterator[AssetLabels]:
                for asset in assets:
                    if labels := _read_answers(store, client, asset, *pending.pop(asset), left):
                        reached.add(asset)
                        yield labels

            while not (client.end or stop()) and (one := next(drawn, None)):
                asset, found = one
                if found.error:
                    reached.add(asset)
                    yield AssetLabels(asset, error=found.error)
                else:
                    pending[asset] = found.hulls, labeller.ask(found.wanted, found.questions)
                    yield from finish([name for name, (_, answers) in pending.items() if answers.is_done()])
            yield from finish(list(pending))
        if client.end and not client.usage.answered + client.usage.cached:
            raise client.end
        unasked = tuple(asset for asset in store.assets() if asset not in reached)
        ended = client.end.message if client.end else "stopped" if unasked else None
        self.result = VlmResult(client.usage, left, unasked, ended, client.is_blind)


def _read_answers(
    store: Store,
    client: Client,
    asset: str,
    hulls: Mapping[str, str],
    pending: OpenAnswers,
    left: dict[str, Mapping[str, str]],
) -> AssetLabels | None:
    """The labels of an asset when all its answers are there; None where asking ended before any."""
    answers, end = pending.result(), client.end
    if end and answers.failed and not answers.labels:
        return None  # the result says once that asking ended, and which assets were not reached
    if answers.open:
        left[asset] = answers.open
    if answers.asked:
        write_page(store.layout.vlm, asset, answers)
    failed = tuple(problem for problem in answers.failed if end is None or problem != end.sentence)
    return AssetLabels(asset, hulls, answers.labels, {hull: ("model", hull) for hull in answers.labels}, failed)


def check_vlm_settings(settings: VlmSettings, vocabulary: Sequence[str]) -> None:
    """Raises UsageError where nothing could be asked: no model, no key, no approval, or no vocabulary."""
    endpoint = endpoint_of(settings)
    endpoint.key()
    check_approved(endpoint)
    prompt_config_of(settings, vocabulary)


def examples_of(store: Store, settings: VlmSettings) -> list[SymbolicMesh]:
    """The labelled assets that are shown as examples, with labels that somebody gave."""
    meshes = []
    for asset in settings.examples:
        mesh = store.mesh(asset)
        guessed = {hull.name: None for hull in mesh.hulls if hull.source not in GIVEN_SOURCES}
        if len(guessed) == len(mesh.hulls):
            remedy = "Label its hulls by hand, or take it out of examples in [vlm]."
            raise UsageError("this example has no label that a person or a file gave", where=asset, remedy=remedy)
        meshes.append(mesh.with_labels(guessed))
    return meshes


@dataclass(frozen=True, slots=True)
class VlmForecast:
    """host, model, mode: who is asked, and how; assets, hulls: how many of them are asked about.

    questions, of which `known` have their answers already; pictures, input, output: what the others send, and tokens
    that this may come to; cost: their price [$], None where prices are not known. unreadable: assets that cannot be
    read or drawn; key: the environment variable of the key, empty where none is wanted, and whether it is set.
    """

    host: str
    model: str
    mode: str
    assets: int
    hulls: int
    questions: int
    known: int
    pictures: int
    input: int
    output: int
    cost: float | None
    unreadable: tuple[str, ...]
    key: str
    key_is_set: bool


def forecast_vlm(
    store: Store,
    settings: VlmSettings | None = None,
    *,
    progress: Callable[[], None] | None = None,
    stop: Callable[[], bool] | None = None,
    vocabulary: Sequence[str] | None = None,
    execution: ExecutionOptions = IN_PROCESS,
) -> VlmForecast:
    """What `VlmLabeler` would send and what that costs, with nothing sent; vocabulary: one to try instead.

    Questions that have to be asked again come on top of it.
    """
    settings = settings or store.settings.vlm
    endpoint = endpoint_of(settings)
    config = prompt_config_of(settings, store.vocabulary if vocabulary is None else vocabulary)
    client = Client(endpoint, store.layout.vlm, max_cost=settings.max_cost)
    assets = hulls = questions = known = pictures = 0
    usage, unreadable = TokenCount(), list[str]()
    with (
        closing(client),
        closing(Labeller(client, config, examples_of(store, settings))) as labeller,
        closing(draw_assets(store, config, execution)) as drawn_assets,
    ):
        while not (stop and stop()) and (next_one := next(drawn_assets, None)):
            asset, found = next_one
            if found.error:  # `VlmLabeler` says then what is wrong
                unreadable.append(asset)
                continue
            assets, hulls = assets + bool(found.wanted), hulls + len(found.wanted)
            for asked in map(labeller.add_examples, found.questions):
                questions += 1
                if client.find_answer(asked.question):
                    known += 1
                    continue
                pictures += len(asked.question.digests)
                usage += TokenCount(estimate_tokens(asked.question), asked.expected)
            if progress:
                progress()
    return VlmForecast(
        host=endpoint.host,
        model=endpoint.model,
        mode=settings.mode,
        assets=assets,
        hulls=hulls,
        questions=questions,
        known=known,
        pictures=pictures,
        input=usage.input,
        output=usage.output,
        cost=endpoint.price(usage) if endpoint.is_priced else None,
        unreadable=tuple(unreadable),
        key=endpoint.key_name,
        key_is_set=endpoint.has_key,
    )
