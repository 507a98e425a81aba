"""Plug-ins that do one thing wrong, as source of a module."""

HEAD = """
from dataclasses import dataclass, field
import sys
import numpy as np
from meshforge.checks import Check, Finding, Goal
from meshforge.formats import Format, Output
from meshforge.geometry import Polytope, Pose, convex_hull
from meshforge.labels import AssetLabeler
from meshforge.language import Action, FactorArgument, GroupEdit, HullGroup, NewShape
from meshforge.symbolic import Asset, Body, Document, Geom, Label

CUBE = convex_hull(np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float))

def dented():
    points = CUBE.vertices.copy()
    points[(points == 1).all(axis=1)] = 0.2
    return Polytope(points, CUBE.faces)

def cube_of(fault):
    vertices, faces = CUBE.vertices.copy(), CUBE.faces
    match fault:
        case "convex":
            return dented()
        case "closed":
            return Polytope(vertices, faces[1:])
        case "finite":
            vertices[0] = np.nan
            return Polytope(vertices, faces)
        case "volume":
            return Polytope(vertices, faces[:, ::-1])
        case "rounding":
            return Polytope(vertices + 1e-7 * (np.arange(24).reshape(8, 3) % 5 - 2), faces)
    return CUBE
"""
ACTION = """
@dataclass(frozen=True, slots=True)
class {name}(Action):
    \"\"\"Does something wrong.\"\"\"
    def edit(self, group):
        {body}
"""
FORMAT = """
class Cubes(Format):
    name = title = "cubes"
    suffixes = (".cube",)
    def read(self, path, options):
        {body}
    def write(self, asset, name, mass="keep"):
        return Output(b"cube")
"""
CUBE_ASSET = 'Asset(path, "cubes", (Body("body", Pose.identity()),), (Geom("one", "body", {shape}),), Document())'
LABELER = """
class Namer(AssetLabeler):
    def label(self, mesh, vocabulary):
        {body}
"""
FAMILY_LABELER = """
from meshforge.labels import AssetLabels, Labeler, LabelProposal
class Namer(Labeler):
    def propose(self, family):
        top = Label(family.require_vocabulary()[0], 0.7, "plugin")
        facts = family.iterate_facts()
        return LabelProposal(AssetLabels(a, one.hulls, dict.fromkeys(one.hulls, top)) for a, one in facts)
"""
"""A labeller that sees the whole family, right in all."""
CHECK = """
class Look(Check):
    def examine(self, mesh, before):
        {body}
"""
GOAL = """
@dataclass(frozen=True, slots=True)
class Odd(Goal):
    def find_failure(self, subject):
        {body}
"""
IN_WORKER = """
import sys
if "pytest" not in sys.modules:
    raise ModuleNotFoundError(f"No module named {__name__!r}", name=__name__)
"""
"""A package that is missing in worker processes."""
