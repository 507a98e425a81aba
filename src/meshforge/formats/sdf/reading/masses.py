"""What the links of an SDF weigh: as the file tells, or as Gazebo computes it of their collisions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from meshforge.asset import Geom, Inertial, Opaque
from meshforge.errors import MeshForgeError
from meshforge.formats.sdf.files.values import is_true, text_of
from meshforge.formats.sdf.reading.links import Links, place_in
from meshforge.formats.xml import Element, numbers
from meshforge.geometry import inertia

_DENSITY = 1000.0  # [kg/m^3], libsdformat's default
_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_DEFAULTS = (1.0, 0.0, 0.0, 1.0, 0.0, 1.0)


def is_computed(link: Element) -> bool:
    """Whether the mass of a link is computed of its collisions (`<inertial auto="true">`)."""
    inertial = link.first("inertial")
    return inertial is not None and is_true(inertial.attributes.get("auto", ""))


def read_masses(links: Links) -> Iterator[Inertial]:
    """The masses that the file tells; one that is not understood is left out, it never fails."""
    for body, link in links.by_body.items():
        element = link.element.first("inertial")
        if element is None or is_computed(link.element):
            continue
        mass = _number(element, "mass", 1.0)
        if mass <= 0:
            continue
        try:
            pose = place_in(links.places, link, element)
        except MeshForgeError:
            pose = link.pose
        tensor = element.first("inertia")
        moments = (_number(tensor, name, default) for name, default in zip(_MOMENTS, _DEFAULTS, strict=True))
        xx, xy, xz, yy, yz, zz = moments
        tensor_in = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        yield Inertial(body, mass, pose.translation, pose.rotation @ tensor_in @ pose.rotation.T)


def computed_masses(
    links: Links, elements: Mapping[str, Element], geoms: Sequence[Geom], opaque: Sequence[Opaque]
) -> Iterator[Inertial]:
    """The masses that Gazebo computes of collisions; none for a link with one that is no hull, of unknown volume.

    elements: the `<collision>` of each hull by its name.
    """
    unknown = {piece.body for piece in opaque}
    for body, link in links.by_body.items():
        own = [geom for geom in geoms if geom.body == body]
        if not is_computed(link.element) or not own or body in unknown:
            continue
        inertial = link.element.first("inertial")
        common = _number(inertial, "density", _DENSITY)
        densities = [_number(elements[geom.name], "density", common) for geom in own]
        found = _sum([(geom, density) for geom, density in zip(own, densities, strict=True) if density > 0])
        if found is None:
            continue
        mass, centre, tensor = found
        told = _number(inertial, "mass", 0.0)  # from 1.12 on, what the link is to weigh in all
        share = told / mass if told > 0 and link.scope.version >= (1, 12) else 1.0
        yield Inertial(body, mass * share, centre, tensor * share)


def _sum(parts: Sequence[tuple[Geom, float]]) -> tuple[float, np.ndarray, np.ndarray] | None:
    """The mass, its centre and the inertia about it of shapes of given densities."""
    if not parts:
        return None
    masses = np.array([density * geom.shape.volume for geom, density in parts])
    total = float(masses.sum())
    centre = masses / total @ np.array([geom.shape.centroid for geom, _ in parts])
    tensors = [inertia([geom.shape], mass, centre)[1] for (geom, _), mass in zip(parts, masses, strict=True)]
    return total, centre, np.sum(tensors, axis=0)


def _number(parent: Element | None, tag: str, default: float) -> float:
    """The number of a child element, the default where there is none that can be read."""
    found = numbers(text_of(parent, tag))
    return found[0] if found and len(found) == 1 else default
