"""The assets that are loaded: of every format, as they are written, and as they are after an edit."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from meshforge.common import MeshForgeError
from meshforge.formats import list_formats, read, save
from meshforge.formats.conversion import turn_upright
from meshforge.formats.registry import format_for
from meshforge.language import Program, Template
from meshforge.samples import TABLES
from meshforge.symbolic import Asset, SymbolicMesh
from tests import sdf_sample, urdf_sample, usd_stages
from tests.conversion_samples import SAMPLES, wedge
from tests.loads.comparing import shapes_of
from tests.loads.readers import Seen
from tests.mesh_files import obj

SUFFIXES = (".urdf", ".xml", ".sdf", ".glb", ".gltf", ".usda", ".usdc", ".usdz", ".obj", ".stl", ".ply", "")
"""Of the formats that are written; the last is a folder of mesh files."""

EDIT = Program.parse("""\
Geo(All, +X) => Delete
Geo(All, -X) => Each(Scale(Z, 1.25))
Geo(All, +Y) => Each(Replace(capsule))
Geo(All, -Y) => Each(Replace(cylinder))
Geo(All, +Z) => Add(+Z, "block.obj")
Geo(All, -Z) => Each(Replace(sphere, native))
""")
"""Deletes, scales, puts native shapes in place of hulls, and adds one."""

Source = Callable[[Path], Asset]


@dataclass(frozen=True)
class Made:
    """A written file or folder, of which asset, in which format, after the edit or before.

    meant: the hulls that were written, shapes: as read back; shows: whether the asset has visuals of its own.
    """

    asset: str
    suffix: str
    edited: bool
    path: Path
    meant: tuple[Seen, ...]
    shapes: tuple[Seen, ...]
    shows: bool

    @property
    def has_hidden_hulls(self) -> bool:
        """Whether it is a glTF scene whose hulls are told by KHR_physics_rigid_bodies alone, and not seen."""
        return self.shows and self.suffix in (".glb", ".gltf")


@dataclass(frozen=True)
class Refused:
    """What MeshForge does not write, and why."""

    asset: str
    suffix: str
    why: str


def sources() -> dict[str, Source]:
    """The assets by name, made in an empty folder: the bundled ones, and some with a bit of everything."""
    tables = {path.stem: partial(_table, path) for path in sorted(TABLES.glob("*.obj"))}
    in_memory = {name: partial(_in_memory, make) for name, make in SAMPLES.items()}
    return {**tables, **in_memory, "cart": _cart, "model": _model, "cup": _cup, "legs": _legs}


def _table(path: Path, folder: Path) -> Asset:
    return read(path)


def _in_memory(make: Callable[[], Asset], folder: Path) -> Asset:
    return make()


def _cart(folder: Path) -> Asset:
    """A URDF with a mirrored mesh; strict readers of XML want its comment without hyphens."""
    text = urdf_sample.SAMPLE.replace(" -- by hand ", "")
    return read(_one_hull(urdf_sample.sample(folder, text)))


def _model(folder: Path) -> Asset:
    """An SDF with frames; Drake wants both coefficients of friction, and finds no models by name."""
    text = sdf_sample.SAMPLE.replace("model://cart/", "").replace("</mu>", "</mu><mu2>0.7</mu2>")
    return read(_one_hull(sdf_sample.sample(folder, text)))


def _cup(folder: Path) -> Asset:
    """A stage in centimetres."""
    return read(usd_stages.written(folder, usd_stages.CUP))


def _legs(folder: Path) -> Asset:
    """A stage of two legs from another layer, unevenly scaled, one of them mirrored."""
    return read(usd_stages.table(folder))


def made(folder: Path, names: Iterable[str], suffixes: Iterable[str] = SUFFIXES) -> Iterator[Made | Refused]:
    """Each of the assets in each format, and the edit of that."""
    every = sources()
    for name in names:
        asset = every[name](folder / "sources" / name)
        for suffix in suffixes:
            path = folder / (suffix.removeprefix(".") or "folder") / name / f"{name}{suffix}"
            written = _written(asset, path, name, shows=len(asset.visuals) > 0)
            yield written
            if isinstance(written, Made):
                yield _edited(written)


def _written(asset: Asset, path: Path, name: str, *, shows: bool, edited: bool = False) -> Made | Refused:
    """An asset in a file; what this is to hold stands upright in it."""
    target = format_for(path, asset.format)
    source = next((known for known in list_formats() if known.name == asset.format), None)
    meant = asset if source is target else turn_upright(asset, source, target)[0]
    try:
        save(asset, path, collision="replace")  # of scenes of hulls alone, which readers are to see
    except MeshForgeError as error:
        return Refused(name, path.suffix, error.problem)
    wanted, found = shapes_of(meant, opaque=False), shapes_of(read(path))
    return Made(name, path.suffix, edited, path, tuple(wanted), tuple(found), shows)


def _edited(before: Made) -> Made | Refused:
    mesh = SymbolicMesh.of(read(before.path))
    edited = EDIT.run(mesh, {"block.obj": Template((wedge(0.0),), "block.obj")}).mesh.to_asset()
    path = before.path.parent / "edited" / before.path.name
    return _written(edited, path, before.asset, shows=before.shows, edited=True)


def _one_hull(path: Path) -> Path:
    """A sample whose mesh has one piece, and no side like another: engines make one hull of a mesh file."""
    hull = wedge(0.5).tessellate()
    (path.parent / "meshes" / "three.obj").write_bytes(obj((hull.vertices, hull.faces)))
    return path
