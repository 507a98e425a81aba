"""Defects that are planted in the text and the meshes of a URDF; how, and where they fit, is in `defects.toml`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from benchmark.checks.defect_kinds import Defect, Subject, is_deep, move
from meshforge.common import GeometryError
from meshforge.geometry import Floats, Pose, convex_hull, distance
from meshforge.symbolic import Hull, Joint

Element = ElementTree.Element
Rewrite = Callable[[Subject, Path, Element], Defect | None]
"""Changes a URDF, given its file and root, in place; the hulls and bodies changed, None where it does not fit."""
_STEPS = 9
_LEAST = 0.02


def _scale(factor: float) -> Rewrite:
    """All lengths; masses as of the same density."""

    def rewrite(subject: Subject, _: Path, root: Element) -> Defect:
        powers = {"xyz": 1, "size": 1, "radius": 1, "length": 1, "mass": 3}
        for one in root.iter():
            for name, power in powers.items():
                if name in one.attrib and one.tag not in ("axis",):
                    _multiply(one, name, factor**power)
            if one.tag == "mesh":
                one.set("scale", one.get("scale", "1 1 1"))
                _multiply(one, "scale", factor)
            elif one.tag == "mass":
                _multiply(one, "value", factor**3)
            elif one.tag == "inertia":
                for name in one.attrib:
                    _multiply(one, name, factor**5)
        for joint in root.iter("joint"):
            if joint.get("type") == "prismatic":
                for limit in joint.iter("limit"):
                    for name in ("lower", "upper"):
                        _multiply(limit, name, factor)
        return Defect(subject.mesh)

    return rewrite


def _multiply(one: Element, name: str, factor: float) -> None:
    if name in one.attrib:
        one.set(name, " ".join(f"{float(word) * factor:.17g}" for word in one.attrib[name].split()))


def _turn(subject: Subject, _: Path, root: Element) -> Defect:
    """The whole asset turned and moved, by a link above all others."""
    children = {child.get("link") for child in root.iter("child")}
    tops = [link.get("name", "") for link in root.findall("link") if link.get("name") not in children]
    ElementTree.SubElement(root, "link", name="above all")
    for k, top in enumerate(tops):
        joint = ElementTree.SubElement(root, "joint", name=f"above all {k}", type="fixed")
        ElementTree.SubElement(joint, "origin", xyz="0.8 0.6 0", rpy=f"0 0 {np.radians(37)}")
        ElementTree.SubElement(joint, "parent", link="above all")
        ElementTree.SubElement(joint, "child", link=top)
    return Defect(subject.mesh)


def _join(suffix: str) -> Rewrite:
    """The hulls of a body as one mesh, which the link names once."""

    def rewrite(subject: Subject, file: Path, root: Element) -> Defect | None:
        for body, hulls in subject.bodies.items():
            if len(hulls) < 2 or not _leaves_space(hulls):
                continue
            link = next(one for one in root.findall("link") if one.get("name") == body)
            pose = _pose_of(subject, body)
            mesh = file.with_name(f"joined{suffix}")
            (_write_stl if suffix == ".stl" else _write_obj)(mesh, [hull.move(pose.inverse()) for hull in hulls])
            for collision in link.findall("collision"):
                link.remove(collision)
            geometry = ElementTree.SubElement(ElementTree.SubElement(link, "collision"), "geometry")
            ElementTree.SubElement(geometry, "mesh", filename=mesh.name)
            return Defect(subject.mesh, frozenset(hull.name for hull in hulls), frozenset({body}))
        return None

    return rewrite


def _pose_of(subject: Subject, body: str) -> Pose:
    """root_T_body."""
    assert subject.mesh.asset
    return next(one.pose for one in subject.mesh.asset.bodies if one.name == body)


def _leaves_space(hulls: list[Hull]) -> bool:
    try:
        whole = convex_hull(np.concatenate([hull.vertices for hull in hulls]))
    except GeometryError:
        return False
    return sum(hull.volume for hull in hulls) < 0.9 * whole.volume


def _write_obj(path: Path, hulls: list[Hull]) -> None:
    lines, first = ["o all"], 1
    for hull in hulls:
        lines += [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in hull.vertices]
        lines += [f"f {a} {b} {c}" for a, b, c in hull.faces + first]
        first += len(hull.vertices)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _write_stl(path: Path, hulls: list[Hull]) -> None:
    corners = np.concatenate([hull.vertices[hull.faces] for hull in hulls])
    rows = np.zeros(len(corners), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    rows["corners"] = corners
    path.write_bytes(bytes(80) + np.uint32(len(rows)).tobytes() + rows.tobytes())


def _lose_file(subject: Subject, file: Path, root: Element) -> Defect | None:
    meshes = [(link.get("name", ""), mesh) for link in root.findall("link") for mesh in link.iter("mesh")]
    shown = {mesh.get("filename") for visual in root.iter("visual") for mesh in visual.iter("mesh")}
    names = {mesh.get("filename", ""): body for body, mesh in meshes if mesh.get("filename") not in shown}
    for name in subject.shuffle(names, str):
        if (file.parent / name).is_file():
            (file.parent / name).unlink()
            return Defect(subject.mesh, frozenset(), frozenset({names[name]}))
    return None


def _inertials(subject: Subject, root: Element) -> Iterator[tuple[str, Element]]:
    links = {link.get("name", ""): link.find("inertial") for link in root.findall("link")}
    for body in subject.bodies:
        if (own := links.get(body)) is not None:
            yield body, own


def _make_heavy(subject: Subject, _: Path, root: Element) -> Defect | None:
    for body, own in _inertials(subject, root):
        for one in own.iter():
            for name in ("value", "ixx", "iyy", "izz", "ixy", "ixz", "iyz"):
                _multiply(one, name, 1000)
        return Defect(subject.mesh, frozenset(), frozenset({body}))
    return None


def _break_inertia(subject: Subject, _: Path, root: Element) -> Defect | None:
    for body, own in _inertials(subject, root):
        for one in own.iter("inertia"):
            one.set("ixx", str(2 * (float(one.get("iyy", 0)) + float(one.get("izz", 0)))))
            return Defect(subject.mesh, frozenset(), frozenset({body}))
    return None


def _find_joint(root: Element, joint: Joint) -> Element | None:
    return next((one for one in root.findall("joint") if one.get("name") == joint.name), None)


def _turn_axis(subject: Subject, _: Path, root: Element) -> Defect | None:
    for joint in subject.joints:
        own = _find_joint(root, joint)
        axis = own.find("axis") if own is not None else None
        if joint.limits is None or axis is None:
            continue
        below = frozenset(subject.tree.list_below(joint.child))
        words = axis.get("xyz", "1 0 0").split()
        turned = _pose_of(subject, joint.child).rotation  # the axis is told in the frame of the child
        other = turned @ np.roll(turned.T @ joint.axis, 1)
        if _list_met(subject, joint, below, other) - _list_met(subject, joint, below, joint.axis):
            axis.set("xyz", " ".join([words[2], words[0], words[1]]))
            return Defect(subject.mesh, frozenset(), below | {joint.parent})
    return None


def _list_met(subject: Subject, joint: Joint, below: frozenset[str], axis: Floats) -> set[tuple[str, str]]:
    """The pairs of hulls that run into each other on the way of a joint, but not at rest."""
    hulls, met = subject.mesh.hulls, set[tuple[str, str]]()
    moving, rest = ([hull for hull in hulls if (hull.body in below) is moves] for moves in (True, False))
    for way in np.linspace(*joint.limits, _STEPS) if joint.limits else ():
        for one in moving:
            there = move(joint, one.shape, float(way), axis)
            for other in rest:
                if is_deep(there, other.shape, _LEAST * subject.size) and distance(one.shape, other.shape) > 0:
                    met.add((one.name, other.name))
    return met


def _swap_limits(subject: Subject, _: Path, root: Element) -> Defect | None:
    for joint in subject.joints:
        own = _find_joint(root, joint)
        limit = own.find("limit") if own is not None else None
        if joint.limits is not None and joint.limits[0] < joint.limits[1] and limit is not None:
            low, high = limit.get("lower", "0"), limit.get("upper", "0")
            limit.set("lower", high)
            limit.set("upper", low)
            return Defect(subject.mesh, frozenset(), frozenset({joint.child, joint.parent}))
    return None


DEFECTS: Mapping[str, Rewrite] = {
    "millimetres": _scale(1000.0),
    "several pieces in one mesh": _join(".obj"),
    "several pieces in one mesh, Bullet": _join(".stl"),
    "missing file": _lose_file,
    "mass too large": _make_heavy,
    "inertia of no solid": _break_inertia,
    "axis of a joint": _turn_axis,
    "limits of a joint": _swap_limits,
}
HARMLESS: Mapping[str, Rewrite] = {"turned": _turn, "larger": _scale(1.15)}
