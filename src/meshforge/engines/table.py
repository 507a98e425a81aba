"""The engines, row by row, and notes on hulls that are written for them; `docs/engines.md` shows this table, and a test
holds the two together.

A source that begins with `owner/name` is a repository on GitHub, and a file in it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import replace
from types import MappingProxyType

from meshforge import symbolic
from meshforge.common import UsageError, suggest_among
from meshforge.engines.limits import Engine, Finding, check_limit, check_primitives, make_limit

_COARSER = "PhysX makes a coarser hull of it"
_COOKED = "PhysX leaves part of the hull out"
_NO_GPU = "PhysX makes a coarser hull of it, refuses it, or computes its contacts on the CPU"
_ON_CPU = "contacts with it fall back to the CPU"
_PHYSX = "NVIDIA-Omniverse/PhysX 5.6, physx/"
_DESC = _PHYSX + "include/cooking/PxConvexMeshDesc.h: "
_RESULT = _PHYSX + "include/cooking/PxCooking.h: "
_COOKING = _PHYSX + "source/geomutils/src/cooking/"
_THICKNESS = (
    "nvidia-omniverse.github.io/PhysX, PhysxConvexHullCollisionAPI: minThickness, 0.001 in the unit of the stage"
)
_PLAIN = frozenset({"box", "sphere", "capsule"})
_PLAIN_OF_PHYSX = _PHYSX + "include/geometry/PxGeometry.h: PxGeometryType; PxConvexCoreGeometry from 5.5 on"
_STANDS_FOR_IT = "not a plain shape of PhysX, a convex mesh or, from 5.5 on, a convex core stands for it"
_ALL = frozenset({"box", "sphere", "capsule", "cylinder", "ellipsoid"})
_JOLT = "godotengine/godot, thirdparty/jolt_physics/Jolt/Physics/Collision/Shape/ConvexHullShape"

_ENGINES = (
    Engine(
        "mujoco",
        "MuJoCo",
        (
            make_limit(
                "face-vertices",
                19,
                "warning",
                "MJX leaves some of them out",
                "google-deepmind/mujoco, mjx/mujoco/mjx/_src/mesh.py: _merge_coplanar thins faces of 20 vertices "
                "and more; MuJoCo itself has no limit",
            ),
            make_limit(
                "volume",
                2e-15,
                "error",
                "MuJoCo refuses the mesh",
                "MuJoCo 4.0, tried: up to mjMINVAL, 1e-15, `mesh volume is too small`; with margin for rounding",
            ),
        ),
        _ALL,
        "",
        "mujoco.readthedocs.io, XML reference, body/geom/type; MuJoCo 4.0, tried",
    ),
    Engine(
        "physx-cpu",
        "PhysX on the CPU",
        (
            make_limit("vertices", 255, "error", _COARSER, _DESC + "vertexLimit, at most 255"),
            make_limit("polygons", 255, "error", _COOKED, _RESULT + "ePOLYGONS_LIMIT_REACHED, 255 polygons"),
            make_limit("thin", 0.001, "warning", "Omniverse thickens it", _THICKNESS + "; PhysX itself has no limit"),
        ),
        _PLAIN,
        _STANDS_FOR_IT,
        _PLAIN_OF_PHYSX,
    ),
    Engine(
        "physx-gpu",
        "PhysX on the GPU (Isaac, SAPIEN)",
        (
            make_limit("vertices", 64, "error", _NO_GPU, _COOKING + "GuCookingConvexMesh.cpp: gpuMaxVertsLimit"),
            make_limit("polygons", 64, "error", _NO_GPU, _COOKING + "GuCookingConvexMesh.cpp: gpuMaxFacesLimit"),
            make_limit(
                "face-vertices",
                31,
                "error",
                _NO_GPU,
                _COOKING + "GuCookingConvexHullLib.h: gpuMaxVertsPerFace; PxConvexMesh::isGpuCompatible tells 32",
            ),
            make_limit(
                "vertex-faces",
                32,
                "error",
                "more than PhysX has on the GPU; what becomes of it is not documented",
                _DESC + "32 faces per vertex in a GPU compatible mesh",
            ),
            make_limit(
                "oblong",
                100,
                "warning",
                _ON_CPU,
                _RESULT + "eNON_GPU_COMPATIBLE; measured as in physx/source/geomutils/src/convex/GuConvexMeshData.h: "
                "checkExtentRadiusRatio, by half the length",
            ),
            make_limit("thin", 0.001, "warning", "Isaac thickens it", _THICKNESS),
        ),
        _PLAIN,
        _STANDS_FOR_IT,
        _PLAIN_OF_PHYSX,
        64,
        "contacts of so many hulls can overflow the buffers that simulators reserve",
        "not documented; by experience, as of others with Isaac Sim (SarahWeiii/CoACD, issue 10)",
    ),
    Engine(
        "unreal",
        "Unreal",
        (
            make_limit(
                "vertices",
                32,
                "warning",
                "more than Unreal's own tool gives to a hull",
                "no hard limit; Unreal 5.8, Engine/Source/Editor/StaticMeshEditor/Private/StaticMeshEditorTools.cpp: "
                "Max Hull Verts goes from 6 to 32",
            ),
        ),
        _PLAIN,
        "Unreal has no such shape, a convex hull stands for it",
        "dev.epicgames.com, UInterchangeGenericMeshPipeline, bImportCollisionAccordingToMeshName: UBX, USP, UCP, UCX",
    ),
    Engine(
        "unity",
        "Unity",
        (
            make_limit(
                "vertices",
                255,
                "error",
                "Unity makes a coarser hull of it",
                "that of PhysX, which Unity is built on; Unity-Technologies/com.unity.cv.synthetichumans, issue 8, "
                "tells 256",
            ),
            make_limit(
                "polygons",
                255,
                "error",
                "Unity makes a partial hull of it",
                "docs.unity3d.com, manual, Mesh Collider: 255 triangles; its warning, as in that issue 8, "
                "counts polygons",
            ),
        ),
        _PLAIN,
        "Unity has no such collider, a convex Mesh Collider stands for it",
        "docs.unity3d.com, manual: Box, Sphere, Capsule and Mesh Collider",
    ),
    Engine(
        "bullet",
        "Bullet",
        (
            make_limit(
                "vertices",
                100,
                "warning",
                "more than is practical in Bullet",
                "no hard limit; advice of Bullet's manual, as jMonkeyEngine/jmonkeyengine, issue 1037, tells it",
            ),
            make_limit(
                "thin",
                0.002,
                "warning",
                "its margin makes it twice as thick",
                "bulletphysics/bullet3, examples/Importers/ImportURDFDemo/BulletUrdfImporter.cpp: "
                "gUrdfDefaultCollisionMargin, 0.001 on each side; PyBullet 3.2, tried",
            ),
        ),
        _ALL - {"ellipsoid"},
        "Bullet's importers have no such shape, a convex hull stands for it",
        "bulletphysics/bullet3, examples/Importers/ImportURDFDemo/UrdfParser.h: UrdfGeomTypes",
    ),
    Engine(
        "godot",
        "Godot with Jolt",
        (
            make_limit(
                "vertices",
                256,
                "error",
                "Jolt leaves part of the hull out",
                _JOLT + ".cpp: cMaxPointsInHull, of which the hull is made where MaxVerticesReached",
            ),
            make_limit(
                "thin",
                0.002,
                "warning",
                "Jolt leaves out what rises less than 1 mm above the rest",
                _JOLT + ".h: mHullTolerance, 0.001 on each side",
            ),
        ),
        _ALL - {"ellipsoid"},
        "Godot has no such shape, a ConvexPolygonShape3D stands for it",
        "godotengine/godot, modules/jolt_physics/shapes: box, sphere, capsule, cylinder, convex polygon",
    ),
)
ENGINES = MappingProxyType({engine.name: engine for engine in _ENGINES})
"""The engines whose limits are known, by the name that the command line takes."""


def find_engine(name: str) -> Engine:
    """Return the engine of a name. Raises UsageError for one that is not known."""
    if name not in ENGINES:
        raise UsageError(f"there is no engine {name!r}", remedy=suggest_among(name, ENGINES, "Known are:"))
    return ENGINES[name]


def note_limits(
    geoms: Iterable[symbolic.Geom], engines: Iterable[str], holds: Collection[symbolic.FeatureKind]
) -> tuple[str, ...]:
    """Return a note on each rule that hulls break of the engines a file is for, with the hulls, the engines and the
    remedy.

    engines: by name; holds: what the format holds: a native shape that it does not counts as the mesh that stands for
    it.
    """
    native = {kind for kind, what in symbolic.PRIMITIVE_FEATURES.items() if what in holds}
    written = [
        geom if geom.shape.kind in {"polytope", *native} else replace(geom, shape=geom.shape.tessellate())
        for geom in geoms
    ]
    found: dict[str, tuple[Finding, list[str]]] = {}
    for engine in map(ENGINES.__getitem__, engines):
        limits = (limit for limit in engine.limits if limit.severity == "error")
        broken = (finding for limit in limits if (finding := check_limit(engine, limit, written)))
        for finding in (*broken, *check_primitives(engine, written)):
            found.setdefault(finding.message, (finding, []))[1].append(engine.title)
    return tuple(f"{' and '.join(titles)}: {one.message}. {one.remedy}" for one, titles in found.values())
