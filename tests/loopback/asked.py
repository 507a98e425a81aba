"""A request as the server got it."""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

_QUESTION = re.compile(r"pieces belong to: (.*?)[?]\s*$", re.DOTALL)


@dataclass(frozen=True)
class Asked:
    """One request; time: how often the same body came before."""

    body: Mapping[str, Any]
    key: str
    time: int

    @cached_property
    def raw(self) -> str:
        """The body, for telling whether two are the same."""
        return json.dumps(self.body, sort_keys=True)

    @cached_property
    def parts(self) -> tuple[str | bytes, ...]:
        """All texts and pictures of all messages, in their order."""
        found: list[str | bytes] = []
        for message in self.body["messages"]:
            content: Any = message["content"]
            if isinstance(content, str):
                found.append(content)
                continue
            for part in content:
                if part["type"] == "text":
                    found.append(part["text"])
                else:
                    head, _, data = part["image_url"]["url"].partition(",")
                    assert head == "data:image/png;base64"
                    found.append(base64.b64decode(data, validate=True))
        return tuple(found)

    @property
    def text(self) -> str:
        return "\n".join(part for part in self.parts if isinstance(part, str))

    @property
    def pictures(self) -> tuple[bytes, ...]:
        return tuple(part for part in self.parts if isinstance(part, bytes))

    @property
    def schema(self) -> Mapping[str, Any] | None:
        form = self.body.get("response_format")
        return form["json_schema"]["schema"] if form else None

    @property
    def is_probe(self) -> bool:
        return "Which of these colours" in self.text

    @property
    def numbers(self) -> tuple[int, ...]:
        """The numbers of the hulls that the labeller asks about."""
        last = next(part for part in reversed(self.parts) if isinstance(part, str))
        found = _QUESTION.search(last)
        return tuple(int(n) for n in re.findall(r"(?:^|, )(\d+)", found[1])) if found else ()

    @property
    def asset(self) -> str:
        """The name of the asset, where it is told."""
        return next((asset for asset, _ in reversed(self.hulls.values())), "")

    @property
    def hulls(self) -> dict[int, tuple[str, str]]:
        """The asset and the name of each hull, by its number, where names are told."""
        found, asset = dict[int, tuple[str, str]](), ""
        for line in self.text.splitlines():
            if heading := re.fullmatch(r"This is .*?, '(.*)'\.", line):
                asset = heading[1]
            elif row := re.match(r"(\d+) \('(.*)'\): size", line):
                found[int(row[1])] = asset, row[2]
        return found
