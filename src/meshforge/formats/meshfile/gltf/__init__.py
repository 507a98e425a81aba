"""glTF 2.0 and GLB as far as every reader of them needs: container, scene, geometry."""

from meshforge.formats.meshfile.gltf.container import Container
from meshforge.formats.meshfile.gltf.items import Json
from meshforge.formats.meshfile.gltf.meshes import Patch, Triangles
from meshforge.formats.meshfile.gltf.scene import Placement, Scene, damage_at, parsed
from meshforge.formats.meshfile.gltf.surfaces import parse_gltf

__all__ = ["Container", "Json", "Patch", "Placement", "Scene", "Triangles", "damage_at", "parse_gltf", "parsed"]
