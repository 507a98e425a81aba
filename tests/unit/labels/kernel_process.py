"""A process that carries labels over the bundled tables, and prints all that came of it: to be run on other kernels."""

import json

from meshforge.batch import text_digest
from meshforge.formats import read
from meshforge.label_model import FamilyModel
from meshforge.samples import TABLES
from meshforge.symbolic import Label, SymbolicMesh, read_labels


def main() -> None:
    paths = sorted(TABLES.glob("*.obj"))
    meshes = [SymbolicMesh.of(read(path)) for path in paths]
    known = [read_labels(path.with_suffix(".labels.json")).labels for path in paths]
    shapes = [
        [text_digest(repr((hull.vertices.tolist(), hull.faces.tolist()))) for hull in mesh.hulls] for mesh in meshes
    ]
    relatives, advised, labels = FamilyModel(meshes), list[int](), list[list[object]]()
    for _ in range(3):
        told = [
            Label(known[place][hull.name].name) if place in advised else None
            for place, mesh in enumerate(meshes)
            for hull in mesh.hulls
        ]
        found = relatives.infer(told)
        labels += [[(label.name, label.confidence) for label in found.labels(k) if label] for k in range(len(meshes))]
        advised += found.next_to_label()
    print(json.dumps({"shapes": shapes, "advised": advised, "labels": labels}))


if __name__ == "__main__":
    main()
