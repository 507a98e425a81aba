"""Any labeller on a sample of meshes: how many labels are right, what a mesh costs, whether repeats agree."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from benchmark.assets import CATEGORIES, SEPARATE
from benchmark.labels.families import Family, families
from benchmark.labels.methods import Method, offline
from benchmark.labels.model import ModelLabeller
from benchmark.labels.scores import Score, score_labels
from benchmark.options import RunOptions
from benchmark.report import Cell, Result, Table, Tell
from meshforge.store.settings import VlmSettings

_QUICK = 8  # meshes
_COLUMNS = (
    "",
    "right",
    "right, pure hulls",
    "no label, %",
    "other words, %",
    "$ a mesh",
    "s a mesh",
    "repeats",
    "all repeats agree, %",
    "Friedman, p",
)
_PAPER: tuple[tuple[Cell, ...], ...] = (
    ("paper: GPT-4o", 0.92, "–", "–", "–", 0.0224, "–", 5, "–", 0.54),
    ("paper: Qwen3-VL", 0.76, "–", "–", "–", "–", "–", "–", "–", "–"),
    ("paper: Find3D", 0.61, "–", "–", "–", "–", "–", "–", "–", "–"),
)
_MODEL = "a vision-language model"


def measure(tell: Tell, quick: bool, given: RunOptions | None = None) -> Result:
    """Ask each labeller about the same meshes."""
    given = given or RunOptions()
    settings = given.settings()
    drawn = families(min(given.sample, _QUICK), CATEGORIES[:1], SEPARATE[:1]) if quick else families(given.sample)
    methods = [*offline(given.folders), *([ModelLabeller(settings).method] if settings else [])]
    scores = [_score(method, drawn, tell) for method in methods]
    meshes = sum(len(family.drawn) for family in drawn)
    hulls = sum(len(family.bare[place].hulls) for family in drawn for place in family.drawn)
    absent = [] if settings else [(_MODEL, *("not run",) * (len(_COLUMNS) - 1))]
    names = list(dict.fromkeys(family.name for family in drawn))
    return Result(
        "labellers",
        "Labellers on the same meshes",
        (
            Table(f"{meshes} meshes, {hulls} hulls", _COLUMNS, (*(_row(score) for score in scores), *absent, *_PAPER)),
            Table(
                "Right, category by category",
                ("", *names),
                tuple((score.name, *(score.of(name) for name in names)) for score in scores if not score.missing),
            ),
        ),
        notes=tuple(_notes(scores, settings)),
    )


def _score(method: Method, drawn: Sequence[Family], tell: Tell) -> Score:
    told = []
    for repeat in range(method.repeats):
        row = []
        for family in drawn:
            tell(f"labels: {method.name}, {family.name}, {family.setting}, {repeat + 1} of {method.repeats}")
            row.append(method.tell(family, repeat))
        told.append(row)
        if any(one.missing for one in row):  # what comes after would not get far either
            break
    return score_labels(method, drawn, told)


def _row(score: Score) -> tuple[Cell, ...]:
    if score.missing:
        return (score.name, *("not finished",) * (len(_COLUMNS) - 1))
    agreement, repeats = score.agreement, len(score.said)
    return (
        score.name,
        score.accuracy,
        score.accuracy_pure,
        100 * score.unlabelled,
        100 * score.foreign,
        "–" if score.cost is None else score.cost / score.meshes,
        score.seconds / score.meshes if score.seconds else "–",
        repeats,
        "–" if agreement is None else 100 * agreement,
        "no difference" if agreement == 1 else "–" if score.friedman is None else score.friedman,
    )


def _notes(scores: Sequence[Score], settings: VlmSettings | None) -> Iterator[str]:
    yield (
        "The same meshes for all: drawn evenly from the categories and the settings of CoACD, none that is labelled by "
        "hand for any of them. A category at one setting is a family: no mesh is labelled by another decomposition of "
        "the same asset. *Right*: share of all hulls; *pure hulls*: those of a purity of at "
        "least 0.8. A hull without a label, or with a word that is not in the vocabulary of its category, counts as "
        "wrong. *$ a mesh*, *s a mesh*: of the first repeat; propagation describes the meshes of a family before, in a "
        "second."
    )
    yield (
        "*All repeats agree*: share of hulls of which every repeat says the same. *Friedman*: the test of the paper, "
        "whether some repeat labels meshes better than others. What asks nobody gives the same each time, and is "
        "repeated all the same."
    )
    yield (
        "*Propagation*, *majority*: meshes of the family are labelled by hand, as advised. *Names*: the hulls of the "
        "benchmark are numbered, so that their names say nothing. *Propagation* and *names* are what a project on a "
        "disk has by them."
    )
    for score in scores:
        if score.missing:
            yield f"{score.name} is not finished: {score.missing} meshes are missing. {score.why}"
    if settings is None:
        yield (
            "No model was named. `script/bench labellers --vlm FILE` asks one, as the table `[vlm]` of the file says, "
            "like that of a project's `meshforge.toml`, with no description and no example; `--sample N` takes other "
            "than 200 meshes, `--max-cost` limits what is spent, and answers are kept. `python -m "
            "benchmark.labels.families FOLDER` writes the meshes, and `--labels FOLDER` reads labels that something "
            "else gave them."
        )
    else:
        yield (
            f"The model: {settings.model}, asked about all hulls of a mesh at once, as in the paper, at temperature 0; "
            "no description, no example. Answers of each repeat are kept apart. Words that are no labels are asked for "
            "once more, and then count as none."
        )
    yield "The paper's figures are on PartNet and YCB assets and other labels: other data."
