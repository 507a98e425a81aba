"""Labels from a model, each asset written as soon as it is answered; and a forecast of what that costs."""

from __future__ import annotations

from collections.abc import Callable, Collection, Generator, Iterable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass, field, replace
from functools import partial

from meshforge.batch import IN_PROCESS, ExecutionOptions, WorkerFailure, execute
from meshforge.common import UsageError, describe_error
from meshforge.labels.labeler import AssetLabels, Labeler, LabelFamily, LabelProposal
from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.cost import Usage, estimate_tokens
from meshforge.labels.vlm.endpoint import Endpoint, TokenCount, check_approved
from meshforge.labels.vlm.mesh_asker import MeshAsker, OpenAnswers, write_page
from meshforge.labels.vlm.prompt import HullQuestion, PromptConfig, build_questions
from meshforge.store import AssetFiles, Store, VlmSettings, hull_digests
from meshforge.symbolic import GIVEN_SOURCES, SymbolicMesh


@dataclass(frozen=True, slots=True)
class _AssetQuestions:
    """What is asked about an asset. hulls: digests by name, in order; wanted: the hulls whose labels may change.

    error: why it cannot be read or drawn.
    """

    asset: str
    hulls: Mapping[str, str] = field(default_factory=dict)
    wanted: tuple[str, ...] = ()
    questions: tuple[HullQuestion, ...] = ()
    error: str | None = None


def _draw_assets(
    store: Store, config: PromptConfig, execution: ExecutionOptions
) -> Generator[_AssetQuestions, None, None]:
    """All assets of a project, in their order, as soon as they are drawn; some are drawn ahead of the others."""
    assets = store.assets()
    items = list(zip(assets, store.asset_files(assets), strict=True))
    with closing(execute(partial(_draw, config), items, execution)) as work:
        for asset, found in zip(assets, work, strict=True):
            if isinstance(found, WorkerFailure):
                found = _AssetQuestions(asset, error=f"{store.path(asset)}: {found.why}")
            yield found


def _draw(config: PromptConfig, item: tuple[str, AssetFiles]) -> _AssetQuestions:
    asset, place = item
    try:
        mesh = place.read_mesh()
        wanted = tuple(hull.name for hull in mesh.hulls if hull.source not in GIVEN_SOURCES)
        return _AssetQuestions(asset, hull_digests(mesh), wanted, tuple(build_questions(mesh, wanted, config, asset)))
    except Exception as error:  # one asset that cannot be drawn must not cost the others their labels
        return _AssetQuestions(asset, error=describe_error(error, asset))


def check_vlm_settings(settings: VlmSettings, vocabulary: Sequence[str], typed: Collection[str] = ()) -> None:
    """Raise UsageError where nothing could be asked: no model, no key, no approval, or no vocabulary.

    typed: addresses that the user typed for this run, who thereby approves them.
    """
    endpoint = Endpoint(settings)
    endpoint.key()
    check_approved(endpoint, typed)
    PromptConfig(tuple(vocabulary), settings)


@dataclass(frozen=True, slots=True)
class VlmResult:
    """How asking a model went. usage: what was asked, and its cost.

    unasked: assets that were not reached, and ended: why, None where all were; blind: the model did not name the colour
    of a red picture.
    """

    usage: Usage
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
        self.settings, self.typed = settings, typed
        self.result = VlmResult(Usage())

    def propose(self, family: LabelFamily) -> LabelProposal:
        settings = self.settings or family.store.settings.vlm
        check_approved(Endpoint(settings), self.typed)
        return LabelProposal(self._ask(family, PromptConfig(family.vocabulary, settings)))

    def _ask(self, family: LabelFamily, config: PromptConfig) -> Generator[AssetLabels, None, None]:
        store, stop = family.store, family.execution.stop or (lambda: False)
        pending, reached = dict[str, tuple[_AssetQuestions, OpenAnswers]](), set[str]()
        with _open_asker(store, config, replace(family.execution, stop=None), stop) as (client, asker, drawn):

            def finish(assets: Iterable[str]) -> Iterator[AssetLabels]:
                for asset in assets:
                    if labels := _read_answers(store, client, *pending.pop(asset)):
                        reached.add(asset)
                        yield labels

            while not (client.end or stop()) and (one := next(drawn, None)):
                pending[one.asset] = one, asker.ask(one.wanted, one.questions)
                yield from finish([asset for asset, (_, answers) in pending.items() if answers.is_done()])
            yield from finish(list(pending))
        if client.end and not client.usage.answered + client.usage.cached:
            raise client.end
        unasked = tuple(asset for asset in store.assets() if asset not in reached)
        ended = client.end.message if client.end else "stopped" if unasked else None
        self.result = VlmResult(client.usage, unasked, ended, client.is_blind)


