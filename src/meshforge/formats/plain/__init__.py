"""Files that hold triangles and nothing else, one by one or a folder of them: OBJ, STL, PLY, and VRML to read."""
