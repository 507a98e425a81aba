"""Small meshes to take pictures of."""

from collections.abc import Sequence

import numpy as np
from PIL.Image import Image

from meshforge.geometry import Box, Cylinder, Floats, Pose, Shape, Sphere
from meshforge.symbolic import Hull, Label, SymbolicMesh


def box(center: Sequence[float], size: Sequence[float]) -> Box:
    return Box(Pose.of_translation(center), np.array(size) / 2)


def hull(name: str, shape: Shape, label: str | None = None, confidence: float = 1.0) -> Hull:
    return Hull(name, "body", shape, Label(label, confidence) if label else None)


def table() -> SymbolicMesh:
    """A top in two halves, two legs, and a knob without a label."""
    return SymbolicMesh(
        (
            hull("left", box((-0.3, 0, 0.7), (0.6, 0.8, 0.04)), "panel"),
            hull("right", box((0.3, 0, 0.7), (0.6, 0.8, 0.04)), "panel"),
            hull("leg0", Cylinder(Pose.of_translation((-0.5, 0, 0.35)), 0.05, 0.33), "leg"),
            hull("leg1", Cylinder(Pose.of_translation((0.5, 0, 0.35)), 0.05, 0.33), "leg", 0.3),
            hull("knob", Sphere(Pose.of_translation((0, 0, 0.78)), 0.06)),
        )
    )


def edited() -> SymbolicMesh:
    """The table with one top instead of two halves."""
    kept = [h for h in table().hulls if h.name not in ("left", "right")]
    return SymbolicMesh((*kept, hull("right~1", box((0, 0, 0.7), (1.2, 0.8, 0.04)), "panel")))


def pixels(image: Image) -> Floats:
    """The picture's colours (h, w, 3) in 0..1."""
    return np.asarray(image.convert("RGB"), dtype=np.float64) / 255


def near(found: Floats, color: Floats, tolerance: float = 0.12) -> bool:
    """Whether a lit colour is one of that hue: both compared without their brightness."""
    return bool(np.abs(found / found.max() - color / color.max()).max() <= tolerance)
