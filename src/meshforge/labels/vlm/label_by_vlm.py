"""Labels for the hulls of a project from a model, each asset written as soon as it is answered; and a forecast of
what that sends and costs."""

from __future__ import annotations

from collections.abc import Callable, Collection, Generator, Mapping, Sequence
from contextlib import AbstractContextManager, closing
from dataclasses import dataclass, field, replace
from functools import partial

from meshforge.batch import IN_PROCESS, ExecutionOptions, WorkerFailure, execute
from meshforge.common import UsageError, describe_error
from meshforge.labels.merge import LabelOutcome, LabelWriter, can_replace_less_certain
from meshforge.labels.vlm.approval import check_approved
from meshforge.labels.vlm.cache import write_page
from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.endpoint import TokenCount, endpoint_of
from meshforge.labels.vlm.labeller import Labeller, OpenAnswers
from meshforge.labels.vlm.limits import Usage, estimate_tokens
from meshforge.labels.vlm.prompt import HullQuestion, PromptConfig, build_questions, prompt_config_of
from meshforge.store import AssetFiles, Store, VlmSettings, hull_digests
from meshforge.symbolic import GIVEN_SOURCES, SymbolicMesh

UsageCallback = Callable[[Usage], None]
VlmWriteBlock = Callable[[], AbstractContextManager[object]]


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
    """What came of asking a model. reports: of all assets, in their order; usage: what was asked, and its cost.

    open: why hulls that were asked about have no label from it, by asset and hull; unasked: assets that were not
    reached, and ended: why, None where all were; blind: the model did not name the colour of a red picture.
    """

    reports: tuple[LabelOutcome, ...]
    usage: Usage
    open: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    unasked: tuple[str, ...] = ()
    ended: str | None = None
    blind: bool = False


def label_with_vlm(
    store: Store,
    settings: VlmSettings,
    progress: UsageCallback | None = None,
    stop: Callable[[], bool] | None = None,
    write_block: VlmWriteBlock | None = None,
    execution: ExecutionOptions = IN_PROCESS,
    typed: Collection[str] = (),
) -> VlmResult:
    """Ask about all hulls without a label of a person or a file; see `LabelStore.label_with_vlm`."""
    check_approved(endpoint_of(settings), typed)
    config = prompt_config_of(settings, store.vocabulary)
    client = Client(endpoint_of(settings), store.layout.vlm, max_cost=settings.max_cost, stop=stop or (lambda: False))
    with (
        closing(client),
        closing(Labeller(client, config, examples_of(store, settings))) as labeller,
        closing(draw_assets(store, config, execution)) as pictures,
    ):
        run = _Run(store, client, labeller, write_block, progress)
        while not (client.end or (stop and stop())) and (found := next(pictures, None)):
            run.begin(*found)
        run.finish()
    return run.result()


class _Run:
    """Assets on their way: asked about at one time, written as they are done."""

    def __init__(
        self,
        store: Store,
        client: Client,
        labeller: Labeller,
        write_block: VlmWriteBlock | None,
        progress: UsageCallback | None,
    ) -> None:
        self._store, self._client, self._labeller = store, client, labeller
        self._write_block, self._progress = write_block, progress
        self._writer = LabelWriter(store)
        self._pending: dict[str, tuple[Mapping[str, str], OpenAnswers]] = {}
        self._reports: dict[str, LabelOutcome] = {}
        self._open: dict[str, Mapping[str, str]] = {}
        self._unwritten: list[Callable[[], None]] = []

    def begin(self, asset: str, found: AssetQuestions) -> None:
        """Ask about an asset; write those of which all is said by then."""
        if found.error:
            self._reports[asset] = LabelOutcome(asset, problems=(found.error,))
            self._advance()
            return
        self._pending[asset] = found.hulls, self._labeller.ask(found.wanted, found.questions)
        for done in [name for name, (_, pending) in self._pending.items() if pending.is_done()]:
            self._write(done)

    def finish(self) -> None:
        """Wait for all answers, and write what they say."""
        for asset in list(self._pending):
            self._write(asset)
        if self._write_block and self._unwritten:
            with self._write_block():
                for write in self._unwritten:
                    write()

    def result(self) -> VlmResult:
        """What came of it all. Raises the error that ended it, where nothing came of it."""
        end, usage = self._client.end, self._client.usage
        if end and not usage.answered + usage.cached:
            raise end
        reports = tuple(self._reports[asset] for asset in self._store.assets() if asset in self._reports)
        unasked = tuple(asset for asset in self._store.assets() if asset not in self._reports)
        ended = end.message if end else "stopped" if unasked else None
        return VlmResult(reports, usage, self._open, unasked, ended, self._client.is_blind)

    def _write(self, asset: str) -> None:
        hulls, pending = self._pending.pop(asset)
        answers = pending.result()
        end = self._client.end
        failed = tuple(problem for problem in answers.failed if end is None or problem != end.sentence)
        if end and answers.failed and not answers.labels:
            return  # the result says once that asking ended, and which assets were not reached
        if answers.open:
            self._open[asset] = answers.open
        if answers.asked:
            write_page(self._store.layout.vlm, asset, answers)

        def write() -> None:
            report = self._writer.write(asset, hulls, answers.labels, can_replace_less_certain)
            self._reports[asset] = replace(report, problems=(*report.problems, *failed))

        if self._write_block:
            self._unwritten.append(write)
        else:
            write()
        self._advance()

    def _advance(self) -> None:
        if self._progress:
            self._progress(self._client.usage)


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
    settings: VlmSettings,
    progress: Callable[[], None] | None = None,
    stop: Callable[[], bool] | None = None,
    vocabulary: Sequence[str] | None = None,
    execution: ExecutionOptions = IN_PROCESS,
) -> VlmForecast:
    """What `label_with_vlm` would send; questions that have to be asked again come on top of it."""
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
            if found.error:  # `label_with_vlm` says then what is wrong
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
