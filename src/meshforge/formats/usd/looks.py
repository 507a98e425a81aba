"""Pictures on the meshes of a new stage: materials of the kind UsdPreviewSurface, and the files of the pictures."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshforge.formats.libraries import pxr
from meshforge.formats.usd.colliders import apply_schemas
from meshforge.formats.usd.prims import add_prim, free_prim_name, set_value
from meshforge.symbolic import Picture, Texture

_SCOPE = "Looks"


class StageLooks:
    """Makes materials below the root prim of a stage; files: the pictures by their place beside the stage.

    stem: of the name of the stage.
    """

    def __init__(self, root: Any, stem: str) -> None:
        self.files: dict[str, bytes] = {}
        self._root, self._stem = root, stem
        self._materials: dict[Picture, Any] = {}
        self._scope: Any = None

    def put_on(self, mesh: Any, texture: Texture) -> None:
        """Show a picture on the spec of a mesh, by its vertices."""
        places = np.ascontiguousarray(texture.coordinates, dtype=np.float32)
        set_value(mesh, "primvars:st", "TexCoord2fArray", pxr.Vt.Vec2fArray.FromNumpy(places))
        mesh.attributes["primvars:st"].SetInfo("interpolation", "vertex")
        apply_schemas(mesh, ["MaterialBindingAPI"])
        binding = pxr.Sdf.RelationshipSpec(mesh, "material:binding", False)
        binding.targetPathList.explicitItems = [self._material_of(texture.picture).path]

    def _material_of(self, picture: Picture) -> Any:
        if picture not in self._materials:
            if self._scope is None:
                taken = [child.name for child in self._root.nameChildren]
                self._scope = add_prim(self._root, free_prim_name(_SCOPE, taken), "Scope")
            number = len(self._materials)
            place = f"textures/{self._stem}_{number}{picture.suffix}"
            self.files[place] = picture.data
            self._materials[picture] = _add_material(self._scope, f"picture_{number}", f"./{place}")
        return self._materials[picture]


def _add_material(holder: Any, name: str, file: str) -> Any:
    """A material whose diffuse colour is a picture, placed by the primvar `st`."""
    material = add_prim(holder, name, "Material")
    reader = _add_shader(material, "st", "UsdPrimvarReader_float2")
    set_value(reader, "inputs:varname", "String", "st")
    picture = _add_shader(material, "picture", "UsdUVTexture")
    set_value(picture, "inputs:file", "Asset", pxr.Sdf.AssetPath(file))
    set_value(picture, "inputs:sourceColorSpace", "Token", "sRGB")
    for way in ("wrapS", "wrapT"):
        set_value(picture, f"inputs:{way}", "Token", "repeat")
    surface = _add_shader(material, "surface", "UsdPreviewSurface")
    _connect(picture, "inputs:st", "Float2", reader, "outputs:result", "Float2")
    _connect(surface, "inputs:diffuseColor", "Color3f", picture, "outputs:rgb", "Float3")
    _connect(material, "outputs:surface", "Token", surface, "outputs:surface", "Token")
    return material


def _add_shader(material: Any, name: str, kind: str) -> Any:
    shader = add_prim(material, name, "Shader")
    set_value(shader, "info:id", "Token", kind, uniform=True)
    return shader


def _connect(target: Any, entry: str, entry_type: str, source: Any, output: str, output_type: str) -> None:
    """Let an attribute of a spec take the value of an output of another one."""
    types = pxr.Sdf.ValueTypeNames
    if output not in source.attributes:
        pxr.Sdf.AttributeSpec(source, output, getattr(types, output_type))
    attribute = pxr.Sdf.AttributeSpec(target, entry, getattr(types, entry_type))
    attribute.connectionPathList.explicitItems = [source.path.AppendProperty(output)]
