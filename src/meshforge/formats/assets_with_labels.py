"""Assets with the labels that lie beside them: read alone or many, and written into another file."""

import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from meshforge import symbolic
from meshforge.common import AssetError, expand_glob
from meshforge.formats.base import Collision
from meshforge.formats.engine_names import MarkName
from meshforge.formats.output_tree import SaveResult, make_output, part_meshes, save
from meshforge.formats.registry import FORMATS_BY_SUFFIX, Source, all_suffixes, is_asset, path_of, read
from meshforge.symbolic import Label, SymbolicMesh, write_labels


def to_mesh(what: symbolic.SymbolicMesh | Source) -> symbolic.SymbolicMesh:
    """Return a mesh as it is, anything else as `load` reads it."""
    return what if isinstance(what, symbolic.SymbolicMesh) else load(what)


Labels = str | os.PathLike[str] | Mapping[str, Label | str]
"""Labels for an asset: the path of a labels file, or the labels by the names of hulls."""


def load(source: Source, labels: Labels | None = None) -> symbolic.SymbolicMesh:
    """Return the symbolic mesh of a file or a folder, of the text of an MJCF, of a `mujoco.MjSpec` or a `Usd.Stage`.

    labels: a labels file, or labels by the names of hulls; None takes those of the file beside it if present.
    What is saved of an object in memory is what it said when it was loaded, with the edit; the object does not change.
    Raises AssetError: the asset or labels cannot be read; HullNotFoundError: a label for no hull; UsageError: no asset.
    """
    mesh = symbolic.SymbolicMesh.of(read(source))
    if isinstance(labels, Mapping):
        return label_hulls(mesh, labels)
    if labels is None and (path := path_of(source)):
        beside = labels_beside(path)
        labels = beside if beside.is_file() else None
    return mesh if labels is None else symbolic.transfer_labels(symbolic.read_labels(Path(labels)), mesh).mesh


def label_hulls(mesh: symbolic.SymbolicMesh, labels: Mapping[str, Label | str]) -> symbolic.SymbolicMesh:
    """Return the mesh with some labels set. Raises HullNotFoundError: there is no hull of a name."""
    for name in labels:
        mesh.hull_of(name)
    return mesh.with_labels(labels)


def load_many(patterns: str | Path | Iterable[str | Path]) -> Iterator[symbolic.SymbolicMesh]:
    """Return the symbolic meshes of all files that the patterns match (`**` too), sorted, each read when asked for.

    Raises AssetError at once where a pattern matches no asset.
    """
    paths = set[Path]()
    for pattern in [patterns] if isinstance(patterns, str | Path) else patterns:
        found = [Path(pattern)] if Path(pattern).exists() else [Path(name) for name in expand_glob(str(pattern))]
        known = [path for path in found if is_asset(path) or path == Path(pattern)]
        if not known:
            problem = "no file matches" if not found else "none of the files it matches is an asset"
            raise AssetError(problem, where=str(pattern), remedy=f"Known suffixes: {', '.join(all_suffixes())}.")
        paths.update(known)
    return (load(path) for path in sorted(paths))


def labels_beside(path: Path) -> Path:
    """Return where the labels of an asset lie: beside it, `table.labels.json` for table.urdf and a folder `table`."""
    suffix = path.suffix.lower()
    is_file = not path.is_dir() and suffix.removeprefix(".") in FORMATS_BY_SUFFIX
    stem = path.stem if is_file else path.name
    return path.with_name(f"{stem}.labels.json")


def convert(
    asset: SymbolicMesh | Source,
    out: str | Path,
    *,
    link: bool = False,
    overwrite: bool = False,
    names: MarkName | None = None,
    collision: Collision | None = None,
    urdf_capsules: bool = False,
    one_file_a_hull: bool = False,
) -> SaveResult:
    """Write an asset in the format that the suffix of `out` names, or unchanged in its own; its labels beside it.

    asset: a mesh, or what `load` reads. link: files that are only copied become hard links; overwrite: existing files
    may be replaced. names: how the file marks collision; collision: where the hulls of a scene go in which nothing is
    marked; urdf_capsules: whether a URDF gets `<capsule>`; one_file_a_hull: whether each hull of a mesh gets a file of
    its own: all as `save` has them.
    The result says what the format cannot hold, in `.notes` and `.report`. Labels keep the names that hulls have there.
    Raises AssetError and UsageError as `load` and `save` do.
    """
    mesh = to_mesh(asset)
    mesh = part_meshes(mesh, out) if one_file_a_hull else mesh
    saved = save(
        mesh, out, link=link, overwrite=overwrite, names=names, collision=collision, urdf_capsules=urdf_capsules
    )
    return _write_labels(mesh, saved, overwrite) if mesh.labels else saved


def to_mjspec(mesh: SymbolicMesh) -> Any:
    """Return the mesh as a `mujoco.MjSpec`; see `SymbolicMesh.to_mjspec`."""
    from meshforge.formats.mjcf.format import build_spec  # lazy: only MuJoCo needs it

    return build_spec(make_output(mesh, "mjcf", "model.xml"))


def _write_labels(mesh: SymbolicMesh, saved: SaveResult, overwrite: bool) -> SaveResult:
    path = labels_beside(saved.path)
    if path.exists() and not overwrite:
        note = f"{path} is there already and was left as it is"
        return replace(saved, report=replace(saved.report, remarks=(*saved.report.remarks, note)))
    write_labels(path, mesh.as_written(saved.names, read(saved.path)), ())
    return saved
