"""`meshforge plugins`: what other packages add, and whether it loads."""

from typing import Any

import typer

from meshforge.checks import CHECKS
from meshforge.checks.goals.registry import GOALS
from meshforge.cli.console import print_table
from meshforge.cli.options import Json
from meshforge.cli.terminal import print_json
from meshforge.common import PLUGIN_KINDS, Plugin, PluginKind, Registry, find_plugins
from meshforge.formats import FORMATS_BY_SUFFIX
from meshforge.labels import LABELERS
from meshforge.language import ACTIONS, EXTRACTORS

_REGISTRIES: dict[PluginKind, Registry[Any]] = {
    "formats": FORMATS_BY_SUFFIX,
    "extractors": EXTRACTORS,
    "actions": ACTIONS,
    "labelers": LABELERS,
    "checks": CHECKS,
    "goals": GOALS,
}


def plugins(json: Json = False) -> None:
    """List the plug-ins that are installed: kind, name, package, version, and whether each loads.

    Exit code 1 when one does not; the reason is beside it.
    """
    found = [plugin for kind in PLUGIN_KINDS for plugin in find_plugins(kind)]
    rows = [(plugin, _REGISTRIES[plugin.kind].find_problem(plugin)) for plugin in found]
    if json:
        print_json([_to_row(plugin, problem) for plugin, problem in rows])
    elif rows:
        cells = [(one.kind, one.name, one.package, one.version, problem or "yes") for one, problem in rows]
        print_table(("kind", "name", "package", "version", "loads"), cells)
    else:
        typer.echo("There are no plug-ins. docs/plugins.md shows how to write one.")
    raise typer.Exit(int(any(problem for _, problem in rows)))


def _to_row(plugin: Plugin, problem: str | None) -> dict[str, Any]:
    return {
        "kind": plugin.kind,
        "name": plugin.name,
        "package": plugin.package,
        "version": plugin.version,
        "loads": problem is None,
        "reason": problem,
    }
