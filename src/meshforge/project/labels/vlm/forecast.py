"""What asking a model would send and cost, with nothing sent."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import closing
from dataclasses import dataclass
from typing import TYPE_CHECKING

from meshforge.batch import HERE, Spread
from meshforge.project.labels.vlm.drawing import drawn
from meshforge.project.labels.vlm.labelling import examples_of
from meshforge.project.labels.vlm.settings import VlmSettings

if TYPE_CHECKING:
    from meshforge.project.project import Project


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


def forecast(
    project: Project,
    settings: VlmSettings,
    progress: Callable[[], None] | None = None,
    stop: Callable[[], bool] | None = None,
    vocabulary: Sequence[str] | None = None,
    spread: Spread = HERE,
) -> VlmForecast:
    """What `label_with_vlm` would send; questions that have to be asked again come on top of it.

    progress: called for each asset; stop: says when to look at no more; vocabulary: another one than the project's;
    spread: how the pictures are drawn.
    """
    from meshforge.perception.vlm import Client, Labeller, Usage, estimate

    endpoint, manner = settings.endpoint(), settings.manner(project.vocabulary if vocabulary is None else vocabulary)
    client = Client(endpoint, project.layout.vlm, max_cost=settings.max_cost)
    assets = hulls = questions = known = pictures = 0
    usage, unreadable = Usage(), list[str]()
    with (
        closing(client),
        closing(Labeller(client, manner, examples_of(project, settings))) as labeller,
        closing(drawn(project, manner, spread)) as drawings,
    ):
        while not (stop and stop()) and (next_one := next(drawings, None)):
            asset, found = next_one
            if found.error:  # `label_with_vlm` says then what is wrong
                unreadable.append(asset)
                continue
            assets, hulls = assets + bool(found.wanted), hulls + len(found.wanted)
            for look in map(labeller.add_examples, found.looks):
                questions += 1
                if client.find_answer(look.question):
                    known += 1
                    continue
                pictures += len(look.question.digests)
                usage += Usage(estimate(look.question), look.expected)
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
