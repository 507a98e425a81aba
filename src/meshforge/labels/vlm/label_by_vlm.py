"""Labels from a model: of exemplars, propagated to all hulls that are like them, or of every hull; and a
forecast of what that costs."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Generator, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import closing, contextmanager
from dataclasses import dataclass, replace

from meshforge.batch import IN_PROCESS, ExecutionOptions
from meshforge.label_model import reference_label
from meshforge.labels.family_comparison import FamilyDescription, compare_assets, describe_assets
from meshforge.labels.labeler import AssetLabels, Labeler, LabelFamily, LabelProposal, ignore_stage
from meshforge.labels.vlm.answer import NOT_KNOWN, VlmAnswers, ask_questions, write_page
from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.cost import Usage, estimate_tokens
from meshforge.labels.vlm.endpoint import Endpoint, TokenCount, check_approved
from meshforge.labels.vlm.plan import DrawnQuestions, QuestionPlan, draw_questions, plan_every_hull, plan_exemplars
from meshforge.labels.vlm.prompt import PromptConfig
from meshforge.store import Store, VlmSettings
from meshforge.symbolic import Label

_SURE = 0.7  # of what one clear look says
_LIKE_UNKNOWN = "the model does not know hulls that are like it"
_WAITING = 4  # questions for each thread that are under way or wait; no more are drawn ahead


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
    """Asks a vision-language model about exemplars, and propagates their labels to hulls that are like them; or asks
    about every hull, where the settings say so. Labels of people and files stay. Answers are kept, so that none is paid
    for twice.

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
        config = PromptConfig(family.vocabulary, settings)
        if settings.every_hull:
            return LabelProposal(self._label_every_hull(family, config))
        self.work = "propagating"
        return LabelProposal(self._label_by_exemplars(family, config))

    def _label_every_hull(self, family: LabelFamily, config: PromptConfig) -> Generator[AssetLabels, None, None]:
        reached = set[str]()
        with self._open_client(family, config, reached) as client:
            for drawn, said in _ask(client, family, config, plan_every_hull(family.store)):
                ((asset, hulls),) = drawn.assets.items()
                if client.end and said.failed and not said.labels:
                    continue  # the result says once that asking ended, and which assets were not reached
                reached.add(asset)
                problems = _list_problems(client, drawn, said)
                labels, left = said.labels.get(asset, {}), said.open.get(asset, {})
                yield (
                    AssetLabels(asset, error=drawn.error)
                    if drawn.error
                    else _propose(asset, hulls, labels, {}, left, problems)
                )

    def _label_by_exemplars(self, family: LabelFamily, config: PromptConfig) -> Generator[AssetLabels, None, None]:
        """All labels are known before the first is given. Where asking ended early, only those that the model gave."""
        described, reached = describe_assets(family), set[str]()
        plans, answers = plan_exemplars(described), list[tuple[DrawnQuestions, VlmAnswers]]()
        with self._open_client(family, config, reached) as client:
            with family.stage(len(plans), "asking") as advance:
                for one in _ask(client, family, config, plans):
                    answers.append(one)
                    advance()
            labels = {asset: own for _, said in answers for asset, own in said.labels.items()}
            left = {asset: own for _, said in answers for asset, own in said.open.items()}
            problems = {next(iter(drawn.assets)): _list_problems(client, drawn, said) for drawn, said in answers}
            is_whole = not client.end and len(answers) == len(plans)
            reached |= {*described.hulls, *described.lost} if is_whole else {asset for asset in labels if labels[asset]}
        shares = dict(_propagate(family, described, labels, left, config.unknown)) if is_whole else {}
        for asset in family.store.assets():
            if asset in described.lost:
                yield AssetLabels(asset, error=described.lost[asset])
            elif asset in reached:
                own, known = shares.get(asset, {}), described.current[asset]
                alike = {hull: _LIKE_UNKNOWN for hull, one in own.items() if one.name == config.unknown}
                bare = {hull: why for hull, why in (alike | left.get(asset, {})).items() if hull not in known}
                given = {hull: one for hull, one in own.items() if hull not in alike}
                rows = labels.get(asset, {}), given, bare, problems.get(asset, ())
                yield _propose(asset, described.hulls[asset], *rows)

    @contextmanager
    def _open_client(self, family: LabelFamily, config: PromptConfig, reached: Collection[str]) -> Iterator[Client]:
        """A client, and the result when all is asked. reached: the assets whose labels are known by then."""
        settings, stop = config.settings, family.execution.stop or (lambda: False)
        folder = family.store.layout.vlm
        with closing(Client(Endpoint(settings), folder, max_cost=settings.max_cost, stop=stop)) as client:
            yield client
        if client.end and not client.usage.answered + client.usage.cached:
            raise client.end
        unasked = tuple(asset for asset in family.store.assets() if asset not in reached)
        ended = client.end.message if client.end else "stopped" if unasked else None
        self.result = VlmResult(client.usage, unasked, ended, client.is_blind)


