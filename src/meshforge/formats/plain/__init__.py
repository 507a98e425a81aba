"""Files that hold triangles and nothing else, one by one or a folder of them: OBJ, STL, PLY, and VRML to read."""

from meshforge.formats.plain.folder import Folder
from meshforge.formats.plain.obj import Obj
from meshforge.formats.plain.obj_unreal import ObjForUnreal
from meshforge.formats.plain.ply import Ply
from meshforge.formats.plain.stl import Stl
from meshforge.formats.plain.wrl import Wrl

__all__ = ["Folder", "Obj", "ObjForUnreal", "Ply", "Stl", "Wrl"]
