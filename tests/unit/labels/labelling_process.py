"""A process that labels a project as it is told line by line, and says when each is done: made to be killed."""

import json
import sys

from meshforge.project import Project


def main() -> None:
    project = Project.open(sys.argv[1])
    print("ready", flush=True)
    for line in sys.stdin:
        match json.loads(line):
            case ["propagate", *_]:
                project.label("propagate")
            case [source, asset, hull, label]:
                project.set_labels(asset, {hull: label}, source=source, confidence=1.0 if source == "user" else 0.9)
        print("done", flush=True)


if __name__ == "__main__":
    main()
