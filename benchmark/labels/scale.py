"""`meshforge label` on ten thousand assets that were described before: seconds and memory after a correction."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path

from benchmark.assets import samples
from benchmark.batch.crowd import crowd
from benchmark.report import Goal, Result, Table, Tell
from benchmark.speed.watch import Usage, watch_command
from benchmark.tasks import task
from meshforge.formats import labels_beside, save
from meshforge.project import Project
from meshforge.symbolic import read_labels, write_labels

_KIND, _MODELS, _HULLS = "table", 14, 24
_COUNT, _QUICK = 10_000, 28
_BY_HAND = 3
_MIB = 1 << 20
_NOTES = (
    f"Assets of {_HULLS} hulls each, the first ones of {_MODELS} meshes of the benchmark's category *{_KIND}*, each at "
    f"another size for every 50 assets. {_BY_HAND} assets are labelled by hand, and `meshforge label PROJECT` run with "
    "two workers: it reads and describes all. Then one more is labelled by hand, and it is run again. Memory: the "
    "largest resident size.",
)


def measure(tell: Tell, quick: bool) -> Result:
    """Label a family of very many assets, and once more after a correction."""
    count, words = _QUICK if quick else _COUNT, task(f"{_KIND}-easy").program.labels
    with tempfile.TemporaryDirectory(dir=".") as name:
        folder = Path(name)
        tell(f"labels: writing {count:,} assets")
        crowd(_write_models(folder / "models", words), count, folder / "assets")
        project = Project.create(folder / "project", [folder / "assets"], vocabulary=words)
        *first, last = project.assets()[: _BY_HAND + 1]
        files = {asset: labels_beside(folder / "assets" / asset) for asset in (*first, last)}
        true = {asset: read_labels(file).labels for asset, file in files.items()}
        for file in (folder / "assets").rglob("*.labels.json"):
            file.unlink()
        runs = dict[str, Usage]()
        for what, assets in (("from nothing", first), ("descriptions given", [last])):
            for asset in assets:
                project.set_labels(asset, {hull: label.name for hull, label in true[asset].items()})
            tell(f"labels: {count:,} assets, {what}")
            runs[what] = watch_command(["label", str(project.folder), "--workers", "2", "--json"])
    again = runs["descriptions given"]
    rows = tuple((what, count, one.seconds, one.main / _MIB, one.worker / _MIB) for what, one in runs.items())
    goals = (
        Goal("descriptions given [s]", "at most", 60.0, again.seconds),
        Goal("memory of any process [MiB]", "at most", 1024.0, max(again.main, again.worker) / _MIB),
    )
    table = Table("`meshforge label`", ("", "assets", "s", "MiB, main", "MiB, largest worker"), rows)
    return Result("scale", "Ten thousand assets", (table,), () if quick else goals, _NOTES)


def _write_models(folder: Path, words: Sequence[str]) -> list[Path]:
    folder.mkdir()
    made = list[Path]()
    for sample in (one for one in samples(_KIND) if len(one.mesh.hulls) >= _HULLS):
        mesh = sample.mesh.with_hulls(sample.mesh.hulls[:_HULLS])
        made.append(folder / f"{sample.name}.obj")
        save(mesh, made[-1])
        write_labels(labels_beside(made[-1]), mesh, words)
        if len(made) == _MODELS:
            break
    return made
