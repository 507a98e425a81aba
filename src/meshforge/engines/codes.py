"""The codes of all that checks, goals and edits find, such as MF204, as `codes.toml` has them: they stay the same over
versions, for builds that look for them. Rules of plug-ins have none."""

import tomllib
from dataclasses import dataclass
from importlib.resources import files
from types import MappingProxyType


@dataclass(frozen=True, slots=True)
class RuleCode:
    """A code. rules: the names of the rules that it stands for; title: what is wrong; why: it matters; remedy: what to
    do; example: of an asset that has it."""

    code: str
    rules: tuple[str, ...]
    title: str
    why: str
    remedy: str
    example: str


_ROWS = tomllib.loads(files("meshforge.engines").joinpath("codes.toml").read_text("utf-8"))
CODES = MappingProxyType({code: RuleCode(code, tuple(row.pop("rules")), **row) for code, row in _ROWS.items()})
"""Every code, in order."""
CODES_BY_RULE = MappingProxyType({rule: code for code, row in CODES.items() for rule in row.rules})
"""The code of each rule; those of plug-ins have none."""
