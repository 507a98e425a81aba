"""Labels from a model: of exemplars, propagated to all hulls that are like them, or of every hull; and what that would
cost."""

from collections.abc import Callable, Collection, Generator, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass, replace
from threading import BoundedSemaphore
from typing import Any

from meshforge.label_model import reference_label
from meshforge.labels.family_comparison import FamilyDescription, compare_assets
from meshforge.labels.labeler import AssetLabels, Labeler, LabelFamily, LabelProposal
from meshforge.labels.vlm.answer import VlmAnswers, ask_questions
from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.cost import CostLimiter, Usage
from meshforge.labels.vlm.endpoint import Endpoint, check_approved
from meshforge.labels.vlm.plan import QuestionBatch, draw_questions, plan_questions
from meshforge.labels.vlm.prompt import PromptConfig
from meshforge.labels.vlm.question import Reply
from meshforge.store import VlmSettings
from meshforge.symbolic import Label

_LIKE_UNKNOWN = "the model does not know hulls that are like it"
_AHEAD = 4  # questions for each thread that are under way or wait; no more are drawn ahead


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
    about every hull, where the settings say so. Answers are kept, so that none is paid for twice.

    settings: those of the project when None; typed: addresses that the user typed, and thereby approves. `stop` of the
    execution ends the asking; what the model said by then is proposed, and not propagated. result: how it went, once
    all is proposed. Raises MeshForgeError where nothing could be asked at all.
    """

    name = "vlm"
    about = "labels by a vision-language model"

    def __init__(self, settings: VlmSettings | None = None, typed: Collection[str] = ()) -> None:
        self.settings, self.typed = settings, typed
        self.result = VlmResult(Usage())

    def propose(self, family: LabelFamily) -> LabelProposal:
        settings = self.settings or family.store.settings.vlm
        check_approved(Endpoint(settings), self.typed)
        labels = [*self._label(family, PromptConfig(family.require_vocabulary(), settings))]
        return LabelProposal(one for one in labels)

    def _label(self, family: LabelFamily, config: PromptConfig) -> Generator[AssetLabels, None, None]:
        store, settings, stop = family.store, config.settings, family.execution.stop or (lambda: False)
        described, plans = plan_questions(family, config)
        lost, hulls = (described.lost, dict(described.hulls)) if described else ({}, {})
        labels, left = dict[str, Mapping[str, Label]](), dict[str, Mapping[str, str]]()
        problems, reached = dict[str, tuple[str, ...]](), set[str]()
        client = Client(Endpoint(settings), store.layout.vlm, max_cost=settings.max_cost, stop=stop)
        with closing(client), family.stage(len(plans), "asking") as advance:
            asked = _ask(client, config, draw_questions(family, plans, config), stop, advance)
            for drawn, answers in asked:
                hulls |= drawn.assets
                labels |= answers.labels
                left |= answers.open
                lost |= dict.fromkeys(drawn.plan, drawn.error) if drawn.error else {}
                problems[next(iter(drawn.plan))] = answers.failed
                reached |= {*drawn.plan} if answers.labels or not answers.failed else set()
        end = client.end
        if end and not client.usage.answered + client.usage.cached:
            raise end
        is_whole = not end and len(asked) == len(plans)
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
    client: Client,
    config: PromptConfig,
    questions: Generator[QuestionBatch, None, None],
    stop: Callable[[], bool],
    advance: Callable[[], None],
) -> list[tuple[QuestionBatch, VlmAnswers]]:
    """Return questions with their answers, in order, as far as asking goes on; several are under way at once."""
    room = BoundedSemaphore(_AHEAD * config.settings.concurrency)

    def ask(one: QuestionBatch) -> tuple[QuestionBatch, VlmAnswers]:
        try:
            return replace(one, questions=()), ask_questions(client, config, one.questions, one.wanted)
        finally:
            room.release()
            advance()

    threads, asked = ThreadPoolExecutor(config.settings.concurrency, "asking"), list[Future[Any]]()
    try:
        with closing(questions):
            while not (client.end or stop()) and (one := next(questions, None)):
                room.acquire()
                asked.append(threads.submit(ask, one))
        return [future.result() for future in asked]
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
    """What asking would send. assets, hulls: how many of them are asked about; pictures: that are sent; usage: how
    many answers there would be, and have been, and about how many tokens and dollars those would take.

    unreadable: assets that cannot be read or drawn.
    """

    usage: Usage
    assets: int = 0
    hulls: int = 0
    pictures: int = 0
    unreadable: tuple[str, ...] = ()


def forecast_vlm(family: LabelFamily, settings: VlmSettings) -> VlmForecast:
    """Return what `VlmLabeler` would send and what that costs, with nothing sent."""
    endpoint, config = Endpoint(settings), PromptConfig(family.require_vocabulary(), settings)
    client, limiter = Client(endpoint, family.store.layout.vlm, max_cost=settings.max_cost), CostLimiter(endpoint)
    described, plans = plan_questions(family, config)
    found = VlmForecast(Usage(), unreadable=tuple(described.lost) if described else ())
    with family.stage(len(plans), "drawing") as advance, closing(draw_questions(family, plans, config)) as drawn:
        for one in drawn:
            found.unreadable += (*one.plan,) if one.error else ()  # `VlmLabeler` says then what is wrong
            found.assets += len({asset for asset, _ in one.wanted})
            found.hulls += len(one.wanted)
            for question in (asked.question for asked in one.questions):
                if client.find_answer(question):
                    limiter.count(cached=1)
                else:
                    found.pictures += len([*question.pictures])
                    made = (question.limit - settings.room) // 2
                    limiter.charge(question, Reply("", output_tokens=made, estimated=True))
            advance()
    found.usage = limiter.usage
    return found
