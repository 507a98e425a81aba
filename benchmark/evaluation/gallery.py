"""A static gallery: for each task a handful of assets, before and after, rule by rule; pictures load as needed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from html import escape
from pathlib import Path

from benchmark.assets import Sample
from benchmark.assets.pictures import upright
from benchmark.evaluation.sessions import QUICK
from benchmark.journal import JOURNALS, ROOT, run_units
from benchmark.report import Result, Table, Tell
from benchmark.tasks import EditResult, Task, task, tasks
from meshforge.common import write_atomically
from meshforge.rendering import render
from meshforge.rendering.comparison import joint_bounds
from meshforge.symbolic import SymbolicMesh

GALLERY = ROOT / "benchmark" / "gallery"
_SIDE, _HANDFUL = 194, 4
_STYLE = Path(__file__).with_suffix(".css")


def measure(tell: Tell, quick: bool) -> Result:
    """Draw all pictures, and write the page."""
    folder = JOURNALS / "gallery" if quick else GALLERY
    every = [one for one in tasks() if not quick or one.category == QUICK]
    rows = run_units("gallery", draw_task, [(one.name, str(folder.relative_to(ROOT))) for one in every], tell)
    text = "".join(row["html"] for row in rows)
    links = " ".join(f'<a href="#{one.name}">{one.name}</a>' for one in every)
    style = _STYLE.read_text("utf-8")
    head = f'<!doctype html><html lang="en"><meta charset="utf-8"><title>The 24 tasks</title><style>{style}</style>'
    intro = (
        "<h1>The 24 tasks, before and after</h1><p>The reference program of each task on some of its 75 meshes, rule "
        "by rule: first the mesh as CoACD made it, coloured by label, then after each rule, what it made or left. "
        "Written by <code>script/bench gallery</code>.</p>"
    )
    write_atomically(folder / "index.html", f"{head}{intro}<nav>{links}</nav>{text}</html>\n")
    shown = {picture for row in rows for picture in row["pictures"]}
    for path in (folder / "pictures").glob("*.webp"):
        if path.name not in shown:  # of an earlier run
            path.unlink()
    return Result(
        "gallery",
        "The gallery",
        (Table("What it shows", ("tasks", "pictures"), ((len(rows), len(shown)),)),),
        notes=("The gallery is `gallery/index.html`; open it in a browser.",),
    )


def draw_task(name: str, folder: str) -> dict[str, object]:
    """The pictures of a task, written, and its piece of the page."""
    one = task(name)
    chosen = handful(one)
    pictures, rows = list[str](), []
    for sample in chosen:
        cells = list(_cells(one, sample, ROOT / folder, pictures))
        rows.append(f'<div class="row">{"".join(cells)}</div>')
    rare = f" Rare: {escape(one.rare)}." if one.rare else ""
    about = f"<p>{escape(one.says)}{rare}</p><pre>{escape(str(one.program))}</pre>"
    text = f'<h2 id="{name}">{name}</h2>{about}{"".join(rows)}'
    return {"html": text, "pictures": pictures}


def handful(one: Task) -> list[Sample]:
    """One of the rare kind, then coarse, medium and fine ones of different kinds; such as fail unedited, if any."""
    rows = [row for row in one.samples() if not one.impure(row)]
    found = _choose_failure(one, [row for row in rows if one.rare and row.asset.kind == one.rare])
    for setting in ("coarse", "medium", "fine", "fine"):
        kinds, names = {row.asset.kind for row in found}, {row.asset.name for row in found}
        able = [row for row in rows if row.setting == setting and row.asset.name not in names]
        found += _choose_failure(one, [row for row in able if row.asset.kind not in kinds]) or _choose_failure(
            one, able
        )
    return found[:_HANDFUL]


def _choose_failure(one: Task, rows: Sequence[Sample]) -> list[Sample]:
    """The first that fails unedited, else the first."""
    failing = (row for row in rows if one.failure(row, EditResult(row.mesh)) is not None)
    first = next(failing, next(iter(rows), None))
    return [first] if first else []


def stages(one: Task, sample: Sample) -> list[SymbolicMesh]:
    """The mesh before, and after each rule, upright."""
    rules = one.program.rules
    edits = [one.run(replace(one.program, rules=rules[: k + 1]), sample.mesh).mesh for k in range(len(rules))]
    return [upright(sample), *(upright(sample, mesh) for mesh in edits if mesh)]


def _cells(one: Task, sample: Sample, folder: Path, pictures: list[str]) -> Iterator[str]:
    """The figures of a mesh; the names of their pictures are added to those of the task."""
    shown = stages(one, sample)
    box = joint_bounds(*shown)
    why = [one.failure(sample, EditResult(sample.mesh)), one.failure(sample, one.run(one.program, sample.mesh))]
    for k, mesh in enumerate(shown):
        image = render(mesh, color_by="label", size=(_SIDE, _SIDE), legend=False, bounds=box,
                       vocabulary=one.program.labels)  # fmt: skip
        path = folder / "pictures" / f"{one.name}-{sample.name}-{k}.webp"
        path.parent.mkdir(parents=True, exist_ok=True)
        image.save(path, "WEBP", quality=82, alpha_quality=90, method=2)
        pictures.append(path.name)
        told = escape(f"{sample.name} ({sample.asset.kind}), {len(mesh.hulls)} hulls" if not k else _rule(one, k))
        verdict = _verdict(why[0]) if not k else _verdict(why[1]) if k == len(shown) - 1 else ""
        yield (
            f'<figure><img loading="lazy" width="{_SIDE}" height="{_SIDE}" alt="{told}" src="pictures/{path.name}">'
            f"<figcaption>{told}{verdict}</figcaption></figure>"
        )


def _rule(one: Task, number: int) -> str:
    return f"{number}. {one.program.rules[number - 1]}"


def _verdict(why: str | None) -> str:
    return f'<br><span class="bad">{escape(why)}</span>' if why else '<br><span class="good">meets the criterion</span>'


def overview(every: Sequence[Task]) -> list[tuple[str, Sample, SymbolicMesh]]:
    """Of each task the first of the handful, before and after."""
    rows = ((one, handful(one)[0]) for one in every)
    return [(one.name, sample, stages(one, sample)[-1]) for one, sample in rows]
