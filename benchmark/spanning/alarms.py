"""Which hulls of the bundled tables and chairs are named as spanning parts, where all are of one part, and where a leg
of seven of ten chairs is merged into the seat."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmark.report import Cell, Goal, Result, Table, Tell
from benchmark.spanning.course import SURE
from meshforge.batch import IN_PROCESS, find_surfaces
from meshforge.formats import MeshPart, format_obj, load, read
from meshforge.geometry import Polytope, convex_hull
from meshforge.project import Project, RebuildSettings
from meshforge.samples import family_of, write_family
from meshforge.symbolic import Hull, Surface, SymbolicMesh

KNOWN = 3
"""Assets of a family that keep their labels."""
_COLUMNS = ("family", "labelled assets", "hulls", "spanning", "found", "named, yet of one part")
_SEED, _TOUCH = 1, 0.002  # [m] between boxes of hulls that touch


@dataclass(frozen=True, slots=True)
class AlarmCase:
    """A project of a bundled family. spanning: the hulls that span parts, by asset."""

    project: Project
    spanning: Mapping[str, str]

    def find(self) -> tuple[int, int]:
        """How many of these are named, and how many others, by a dry run."""
        how = RebuildSettings(SURE)
        named = set[tuple[str, str]]()
        for result in self.project.rebuild_spanning(how=how, dry_run=True, execution=IN_PROCESS):
            assert not result.problems, result.problems
            named |= {(result.asset, entry.what) for entry in result.planned if entry.remark.startswith(entry.what)}
        right = named & set(self.spanning.items())
        return len(right), len(named) - len(right)


def measure(tell: Tell, quick: bool) -> Result:
    """Look for hulls that span in all cases."""
    rows = list[tuple[Cell, ...]]()
    with tempfile.TemporaryDirectory() as scratch:
        for what, labelled, case in list_cases(Path(scratch), quick):
            tell(f"alarms: {what}, {labelled} labelled")
            hulls = sum(len(case.project.mesh(asset).hulls) for asset in case.project.assets())
            rows.append((what, labelled, hulls, len(case.spanning), *case.find()))
    return Result(
        "alarms",
        "Bundled families: hulls that span parts",
        (Table(f"Found at a probability of at least {SURE}", _COLUMNS, tuple(rows)),),
        tuple(_list_goals(rows)),
        (
            f"*{_MERGED}*: the hull of the seat and one leg that touches it, drawn with a fixed seed, are one hull "
            "in all chairs that are not labelled. Elsewhere each hull is of one part. The tables show no surface.",
        ),
    )


_MERGED = "chairs, a leg merged into the seat"


def list_cases(folder: Path, quick: bool) -> Iterator[tuple[str, str, AlarmCase]]:
    """What each case is of, how many assets are labelled, and the case."""
    for family in ("tables",) if quick else ("tables", "chairs"):
        yield family, "all", open_bundled(folder / f"{family}-all", family)
        yield family, str(KNOWN), open_bundled(folder / f"{family}-some", family, KNOWN)
    yield _MERGED, str(KNOWN), open_merged(folder / "merged")


def _list_goals(rows: Sequence[tuple[Cell, ...]]) -> Iterator[Goal]:
    for what, labelled, _, spanning, found, others in rows:
        name = f"{what}, {labelled} labelled"
        most = 0 if labelled == "all" else KNOWN
        yield Goal(f"{name}: named, yet of one part", "at most", most, float(others))
        if spanning:
            yield Goal(f"{name}: found of {spanning}", "at least", 6, float(found))


def open_bundled(folder: Path, family: str, labelled: int | None = None) -> AlarmCase:
    """A bundled family, of which all or the first so many assets have their labels."""
    known = family_of(family)
    write_family(known, folder / "assets")
    files = sorted((folder / "assets").glob("*.labels.json"))
    for path in files[labelled:] if labelled is not None else ():
        path.unlink()
    project = Project.create(folder / "p", [folder / "assets" / known.pattern], vocabulary=known.vocabulary)
    project.label("file")
    return AlarmCase(project, {})


def open_merged(folder: Path) -> AlarmCase:
    """The bundled chairs as URDFs; in all but three, which are labelled, a leg is merged into the seat."""
    family, rng = family_of("chairs"), np.random.default_rng(_SEED)
    write_family(family, folder / "chairs")
    paths = sorted((folder / "chairs").glob(family.pattern))
    whole = set(rng.choice(len(paths), KNOWN, replace=False).tolist())
    labels, spanning = dict[str, list[str]](), dict[str, str]()
    for place, path in enumerate(paths):
        mesh = load(path)
        hulls = [hull.shape.tessellate() for hull in mesh.hulls]
        if place in whole:
            labels[f"{path.stem}.urdf"] = [str(hull.label) for hull in mesh.hulls]
        else:
            hulls = _merge_leg(mesh, rng)
            spanning[f"{path.stem}.urdf"] = "base/h0"
        (surface,) = find_surfaces(read(path)).values()
        _write_urdf(folder / "assets", path.stem, surface, hulls)
    project = Project.create(folder / "p", [folder / "assets/*.urdf"], vocabulary=family.vocabulary)
    for asset, own in labels.items():
        project.set_labels(asset, dict(zip(project.mesh(asset).index, own, strict=True)))
    return AlarmCase(project, spanning)


def _merge_leg(mesh: SymbolicMesh, rng: np.random.Generator) -> list[Polytope]:
    """The hulls of a chair, of which the first is around a hull of the seat and one of a leg that touch."""
    pairs = [(a, b) for a in mesh.hulls for b in mesh.hulls if (a.label, b.label) == ("seat", "leg") and _touch(a, b)]
    seat, leg = pairs[rng.integers(len(pairs))]
    both = convex_hull(np.concatenate([seat.vertices, leg.vertices]))
    return [both, *(hull.shape.tessellate() for hull in mesh.hulls if hull not in (seat, leg))]


def _touch(one: Hull, other: Hull) -> bool:
    a, b = one.shape.aabb, other.shape.aabb
    return float((np.minimum(a.max, b.max) - np.maximum(a.min, b.min)).min()) > -_TOUCH


def _write_urdf(folder: Path, name: str, surface: Surface, hulls: Sequence[Polytope]) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    shapes = [surface, *(Surface(hull.vertices, hull.faces) for hull in hulls)]
    rows = list[str]()
    for place, shape in enumerate(shapes):
        file, kind = f"{name}_{place}.obj", "collision" if place else "visual"
        (folder / file).write_bytes(format_obj([MeshPart(f"h{place - 1}", shape)]))
        rows.append(f'<{kind} name="h{place - 1}"><geometry><mesh filename="{file}"/></geometry></{kind}>')
    (folder / f"{name}.urdf").write_text(f'<robot name="{name}"><link name="base">{"".join(rows)}</link></robot>')