def _ask(
    client: Client, family: LabelFamily, config: PromptConfig, plans: Sequence[QuestionPlan]
) -> Iterator[tuple[DrawnQuestions, VlmAnswers]]:
    """Yield questions with their answers, in order, as long as asking goes on; several are under way at once."""
    stop, concurrency = family.execution.stop or (lambda: False), config.settings.concurrency
    threads = ThreadPoolExecutor(concurrency, "asking")
    waiting = deque[tuple[DrawnQuestions, Future[VlmAnswers]]]()

    def take() -> tuple[DrawnQuestions, VlmAnswers]:
        drawn, future = waiting.popleft()
        while not future.done():
            stop()  # it says so as soon as a stop is wanted, though what is under way is waited for
            wait([future], timeout=0.1)
        said = future.result()
        if said.asked:
            write_page(family.store.layout.vlm, drawn.plan.name, said)
        return drawn, said.only(drawn.wanted)

    drawing = replace(family, execution=replace(family.execution, stop=None))
    try:
        with closing(draw_questions(drawing, plans, config)) as questions:
            while not (client.end or stop()) and (one := next(questions, None)):
                waiting.append((one, threads.submit(ask_questions, client, config, one.questions)))
                while waiting and (len(waiting) > _WAITING * concurrency or waiting[0][1].done()):
                    yield take()
        while waiting:
            yield take()
    finally:  # no more is asked; what is under way is kept when its answer comes, yet not waited for
        threads.shutdown(wait=False, cancel_futures=True)


def _propose(
    asset: str,
    hulls: Mapping[str, str],
    labels: Mapping[str, Label],
    shares: Mapping[str, Label],
    left: Mapping[str, str],
    problems: Sequence[str],
) -> AssetLabels:
    """What is proposed for an asset: labels of the model, those propagated from these, and hulls that it left open."""
    given = {**{hull: label for hull, label in shares.items() if hull not in left}, **labels}
    reasons = {hull: ("model" if hull in labels else "likeness", hull) for hull in given}
    return AssetLabels(asset, hulls, given, reasons, problems, open=left)


def _list_problems(client: Client, drawn: DrawnQuestions, said: VlmAnswers) -> list[str]:
    end = client.end.sentence if client.end else None
    return [*([drawn.error] if drawn.error else []), *(problem for problem in said.failed if problem != end)]


def _propagate(
    family: LabelFamily,
    described: FamilyDescription,
    answers: Mapping[str, Mapping[str, Label]],
    left: Mapping[str, Mapping[str, str]],
    unknown: str,
) -> Iterator[tuple[str, dict[str, Label]]]:
    """Yield the labels of all hulls, by asset, that follow from answers and from what people and files say.

    What the model does not know counts as a label, too: `unknown` is that of hulls which are like these.
    """
    heard = dict[str, dict[str, Label]]()
    for asset, own in described.current.items():
        heard[asset] = {h: Label(unknown, _SURE, "vlm") for h, why in left.get(asset, {}).items() if why == NOT_KNOWN}
        heard[asset] |= answers.get(asset, {})
        heard[asset] |= {hull: one for hull, one in own.items() if reference_label(one)}
    if not any(heard.values()):
        return iter(())
    family = replace(family, vocabulary=(*family.vocabulary, unknown))
    compared = compare_assets(family, lambda label: label, replace(described, current=heard))
    labels = [label for place in range(len(compared.assets)) for label in compared.found.labels(place)]
    return replace(compared, current=described.current).share_out(labels)


@dataclass(slots=True)
class VlmForecast:
    """What asking would send. host, model: who is asked; every_hull: about every hull, or exemplars; key: the
    environment variable of the key, empty where none is wanted, and whether it is set.

    assets, hulls: how many of them are asked about; questions, of which `known` have their answers already; pictures,
    input, output: what the others send, and tokens that this may come to; cost: their price [$], None where prices are
    not known. unreadable: assets that cannot be read or drawn.
    """

    host: str
    model: str
    every_hull: bool
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
    progress: Callable[[], None] = lambda: None,
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
    found = VlmForecast(endpoint.host, settings.model, settings.every_hull, endpoint.key_name, endpoint.has_key)
    family = LabelFamily(store, config.vocabulary, execution, ignore_stage)
    client = Client(endpoint, store.layout.vlm, max_cost=settings.max_cost)
    described = None if settings.every_hull else describe_assets(family)
    found.unreadable = tuple(described.lost) if described else ()
    plans = plan_exemplars(described) if described else plan_every_hull(store)
    with closing(draw_questions(family, plans, config)) as drawn:
        while not (stop and stop()) and (one := next(drawn, None)):
            if one.error:  # `VlmLabeler` says then what is wrong
                found.unreadable += (*one.assets,)
            found.assets += len({asset for asset, _ in one.wanted})
            found.hulls += len(one.wanted)
            for asked in one.questions:
                found.questions += 1
                if client.find_answer(asked.question):
                    found.known += 1
                    continue
                found.pictures += len(asked.question.digests)
                found.input += estimate_tokens(asked.question)
                found.output += asked.expected
            for _ in one.assets:
                progress()
    if endpoint.is_priced:
        found.cost = endpoint.price(TokenCount(found.input, found.output))
    return found
