"""Families of small tables that a model on loopback is asked about."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from meshforge.batch import IN_PROCESS, ExecutionOptions
from meshforge.labels import LabelFamily, LabelOutcome, VlmForecast, VlmLabeler, VlmResult, forecast_vlm, ignore_stage
from meshforge.labels.labeler import WriteBlock
from meshforge.project import Project
from meshforge.store import VlmSettings
from tests.loopback import Asked, Server, labels_as_json
from tests.unit.batch.families import Corner, label_of, obj, table_boxes

VARIABLE = "MESHFORGE_TEST_API_KEY"
WORDS = ("top", "leg", "misc")


def boxes_of(height: float) -> dict[str, tuple[Corner, Corner]]:
    """The boxes of a table, with what belongs to nothing beside its foot."""
    return table_boxes(height) | {"crumb": ((0.7, 0.2, 0), (1.2, 0.7, 0.3))}


def family(folder: Path, count: int) -> Project:
    """Tables that look different, without labels; every third has its hulls in another order."""
    for k in range(count):
        boxes = list(boxes_of(0.8 + 0.01 * k).items())
        path = folder / f"assets/t{k:03}.obj"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(obj(dict(boxes[::-1] if k % 3 == 0 else boxes)))
    return Project.create(folder / "p", [folder / "assets"], vocabulary=WORDS)


def hulls(asset: str) -> list[str]:
    """The names of the hulls of an asset, in its order."""
    names = list(boxes_of(1.0))
    return names[::-1] if int(Path(asset).stem[1:]) % 3 == 0 else names


def right(asked: Asked) -> str:
    """The right answer, of a model that is told the names of the hulls."""
    return labels_as_json({number: label_of(asked.hulls[number][1]) for number in asked.numbers})


def settings(server: Server, **how: Any) -> VlmSettings:
    """About every hull, with small pictures, short waits, and prices; how: other settings."""
    told: dict[str, Any] = {
        "base_url": server.base_url,
        "model": server.model,
        "key_env": VARIABLE,
        "every_hull": True,
        "size": 256,
        "names": True,
        "timeout": 5.0,
        "input_price": 1.0,
        "output_price": 4.0,
    }
    return VlmSettings(**told | how)


@dataclass(frozen=True)
class Labelling(VlmResult):
    """How asking went, with what became of each asset."""

    outcomes: tuple[LabelOutcome, ...] = ()

    @property
    def open(self) -> dict[str, Mapping[str, str]]:
        """Why hulls have no label, by asset and hull."""
        return {outcome.asset: outcome.open for outcome in self.outcomes if outcome.open}


def label_with_vlm(
    project: Project,
    settings: VlmSettings | None = None,
    *,
    stop: Callable[[], bool] | None = None,
    execution: ExecutionOptions = IN_PROCESS,
    report: Callable[[LabelOutcome], None] = lambda outcome: None,
    write_block: WriteBlock | None = None,
) -> Labelling:
    """Label a project by a model; stop: whether to ask no more."""
    labeler = VlmLabeler(settings)
    done = project.label(labeler, execution=replace(execution, stop=stop), report=report, write_block=write_block)
    result = labeler.result
    return Labelling(result.usage, result.unasked, result.ended, result.blind, done.outcomes)


def forecast(project: Project, settings: VlmSettings, execution: ExecutionOptions = IN_PROCESS) -> VlmForecast:
    """What labelling a project would send."""
    return forecast_vlm(LabelFamily(project, project.vocabulary, execution, ignore_stage), settings)


def truth(asset: str) -> dict[str, str]:
    """The right label of each hull."""
    return {name: label_of(name) for name in hulls(asset)}
