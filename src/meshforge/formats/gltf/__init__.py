"""glTF 2.0 and GLB: scenes with collision nodes, read, and written back with all else as it was."""

from meshforge.formats.gltf.gltf import GltfForGodot, GltfFormat, GltfForUnity, GltfForUnreal

__all__ = ["GltfForGodot", "GltfForUnity", "GltfForUnreal", "GltfFormat"]
