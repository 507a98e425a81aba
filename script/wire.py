"""Makes the page's TypeScript types from the studio's messages; usage: script/make-wire [--check]."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from types import ModuleType
from typing import Any, Literal

from pydantic import TypeAdapter
from pydantic.json_schema import models_json_schema

from meshforge.studio.edits import AnyEdit
from meshforge.studio.wire import Wire, asset, events, family, jobs, program, requests, start

WEB = Path(__file__).parent.parent / "web"
TARGET = WEB / "src" / "wire.ts"
_HEAD = "// Made by script/make-wire from meshforge.studio.wire and meshforge.studio.edits; change it there."


def schema() -> dict[str, Any]:
    """One JSON schema of all messages, with the unions of edits, events and jobs by name.

    What the server sends has all of its fields; what the page sends may leave out those with a default.
    """
    asked = _models(requests)
    sent = [model for model in _models(asset, events, family, program, start) if model not in asked]
    pairs = [*((model, "serialization") for model in sent), *((model, "validation") for model in asked)]
    _, whole = models_json_schema(pairs, ref_template=_REF)  # type: ignore[arg-type]  # literals become str in a list
    definitions = whole["$defs"]
    for name, union, mode in _UNIONS:
        made = TypeAdapter(union).json_schema(ref_template=_REF, mode=mode)
        definitions |= made.pop("$defs", {})
        definitions[name] = made
    names = sorted(definitions)
    return {
        "title": "Everything",
        "type": "object",
        "additionalProperties": False,
        "properties": {name: {"$ref": f"#/$defs/{name}"} for name in names},
        "required": names,
        "$defs": {name: _plain(definitions[name]) for name in names},
    }


_REF = "#/$defs/{model}"
_UNIONS: tuple[tuple[str, Any, Literal["validation", "serialization"]], ...] = (
    ("AnyEdit", AnyEdit, "validation"),
    ("NewProject", start.NewProject, "validation"),
    ("JobRequest", jobs.JobRequest, "validation"),
    ("Event", events.Event, "serialization"),
)


def _models(*modules: ModuleType) -> list[type[Wire]]:
    found = (value for module in modules for value in vars(module).values())
    return list(dict.fromkeys(v for v in found if isinstance(v, type) and issubclass(v, Wire) and v is not Wire))


def _plain(node: Any) -> Any:
    """The schema without the titles of fields, which would become types of their own; tuples in the older form."""
    if isinstance(node, list):
        return [_plain(item) for item in node]
    if not isinstance(node, dict):
        return node
    out = {key: _plain(value) for key, value in node.items() if key != "discriminator"}
    if isinstance(out.get("title"), str):
        del out["title"]
    if "prefixItems" in out:
        out |= {"items": out.pop("prefixItems"), "additionalItems": False}
    if "const" in out.get("properties", {}).get("kind", ()):  # what tells a union's members apart is always there
        out["required"] = list(dict.fromkeys(["kind", *out.get("required", [])]))
    return out


def generate() -> str:
    """The text of the TypeScript file."""
    command = ["node", "node_modules/json-schema-to-typescript/dist/src/cli.js", "--additionalProperties=false"]
    command += ["--maxItems=16", "--no-unknownAny", f"--bannerComment={_HEAD}"]
    done = subprocess.run(command, cwd=WEB, input=json.dumps(schema()), capture_output=True, text=True, check=True)
    return done.stdout


if __name__ == "__main__":
    text = generate()
    if "--check" in sys.argv[1:]:
        sys.exit(0 if TARGET.read_text(encoding="utf-8") == text else f"{TARGET} is not up to date: script/make-wire")
    TARGET.write_text(text, encoding="utf-8")
