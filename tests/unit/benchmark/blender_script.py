"""A script that does the task `cup-easy`."""

SHELLS = """
from mathutils import Matrix, Vector
walls = [o for o in bpy.context.scene.objects if o["label"] == "wall"]
def box(vectors):
    vectors = list(vectors)
    return [Vector(pick(v[k] for v in vectors) for k in range(3)) for pick in (min, max)]
low, high = box(o.matrix_world @ v.co for o in walls for v in o.data.vertices)
parts = templates["shell.obj"]
first, last = box(v.co for part in parts for v in part.vertices)
scale = [(b - a) / (d - c) for a, b, c, d in zip(low, high, first, last)]
for o in walls:
    bpy.data.objects.remove(o)
for part in parts:
    new = bpy.data.objects.new("wall", part)
    new["label"] = "wall"
    new.matrix_world = Matrix.Translation(low) @ Matrix.Diagonal((*scale, 1)) @ Matrix.Translation(-first)
    bpy.context.scene.collection.objects.link(new)
"""
