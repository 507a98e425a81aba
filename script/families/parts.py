"""The labelled hulls of a sample, and what several kinds of sample write of them."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from meshforge.formats import MeshPart, format_obj
from meshforge.geometry import Polytope, Pose
from meshforge.symbolic import Surface
from script.families.pieces import hull_of


@dataclass(frozen=True, slots=True)
class SampleHull:
    """A hull of a sample as its file has it: its name, its label and its shape."""

    name: str
    label: str
    shape: Polytope


def name_hulls(
    parts: Iterable[tuple[str, Iterable[Polytope]]], pattern: str = "{}", pose: Pose | None = None
) -> list[SampleHull]:
    """The hulls of parts (label, hulls), in that order, put at a pose.

    pattern: what they are called, with `{}` for the number, from 0 on, as wide as the last one.
    """
    hulls = [(label, hull_of(hull.vertices, pose) if pose else hull) for label, own in parts for hull in own]
    width = len(str(len(hulls) - 1))
    return [SampleHull(pattern.format(f"{k:0{width}}"), label, hull) for k, (label, hull) in enumerate(hulls)]


def join_surfaces(hulls: Iterable[Polytope]) -> Surface:
    """All triangles of hulls, as what is seen of them."""
    each = list(hulls)
    starts = np.cumsum([0, *(len(hull.vertices) for hull in each)])
    faces = [hull.faces + start for hull, start in zip(each, starts.tolist(), strict=False)]
    return Surface(np.concatenate([hull.vertices for hull in each]), np.concatenate(faces))


def format_hulls(hulls: Iterable[SampleHull], about: str) -> bytes:
    """An OBJ with a group for each hull."""
    parts = [MeshPart(hull.name, Surface(hull.shape.vertices, hull.shape.faces)) for hull in hulls]
    return f"# {about}\n".encode() + format_obj(parts)


def format_labels(names: Iterable[str], labels: Iterable[str]) -> bytes:
    """A labels file in its short form."""
    return (json.dumps({"hulls": dict(zip(names, labels, strict=True))}, indent=2) + "\n").encode()
