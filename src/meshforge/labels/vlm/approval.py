"""Which hosts may be sent pictures and a key: the user says so, once a host, in a file outside of all projects."""

from __future__ import annotations

import os
import sys
from collections.abc import Collection, Mapping
from pathlib import Path
from urllib.parse import urlsplit

from meshforge.common import UsageError, write_atomically
from meshforge.labels.vlm.endpoint import Endpoint

_HEAD = "# Hosts that MeshForge may send pictures of assets and a key to, one a line.\n"


def approvals_path(environment: Mapping[str, str] = os.environ) -> Path:
    """The file of approved hosts: below `XDG_CONFIG_HOME`, else where the platform keeps what a user configures."""
    if base := environment.get("XDG_CONFIG_HOME"):
        return Path(base) / "meshforge" / "approved_hosts"
    folder = {
        "win32": Path(environment.get("APPDATA") or Path.home() / "AppData" / "Roaming"),
        "darwin": Path.home() / "Library" / "Application Support",
    }.get(sys.platform, Path.home() / ".config")
    return folder / "meshforge" / "approved_hosts"


def approve_host(host: str) -> None:
    """Approve a host, such as `api.openai.com` or `example.org:8443`, from now on. Raises UsageError: no host."""
    parts = urlsplit(f"//{host}")
    if not parts.hostname or parts.netloc != host or "@" in host or len(host.split()) != 1:
        raise UsageError(f"{host!r} is no host", remedy="Give it like api.openai.com, or example.org:8443.")
    known = _read_approved()
    if host.lower() not in known:
        write_atomically(approvals_path(), _HEAD + "".join(f"{one}\n" for one in sorted({*known, host.lower()})))


def is_approved(endpoint: Endpoint) -> bool:
    """Whether pictures and a key may be sent: to this machine always, elsewhere where the user said so."""
    return endpoint.is_loopback or endpoint.host in _read_approved()


def check_approved(endpoint: Endpoint, typed: Collection[str] = ()) -> None:
    """Raises UsageError where an endpoint is not approved. typed: addresses that the user typed for this run."""
    if endpoint.base_url not in typed and not is_approved(endpoint):
        problem = f"you have not approved {endpoint.host} yet: {describe_sending(endpoint)}"
        remedy = f"If you trust it: meshforge label PROJECT --approve-host {endpoint.host}"
        raise UsageError(problem, remedy=remedy)


def describe_sending(endpoint: Endpoint) -> str:
    """What is sent where."""
    key = f" and the key in the environment variable {endpoint.key_name}" if endpoint.key_name else ""
    return f"pictures of the assets{key} are sent to {endpoint.host}"


def _read_approved() -> frozenset[str]:
    try:
        lines = approvals_path().read_text("utf-8").splitlines()
    except FileNotFoundError:
        return frozenset()
    return frozenset(line.strip().lower() for line in lines if line.strip() and not line.startswith("#"))
