"""A vision-language model as a labeller of the benchmark's meshes."""

from __future__ import annotations

import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter

from benchmark.journal import JOURNALS
from benchmark.labels.families import Family
from benchmark.labels.methods import LabellerOutput, Labels, Method
from meshforge.labels.vlm.answer import VlmAnswers, ask_questions
from meshforge.labels.vlm.client import Client
from meshforge.labels.vlm.endpoint import Endpoint
from meshforge.labels.vlm.prompt import MeshHulls, PromptConfig, build_questions
from meshforge.labels.vlm.question import Reply, VlmQuestion
from meshforge.store.settings import VlmSettings
from meshforge.symbolic import SymbolicMesh


class CostClient(Client):
    """A client that counts what its answers cost when they were given, also those that it had already [$]."""

    def __init__(self, endpoint: Endpoint, folder: Path, max_cost: float | None) -> None:
        super().__init__(endpoint, folder, max_cost=max_cost)
        self.cost = 0.0
        self._counting = threading.Lock()

    def ask(self, question: VlmQuestion) -> Reply:
        reply = super().ask(question)
        with self._counting:
            self.cost += reply.cost
        return reply


@dataclass
class ModelLabeller:
    """A model that labels; what is spent counts over all families and repeats."""

    settings: VlmSettings
    spent: float = field(default=0.0, init=False)

    @property
    def method(self) -> Method:
        return Method(self.settings.model, self._ask)

    def _ask(self, family: Family, repeat: int) -> LabellerOutput:
        """Each repeat has its own answers on disk, so that it is asked anew, yet goes on where it was interrupted."""
        endpoint, most = Endpoint(self.settings), self.settings.max_cost
        left = None if most is None else max(0.0, most - self.spent)
        manner = PromptConfig(family.vocabulary, self.settings.model_copy(update={"about": "", "descriptions": {}}))
        started = perf_counter()
        client = CostClient(endpoint, JOURNALS / "vlm" / f"labels-{repeat}", left)
        meshes = [family.bare[place] for place in family.drawn]
        with closing(client), ThreadPoolExecutor(self.settings.concurrency) as threads:
            drawn = (build_questions([MeshHulls("", mesh, [*mesh.index])], manner) for mesh in meshes)
            pending = [threads.submit(ask_questions, client, manner, questions) for questions in drawn]
            said = [one.result() for one in pending]
        self.spent += client.usage.cost or 0.0
        labels = tuple(_labels(mesh, one) for mesh, one in zip(meshes, said, strict=True))
        why = next((problem for one in said for problem in one.failed), "")
        cost = client.cost if endpoint.is_priced else None
        return LabellerOutput(labels, perf_counter() - started, cost, sum(bool(one.failed) for one in said), why)


def _labels(mesh: SymbolicMesh, said: VlmAnswers) -> Labels:
    found, left = said.labels.get("", {}), said.open.get("", {})
    return tuple(None if hull.name in left else found[hull.name].name for hull in mesh.hulls)
