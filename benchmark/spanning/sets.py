"""The sets of meshes with hulls that span parts: generated assets by one call of CoACD, in two settings; real ones."""

from __future__ import annotations

import numpy as np

from benchmark.assets import MERGED, Sample, samples
from benchmark.assets.decomposition import solids_of
from benchmark.real.samples import real_asset
from benchmark.real.tasks import tasks_of as list_real_tasks
from benchmark.real.whole import REAL, list_whole, visual_surface, whole_sample
from benchmark.tasks import Task, tasks
from meshforge.geometry import Floats, Ints
from script.samples.pieces import triangles

ALL_SETS = (*MERGED, REAL)


def list_names(category: str, setting: str, calibration: bool = False) -> list[str]:
    """The names of the assets of a category, or of a family of real ones. No real asset is made for that."""
    if setting == REAL:
        return list(list_whole(category))
    return [sample.asset.name for sample in samples(category, calibration, (setting,))]


def find_sample(category: str, setting: str, name: str, calibration: bool = False) -> Sample:
    """The mesh of one asset. Raises AssetError where it is a real one, and the corpus is not here."""
    if setting == REAL:
        return whole_sample(category, name)
    return next(one for one in samples(category, calibration, (setting,)) if one.asset.name == name)


def list_samples(category: str, setting: str, calibration: bool = False) -> tuple[Sample, ...]:
    """The meshes of all assets of a category, or of a family of real ones."""
    return tuple(
        find_sample(category, setting, name, calibration) for name in list_names(category, setting, calibration)
    )


def list_tasks(category: str, setting: str) -> list[Task]:
    """The tasks on the assets of a category, or of a family of real ones."""
    return list_real_tasks(category) if setting == REAL else [one for one in tasks() if one.category == category]


def surface_of(sample: Sample) -> tuple[Floats, Ints]:
    """Vertices (n, 3) [m] and triangles (m, 3) of what the mesh was decomposed from, in the frame of its file.

    Of a real asset it is all that its file shows, before what is watertight of it is united.
    """
    if sample.setting == REAL:
        points, faces = visual_surface(real_asset(sample.asset.category, sample.asset.name))
    else:
        (solid,) = solids_of(sample.asset, sample.setting)
        points, faces = triangles(solid)
    return np.round(sample.asset.pose.apply(points), 7), faces