def _read_answers(store: Store, client: Client, drawn: _AssetQuestions, pending: OpenAnswers) -> AssetLabels | None:
    if drawn.error:
        return AssetLabels(drawn.asset, error=drawn.error)
    answers, end = pending.result(), client.end
    if end and answers.failed and not answers.labels:
        return None  # the result says once that asking ended, and which assets were not reached
    if answers.asked:
        write_page(store.layout.vlm, drawn.asset, answers)
    failed = tuple(problem for problem in answers.failed if end is None or problem != end.sentence)
    reasons = {hull: ("model", hull) for hull in answers.labels}
    return AssetLabels(drawn.asset, drawn.hulls, answers.labels, reasons, failed, open=answers.open)


@contextmanager
def _open_asker(
    store: Store, config: PromptConfig, execution: ExecutionOptions, stop: Callable[[], bool] = lambda: False
) -> Iterator[tuple[Client, MeshAsker, Iterator[_AssetQuestions]]]:
    """What asks about a project, and its assets as they are drawn."""
    settings = config.settings
    client = Client(Endpoint(settings), store.layout.vlm, max_cost=settings.max_cost, stop=stop)
    with (
        closing(client),
        closing(MeshAsker(client, config, _read_examples(store, settings))) as asker,
        closing(_draw_assets(store, config, execution)) as drawn,
    ):
        yield client, asker, drawn


def _read_examples(store: Store, settings: VlmSettings) -> Iterator[SymbolicMesh]:
    """The labelled assets that are shown as examples, with labels that somebody gave."""
    for asset in settings.examples:
        mesh = store.mesh(asset)
        guessed = {hull.name: None for hull in mesh.hulls if hull.source not in GIVEN_SOURCES}
        if len(guessed) == len(mesh.hulls):
            remedy = "Label its hulls by hand, or take it out of examples in [vlm]."
            raise UsageError("this example has no label that a person or a file gave", where=asset, remedy=remedy)
        yield mesh.with_labels(guessed)


@dataclass(slots=True)
class VlmForecast:
    """What asking would send. host, model, mode: who is asked, and how; key: the environment variable of the key, empty
    where none is wanted, and whether it is set.

    assets, hulls: how many of them are asked about; questions, of which `known` have their answers already; pictures,
    input, output: what the others send, and tokens that this may come to; cost: their price [$], None where prices are
    not known. unreadable: assets that cannot be read or drawn.
    """

    host: str
    model: str
    mode: str
    key: str
    key_is_set: bool
    assets: int = 0
    hulls: int = 0
    questions: int = 0
    known: int = 0
    pictures: int = 0
    input: int = 0
    output: int = 0
    cost: float | None = None
    unreadable: tuple[str, ...] = ()


def forecast_vlm(
    store: Store,
    settings: VlmSettings | None = None,
    *,
    progress: Callable[[], None] | None = None,
    stop: Callable[[], bool] | None = None,
    vocabulary: Sequence[str] | None = None,
    execution: ExecutionOptions = IN_PROCESS,
) -> VlmForecast:
    """Return what `VlmLabeler` would send and what that costs, with nothing sent; vocabulary: one to try instead.

    Questions that have to be asked again come on top of it.
    """
    settings = settings or store.settings.vlm
    endpoint = Endpoint(settings)
    config = PromptConfig(store.vocabulary if vocabulary is None else tuple(vocabulary), settings)
    found = VlmForecast(endpoint.host, settings.model, settings.mode, endpoint.key_name, endpoint.has_key)
    with _open_asker(store, config, execution) as (client, asker, drawn):
        while not (stop and stop()) and (one := next(drawn, None)):
            if one.error:  # `VlmLabeler` says then what is wrong
                found.unreadable += (one.asset,)
                continue
            found.assets += bool(one.wanted)
            found.hulls += len(one.wanted)
            for asked in map(asker.add_examples, one.questions):
                found.questions += 1
                if client.find_answer(asked.question):
                    found.known += 1
                    continue
                found.pictures += len(asked.question.digests)
                found.input += estimate_tokens(asked.question)
                found.output += asked.expected
            if progress:
                progress()
    if endpoint.is_priced:
        found.cost = endpoint.price(TokenCount(found.input, found.output))
    return found
