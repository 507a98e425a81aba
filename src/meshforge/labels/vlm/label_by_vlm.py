"""Labels from a model: of exemplars, propagated to all hulls that are like them, or of every hull; and what that would
cost."""

from collections.abc import Callable, Collection, Generator, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import closing
from dataclasses import dataclass, replace

from meshforge.batch import IN_PROCESS, ExecutionOptions
from meshforge.label_model import reference_label
from meshforge.labels.family_comparison import FamilyDescription, compare_assets
from meshforge.labels.labeler import AssetLabels, Labeler, LabelFamily, LabelProposal, ignore_stage
from meshforge.labels.vlm.answer import VlmAnswers, ask_questions
from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.cost import Usage, estimate_tokens
from meshforge.labels.vlm.endpoint import Endpoint, TokenCount, check_approved
from meshforge.labels.vlm.plan import QuestionBatch, draw_questions, plan_questions
from meshforge.labels.vlm.prompt import PromptConfig
from meshforge.store import Store, VlmSettings
from meshforge.symbolic import Label

_LIKE_UNKNOWN = "the model does not know hulls that are like it"
_WAITING = 4  # questions for each thread that are under way or wait; no more are drawn ahead


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
    but to this machine nothing is sent before `approve_host`. `stop` of the execution ends the asking; the labels that
    the model gave by then are proposed, and not propagated. result: how it went, once all is proposed.
    Raises MeshForgeError where nothing could be asked at all.
    """

    name = "vlm"
    about = "labels by a vision-language model"

    def __init__(self, settings: VlmSettings | None = None, typed: Collection[str] = ()) -> None:
        self.settings, self.typed = settings, typed
        self.result = VlmResult(Usage())

    def propose(self, family: LabelFamily) -> LabelProposal:
        settings = self.settings or family.store.settings.vlm
        check_approved(Endpoint(settings), self.typed)
        labels = [*self._label(family, PromptConfig(family.vocabulary, settings))]
        return LabelProposal(one for one in labels)

    def _label(self, family: LabelFamily, config: PromptConfig) -> Generator[AssetLabels, None, None]:
        store, settings, stop = family.store, config.settings, family.execution.stop or (lambda: False)
        described, plans = plan_questions(family, config)
        lost, hulls = (described.lost, dict(described.hulls)) if described else ({}, {})
        labels, left = dict[str, Mapping[str, Label]](), dict[str, Mapping[str, str]]()
        problems, reached, done = dict[str, tuple[str, ...]](), set[str](), 0
        client = Client(Endpoint(settings), store.layout.vlm, max_cost=settings.max_cost, stop=stop)
        with closing(client), family.stage(len(plans), "asking") as advance:
            for drawn, answers in _ask(client, family, config, draw_questions(family, plans, config)):
                hulls |= drawn.assets
                labels |= answers.labels
                left |= answers.open
                lost |= dict.fromkeys(drawn.plan, drawn.error) if drawn.error else {}
                problems[next(iter(drawn.plan))] = answers.failed
                reached |= {*drawn.plan} if answers.labels or not answers.failed else set()
                done += 1
                advance()
        end = client.end
        if end and not client.usage.answered + client.usage.cached:
            raise end
        is_whole = not end and done == len(plans)
        ended = None if is_whole else end.message if end else "stopped"
        unasked = () if is_whole else tuple(asset for asset in store.assets() if asset not in reached)
        self.result = VlmResult(client.usage, unasked, ended, client.is_blind)
        shares = _propagate(family, described, labels, config.unknown) if described and is_whole else {}
        for asset in (asset for asset in store.assets() if is_whole or asset in reached):
            if asset in lost:
                yield AssetLabels(asset, error=lost[asset])
                continue
            given, known = {**shares.get(asset, {}), **labels.get(asset, {})}, described.current if described else {}
            bare = {hull: _LIKE_UNKNOWN for hull, label in given.items() if label.name == config.unknown}
            bare = {h: why for h, why in {**bare, **left.get(asset, {})}.items() if h not in known.get(asset, {})}
            given = {hull: one for hull, one in given.items() if hull not in bare and one.name != config.unknown}
            reasons = {hull: ("model" if label.source == "vlm" else "likeness", hull) for hull, label in given.items()}
            failed = [problem for problem in problems.get(asset, ()) if not end or problem != end.sentence]
            yield AssetLabels(asset, hulls[asset], given, reasons, failed, open=bare)


def _ask(
    client: Client, family: LabelFamily, config: PromptConfig, questions: Generator[QuestionBatch, None, None]
) -> Iterator[tuple[QuestionBatch, VlmAnswers]]:
    """Yield questions with their answers, in order, as long as asking goes on; several are under way at once."""
    stop, concurrency = family.execution.stop or (lambda: False), config.settings.concurrency
    threads = ThreadPoolExecutor(concurrency, "asking")
    waiting = list[tuple[QuestionBatch, Future[VlmAnswers]]]()

    def take() -> tuple[QuestionBatch, VlmAnswers]:
        drawn, future = waiting.pop(0)
        while not future.done():
            stop()  # it says so as soon as a stop is wanted, though what is under way is waited for
            wait([future], timeout=0.1)
        return drawn, future.result()

    try:
        with closing(questions):
            while not (client.end or stop()) and (one := next(questions, None)):
                waiting.append((one, threads.submit(ask_questions, client, config, one.questions, one.wanted)))
                while waiting and (len(waiting) > _WAITING * concurrency or waiting[0][1].done()):
                    yield take()
        while waiting:
            yield take()
    finally:  # no more is asked; what is under way is kept when its answer comes, yet not waited for
        threads.shutdown(wait=False, cancel_futures=True)


def _propagate(
    family: LabelFamily, described: FamilyDescription, labels: Mapping[str, Mapping[str, Label]], unknown: str
) -> Mapping[str, Mapping[str, Label]]:
    """The labels of all hulls, by asset, that follow from those of a model and from what people and files say.

    unknown: a label like others, that hulls get which are like those that the model does not know.
    """
    given = {a: {h: one for h, one in own.items() if reference_label(one)} for a, own in described.current.items()}
    heard = {asset: {**labels.get(asset, {}), **own} for asset, own in given.items()}
    if not any(heard.values()):
        return {}
    family = replace(family, vocabulary=(*family.vocabulary, unknown))
    compared = compare_assets(family, lambda asset, _: heard[asset], described=described)
    found = [label for place in range(len(compared.assets)) for label in compared.found.labels(place)]
    return dict(compared.share_out(found))


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
    stop: Callable[[], bool] = lambda: False,
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
    described, plans = plan_questions(family, config)
    found.unreadable = tuple(described.lost) if described else ()
    with closing(draw_questions(family, plans, config)) as drawn:
        while not stop() and (one := next(drawn, None)):
            found.unreadable += (*one.plan,) if one.error else ()  # `VlmLabeler` says then what is wrong
            found.assets += len({asset for asset, _ in one.wanted})
            found.hulls += len(one.wanted)
            found.questions += len(one.questions)
            fresh = [asked for asked in one.questions if not client.find_answer(asked.question)]
            found.known += len(one.questions) - len(fresh)
            found.pictures += sum(len(asked.question.digests) for asked in fresh)
            found.input += sum(estimate_tokens(asked.question) for asked in fresh)
            found.output += sum((asked.question.limit - settings.room) // 2 for asked in fresh)
            for _ in one.plan:
                progress()
    if endpoint.is_priced:
        found.cost = endpoint.price(TokenCount(found.input, found.output))
    return found
