"""`meshforge convert`: between formats, or an unedited write-back within one; of one asset, or of very many."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from meshforge import formats
from meshforge.cli import options
from meshforge.cli.console import NOTHING_WRITTEN, NoteLog, describe_failure, fold_notes, progress
from meshforge.cli.terminal import print_json, remark
from meshforge.common import UsageError, escape_name, pluralize
from meshforge.formats import FORMATS_BY_SUFFIX, Loss, SaveResult
from meshforge.symbolic import Feature, SymbolicMesh


@dataclass(frozen=True, slots=True)
class ConvertArguments:
    """What is typed after `meshforge convert`."""

    context: typer.Context
    paths: Annotated[
        list[str],
        typer.Argument(
            metavar="ASSET... OUT",
            help="An asset and the file to write, whose suffix names the format; with --to, many and a folder.",
        ),
    ]
    to: Annotated[
        str | None, typer.Option("--to", metavar="SUFFIX", help="Write all assets in this format, as .usda, below OUT.")
    ] = None
    names: options.MarkNames = None
    collision: options.CollisionPlace = None
    concave: Annotated[
        Literal["keep", "hull", "decompose"],
        typer.Option(
            "--concave",
            help="Collision meshes that are not convex: as they are, each as its convex hull, or decomposed by CoACD.",
        ),
    ] = "keep"
    urdf_capsules: options.UrdfCapsules = False
    one_file_a_hull: Annotated[
        bool,
        typer.Option(
            "--one-file-a-hull",
            help="URDF and SDF: each hull of a mesh in a file and an element of its own, for MuJoCo and Bullet.",
        ),
    ] = False
    exclude: options.ExcludedPairs = None
    labels: options.LabelsPath = None
    link: Annotated[bool, typer.Option("--link", help="Hard-link files that are only copied.")] = False
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace files that are there already.")] = False
    dry_run: options.DryRun = False
    execution: options.ExecutionArguments = options.EXECUTION
    json: options.Json = False


@options.takes(ConvertArguments)
def convert(given: ConvertArguments) -> None:
    """Write an asset in another format, or unchanged in its own; says what the target cannot hold.

    Bodies, joints, masses and visuals are kept where the format has them. Labels go beside the file, under the
    names that the hulls have there. A file that goes into its own format stays as it is, unless --names or
    --collision asks for marks of what collides. With --to, folders and globs are taken, too, OUT mirrors their tree,
    a run that was stopped goes on where it was, and the exit code is 1 when some failed. It is 1 as well where a mesh
    that collided would not collide any more.
    """
    if len(given.paths) < 2:
        raise UsageError("there is nothing to write to", remedy="meshforge convert ASSET OUT")
    *sources, out = given.paths
    if given.to is None:
        options.refuse_options(given.context, ("dry_run",), "--to SUFFIX")
        if len(sources) > 1:
            raise UsageError("several assets and no format", remedy="meshforge convert ASSETS... OUT --to SUFFIX")
        _convert_one(Path(sources[0]), Path(out), given)
        return
    if given.overwrite:
        raise UsageError("--overwrite is for one asset", remedy="Outputs of an earlier run are replaced as it is.")
    if given.exclude:
        remedy = "For many, in their own formats: meshforge check ASSETS... --fix --exclude all --out DIR."
        raise UsageError("--exclude is for one asset", remedy=remedy)
    suffix = _parse_suffix(given.to)
    _convert_many(sources, Path(out), given, suffix)


def _convert_many(sources: Sequence[str], out: Path, given: ConvertArguments, suffix: str) -> None:
    """Write all assets below a folder in another format, as a run without a program; leave with 1 where some failed."""
    from meshforge import batch  # lazy: 250 modules that only --to needs; also below
    from meshforge.language import Program  # lazy: as batch

    jobs, summary = batch.make_jobs(batch.expand(sources), given.labels), batch.RunSummary()
    log = NoteLog(len(jobs) > 2)
    run_options = batch.ApplyOptions(
        link=given.link,
        dry_run=given.dry_run,
        to=suffix,
        names=given.names,
        collision=given.collision,
        concave=given.concave,
        urdf_capsules=given.urdf_capsules,
        one_file_a_hull=given.one_file_a_hull,
    )
    if len(jobs) > 1:
        remark(batch.describe_jobs(jobs))
    with progress(len(jobs), "converting") as advance:
        execution = replace(given.execution.to_options(), progress=advance)
        for outcome in batch.apply(Program(), jobs, out, options=run_options, execution=execution):
            summary.add(outcome)
            if given.json:
                print_json(batch.to_json_line(outcome), compact=True)
            elif isinstance(outcome, batch.Failed):
                typer.echo(describe_failure(outcome.asset, outcome.error))
            else:
                word = "skipped" if isinstance(outcome, batch.Skipped) else "written"
                line = f"{word:10} {escape_name(outcome.out)}: {pluralize(outcome.after, 'hull')}"
                typer.echo(log.describe(outcome.asset, line, outcome.notes))
    if not given.json:
        log.print_repeated()
        typer.echo(str(summary).replace("unchanged", "written", 1) + NOTHING_WRITTEN * given.dry_run)
    raise typer.Exit(int(summary.counts["failed"] > 0))


def _parse_suffix(to: str) -> str:
    """The suffix of a format that can be written. Raises UsageError; PluginError for one that cannot be loaded."""
    suffix = f".{to.lower().lstrip('.')}"
    known = FORMATS_BY_SUFFIX.get(suffix.removeprefix("."))
    if known is None or not known.writable:
        built_in = [name for name, one in FORMATS_BY_SUFFIX.built_in.items() if one.writable]
        names = ", ".join(f".{name}" for name in (*built_in, *FORMATS_BY_SUFFIX.plugin_names))
        raise UsageError(f"nothing is written as {suffix}", remedy=f"Formats: {names}.")
    return suffix


def _convert_one(source: Path, out: Path, given: ConvertArguments) -> None:
    mesh = options.open_asset(source, given.labels, None)
    if given.concave != "keep" and mesh.asset:
        from meshforge.batch import replace_concave  # lazy: 250 modules that only --concave needs

        with progress(None, f"hulls for {source.name}"):
            ready = SymbolicMesh.of(replace_concave(mesh.asset, given.concave))
        mesh = ready.with_labels({name: label for name, label in mesh.labels.items() if name in ready.index})
    if given.exclude:
        from meshforge.checks import exclude_pairs  # lazy: as above

        mesh, excluded = exclude_pairs(mesh, given.exclude)
        for pair in excluded:
            remark(f"{escape_name(pair)} do not touch any more")
    with progress(None, f"writing {out.name}"):
        saved = formats.convert(
            mesh,
            out,
            link=given.link,
            overwrite=given.overwrite,
            names=given.names,
            collision=given.collision,
            urdf_capsules=given.urdf_capsules,
            one_file_a_hull=given.one_file_a_hull,
        )
        read_notes = formats.notes_after(mesh.asset, formats.read(saved.path), saved.hulled) if mesh.asset else ()
    if given.json:
        print_json(_to_json(source, saved, len(mesh.hulls), read_notes))
    else:
        for note in fold_notes((*read_notes, *saved.notes)):
            remark(f"note: {note}")
        kept = [pluralize(feature.count, feature.kind.one, feature.kind.many) for feature in saved.report.kept]
        remark(f"wrote {escape_name(str(saved.path))}: {', '.join([pluralize(len(mesh.hulls), 'hull'), *kept])}")
    saved.report.refuse_lost_collision(str(source), "Make a hull of each: --concave hull.")


def _to_json(source: Path, saved: SaveResult, hulls: int, notes: Sequence[str]) -> dict[str, Any]:
    report = saved.report
    return {
        "asset": str(source),
        "out": str(saved.path),
        "hulls": hulls,
        "kept": [_to_row(feature) for feature in report.kept],
        "lost": [{**_to_row(loss), "why": loss.why, "instead": loss.instead} for loss in report.lost],
        "notes": [*notes, *report.remarks],
    }


def _to_row(thing: Feature | Loss) -> dict[str, Any]:
    return {"what": thing.kind.many, "count": thing.count, "names": list(thing.names)}
