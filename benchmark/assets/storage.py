"""The frozen data: parts, sites, hulls, labels and purities of all assets, hulls in hundredths of a millimetre."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from manifold3d import Manifold, Mesh

from benchmark.assets.asset import Asset, Site
from benchmark.assets.decomposition import SEPARATE, SETTINGS, Decomposition
from meshforge.common import write_atomically
from meshforge.geometry import Floats, Ints, Polytope, Pose
from meshforge.symbolic import Hull, Label, SymbolicMesh
from script.samples.part import Part
from script.samples.pieces import DIGITS, triangles

DATA = Path(__file__).resolve().parent / "data"
_FINE = 7  # digits of parts, which booleans are made with


@dataclass(frozen=True, eq=False)
class Sample:
    """One collision mesh with its true labels, in the frame of its file; shares: as of `Decomposition`."""

    name: str
    asset: Asset
    setting: str
    mesh: SymbolicMesh
    shares: tuple[Mapping[str, float], ...] = field(repr=False)

    @property
    def purities(self) -> tuple[float, ...]:
        """Of each hull the share of its volume in parts that is in parts of its label."""
        return tuple(max(row.values()) for row in self.shares)

    @property
    def decomposition(self) -> Decomposition:
        """The mesh as it was made."""
        return Decomposition(
            tuple(Polytope(hull.vertices, hull.faces) for hull in self.mesh.hulls), tuple(map(dict, self.shares))
        )


def samples(category: str, calibration: bool = False, settings: Sequence[str] = SEPARATE) -> tuple[Sample, ...]:
    """The frozen collision meshes of a category at some settings, asset by asset; by default the separate ones."""
    return tuple(row for row in _read_frozen(stem_of(category, calibration)) if row.setting in settings)


@cache
def _read_frozen(stem: str) -> tuple[Sample, ...]:
    return read(DATA, stem)


def stem_of(category: str, calibration: bool = False) -> str:
    """What the files of a category are called."""
    return f"{category}-calibration" if calibration else category


class _Meshes:
    """Triangle meshes, one after the other in three arrays."""

    def __init__(self) -> None:
        self.points: list[Ints] = []
        self.faces: list[Ints] = []

    def add(self, points: Floats, faces: Ints, digits: int) -> int:
        self.points.append(np.round(points * 10**digits).astype(np.int32))
        self.faces.append(faces.astype(np.uint16))
        return len(self.points) - 1

    def pack(self) -> bytes:
        buffer = io.BytesIO()
        counts = [[len(p), len(f)] for p, f in zip(self.points, self.faces, strict=True)]
        points, faces = np.concatenate(self.points), np.concatenate(self.faces)
        np.savez_compressed(buffer, counts=np.array(counts, dtype=np.uint32), points=points, faces=faces)
        return buffer.getvalue()


def write(folder: Path, stem: str, rows: Iterable[tuple[Asset, Mapping[str, Decomposition]]]) -> None:
    """Write assets with their collision meshes by setting: STEM.npz, and STEM.json with all that is not geometry."""
    meshes, told = _Meshes(), []
    for asset, by_setting in rows:
        parts = [(part, triangles(part.solid)) for part in asset.parts]
        told.append(
            {
                "name": asset.name,
                "category": asset.category,
                "kind": asset.kind,
                "rare": asset.rare,
                "about": asset.about,
                "scanned": asset.scanned,
                **({"attempt": asset.attempt} if asset.attempt else {}),
                "pose": [asset.pose.rotation.ravel().tolist(), asset.pose.translation.tolist()],
                "sites": [site.to_json() for site in asset.sites],
                "parts": [[part.name, part.label, meshes.add(*mesh, _FINE)] for part, mesh in parts],
                "meshes": {
                    setting: [
                        [meshes.add(hull.vertices, hull.faces, DIGITS), share]
                        for hull, share in zip(made.hulls, made.shares, strict=True)
                    ]
                    for setting, made in sorted(by_setting.items(), key=lambda row: SETTINGS.index(row[0]))
                },
            }
        )
    lines = ",\n".join(json.dumps(row) for row in told)
    write_atomically(folder / f"{stem}.npz", meshes.pack())
    write_atomically(folder / f"{stem}.json", f"[\n{lines}\n]\n")


def read(folder: Path, stem: str) -> tuple[Sample, ...]:
    """What `write` wrote."""
    with np.load(folder / f"{stem}.npz", allow_pickle=False) as arrays:
        points, faces, counts = (arrays[name].astype(np.int64) for name in ("points", "faces", "counts"))
    ends = np.cumsum(counts, axis=0)
    begins = ends - counts

    def mesh(place: int, digits: int) -> tuple[Floats, Ints]:
        (p0, f0), (p1, f1) = begins[place], ends[place]
        return points[p0:p1] / 10.0**digits, faces[f0:f1]

    rows: Sequence[dict[str, Any]] = json.loads((folder / f"{stem}.json").read_text("utf-8"))
    return tuple(sample for row in rows for sample in _samples(row, mesh))


def _samples(row: dict[str, Any], mesh: Callable[[int, int], tuple[Floats, Ints]]) -> Iterable[Sample]:
    asset = Asset(
        row["name"],
        row["category"],
        row["kind"],
        row["rare"],
        row["about"],
        tuple(Part(name, label, _solid(*mesh(place, _FINE))) for name, label, place in row["parts"]),
        tuple(map(Site.of_json, row["sites"])),
        Pose(np.reshape(row["pose"][0], (3, 3)), row["pose"][1]),
        row["scanned"],
        row.get("attempt", 0),
    )
    for setting in SETTINGS:
        hulls = row["meshes"].get(setting, [])
        width = len(str(max(len(hulls) - 1, 0)))
        named = tuple(_hull(k, width, Polytope(*mesh(place, DIGITS)), share) for k, (place, share) in enumerate(hulls))
        if named:
            yield Sample(f"{asset.name}_{setting}", asset, setting, SymbolicMesh(named), tuple(s for _, s in hulls))


def _hull(number: int, width: int, shape: Polytope, share: Mapping[str, float]) -> Hull:
    label = max(share, key=lambda name: share[name])
    return Hull(f"hull_{number:0{width}}", "body", shape, Label(label, 1.0, "file"))


def _solid(points: Floats, faces: Ints) -> Manifold:
    return Manifold(Mesh(points.astype(np.float32), faces.astype(np.uint32)))
