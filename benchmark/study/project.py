"""A family of the benchmark as a project on disk: assets that read back with the very same hulls, and their labels."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from benchmark.assets.storage import Sample
from benchmark.study.desk import Bench, Desk, Start
from meshforge.common import write_atomically
from meshforge.formats import read
from meshforge.geometry import Shape
from meshforge.language import Orient
from meshforge.project import Project
from meshforge.symbolic import SymbolicMesh, write_labels

SUFFIX, _SUFFIX_OF_BODIES = ".obj", ".urdf"
"""What the name of a mesh ends with in a project: of one body, and of several, which an OBJ file cannot tell apart."""
_MEMORY = Path("/dev/shm")  # a disk in memory, where there is one


@lru_cache(maxsize=8)
def name_by_files(bench: Bench) -> Bench:
    """The same bench with its meshes as they read back from files, under the ids that they have in a project: the
    product orders the vertices of a hull in its own way. What it remembers stays with it."""

    def rename(name: str) -> str:
        return f"{name}{_suffix_of(bench.samples[name].mesh)}"

    start = bench.start
    parts = {rename(name): labels for name, labels in start.parts.items()}
    with open_folder() as folder:
        samples = [_read_back(replace(sample, name=rename(name)), folder) for name, sample in bench.samples.items()]
    return Bench(bench.task, samples, Start(tuple(map(rename, start.by_hand)), parts))


def _suffix_of(mesh: SymbolicMesh) -> str:
    return _SUFFIX_OF_BODIES if len({hull.body for hull in mesh.hulls}) > 1 else SUFFIX


def _read_back(sample: Sample, folder: Path) -> Sample:
    """A mesh with its hulls as they are read from a file, with their labels: body by body, if there are several."""
    bodies = list(dict.fromkeys(hull.body for hull in sample.mesh.hulls))
    rows = sorted(zip(sample.mesh.hulls, sample.shares, strict=True), key=lambda row: bodies.index(row[0].body))
    mesh = SymbolicMesh(tuple(hull for hull, _ in rows))
    geoms = read(_write_mesh(mesh, folder / sample.name)).geoms
    if len(bodies) == 1:
        hulls = [replace(hull, shape=geom.shape) for hull, geom in zip(mesh.hulls, geoms, strict=True)]
    else:
        hulls = [
            replace(hull, name=geom.name, body=geom.body, shape=geom.shape)
            for hull, geom in zip(mesh.hulls, geoms, strict=True)
        ]
    return replace(sample, mesh=SymbolicMesh(tuple(hulls)), shares=tuple(shares for _, shares in rows))


def _write_mesh(mesh: SymbolicMesh, file: Path) -> Path:
    """Write a mesh, as the suffix says."""
    if file.suffix == SUFFIX:
        file.write_text(_format_obj((hull.shape for hull in mesh.hulls), mesh.index), encoding="utf-8")
        return file
    robot = ElementTree.Element("robot", name=file.stem)
    ElementTree.SubElement(robot, "link", name="root")
    pieces = file.with_suffix("")
    pieces.mkdir()
    for body in dict.fromkeys(hull.body for hull in mesh.hulls):
        link = ElementTree.SubElement(robot, "link", name=body)
        for number, hull in ((k, one) for k, one in enumerate(mesh.hulls) if one.body == body):
            piece = pieces / f"{number}.obj"
            piece.write_text(_format_obj([hull.shape]), encoding="utf-8")
            collision = ElementTree.SubElement(link, "collision", name=hull.name.removeprefix(f"{body}/"))
            geometry = ElementTree.SubElement(collision, "geometry")
            ElementTree.SubElement(geometry, "mesh", filename=f"{pieces.name}/{piece.name}")
        joint = ElementTree.SubElement(robot, "joint", name=f"to {body}", type="fixed")
        ElementTree.SubElement(joint, "parent", link="root")
        ElementTree.SubElement(joint, "child", link=body)
    ElementTree.ElementTree(robot).write(file, encoding="utf-8")
    return file


@contextmanager
def open_folder() -> Iterator[Path]:
    """A folder in memory, where there is such a disk, that goes away afterwards."""
    with tempfile.TemporaryDirectory(dir=_MEMORY if _MEMORY.is_dir() else None) as folder:
        yield Path(folder)


@contextmanager
def open_project(desk: Desk, *, unnamed: bool = False) -> Iterator[Project]:
    """A new project of the meshes of a desk, with their labels, in a folder that goes away afterwards.

    The meshes have the names that `name_by_files` gives. unnamed: without a vocabulary, and so without an orientation.
    """
    with open_folder() as folder:
        yield write_project(desk, folder, unnamed=unnamed)


def write_project(desk: Desk, folder: Path, *, unnamed: bool = False) -> Project:
    """Write the meshes of a desk as files of assets into a folder, and a project of them beside these."""
    one, frame = desk.bench.task, desk.bench.task.program
    words, orient = ((), None) if unnamed else (frame.labels, frame.orient)
    project = create_project(folder, one.name, desk.meshes, words, orient).with_cache()
    _write_thresholds(project, frame.contact, frame.extremity)
    for name, template in one.templates.items():
        write_atomically(project.layout.own_templates / name, _format_obj(template.shapes).encode())
    for name, mesh in desk.meshes.items():
        if mesh.labels:
            write_labels(project.layout.labels(name), mesh, project.vocabulary)
    _check_meshes(project, desk.meshes)
    return project


def create_project(
    folder: Path,
    name: str,
    meshes: Mapping[str, SymbolicMesh],
    vocabulary: Sequence[str],
    orient: Orient | None = None,
) -> Project:
    """Write meshes as files of assets into a folder, and a project of them beside these, without labels."""
    assets = folder / "assets"
    assets.mkdir()
    for asset, mesh in meshes.items():
        _write_mesh(mesh, assets / asset)
    files = [assets / asset for asset in meshes]
    return Project.create(folder / "project", files, name=name, vocabulary=vocabulary, orient=orient)


def _format_obj(shapes: Iterable[Shape], names: Iterable[str] = ()) -> str:
    """Shapes as the objects of an OBJ file, coordinates in full precision; names: of all, else they are numbered."""
    lines, first, known = list[str](), 1, iter(names)
    for number, shape in enumerate(shapes):
        lines.append(f"o {next(known, number)}")
        lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in shape.vertices.tolist()]
        lines += [f"f {a} {b} {c}" for a, b, c in (shape.faces + first).tolist()]
        first += len(shape.vertices)
    return "\n".join(lines) + "\n"


def _write_thresholds(project: Project, contact: float | None, extremity: float | None) -> None:
    """Thresholds have no method of their own: people write them into the settings."""
    lines = [f"{name} = {value!r}" for name, value in (("contact", contact), ("extremity", extremity)) if value]
    if lines:
        path = project.folder / "meshforge.toml"
        path.write_text("\n".join([path.read_text("utf-8"), "[thresholds]", *lines, ""]), encoding="utf-8")


def _check_meshes(project: Project, meshes: Mapping[str, SymbolicMesh]) -> None:
    """Each asset reads back with the same hulls in the same order, and the same labels."""
    assert set(project.assets()) == set(meshes)
    for name, mesh in meshes.items():
        found = project.mesh(name)
        rows = zip(found.hulls, mesh.hulls, strict=True)
        same = all(a.name == b.name and np.array_equal(a.vertices, b.vertices) for a, b in rows)
        assert same, f"{name} does not read back as it was written"
        assert dict(found.labels) == dict(mesh.labels), f"the labels of {name} do not read back as they were written"
