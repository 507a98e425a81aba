"""Where a model is asked: the address, the model, the place of the key, prices; and which hosts a user has approved."""

import os
import sys
from collections.abc import Collection
from dataclasses import dataclass
from ipaddress import ip_address
from pathlib import Path
from urllib.parse import SplitResult, urlsplit

from meshforge.common import MeshForgeError, UsageError, write_atomically
from meshforge.store import VlmSettings

_KEYS = {
    "api.openai.com": "OPENAI_API_KEY",
    "generativelanguage.googleapis.com": "GEMINI_API_KEY",
    "api.anthropic.com": "ANTHROPIC_API_KEY",
}
"""The environment variable of the key of each host that is known; no key is ever sent to another host unasked."""
_KEY_SUFFIX = "_API_KEY"
_HEAD = "# Hosts that MeshForge may send pictures of assets and a key to, one a line.\n"


class QuestionError(MeshForgeError):
    """A question that got no answer; others may get one."""


class RefusalError(QuestionError):
    """A question that the server does not take as it stands."""


class EndError(QuestionError):
    """No further question would get an answer: a wrong key, no such model, nobody there, no money left, or stopped."""


@dataclass(frozen=True, slots=True)
class Endpoint:
    """An OpenAI-compatible server and a model on it, as the table [vlm] names them.

    Raises UsageError for values that do not fit.
    """

    settings: VlmSettings

    def __post_init__(self) -> None:
        parts = self._parts
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise UsageError(
                f"{self.settings.base_url!r} is no address", remedy="Give it like https://api.openai.com/v1."
            )
        if parts.username or parts.password or parts.query:
            remedy = "Put the key into an environment variable, and name that as key_env."
            raise UsageError("a base_url holds no key, name or query", where=self.place, remedy=remedy)
        if self.key_name and not self.key_name.endswith(_KEY_SUFFIX):
            remedy = f"Name a variable that ends in {_KEY_SUFFIX}: no other one is ever sent."
            raise UsageError(f"key_env names {self.key_name}", where=self.place, remedy=remedy)
        if self.key_name and parts.scheme == "http" and not self.is_loopback:
            problem = f"the key in {self.key_name} would be sent where others can read it"
            raise UsageError(problem, where=self.place, remedy='Give an https address, or key_env = "" for no key.')
        if not self.settings.model:
            raise UsageError("no model is named", where=self.place, remedy="Name one: --model NAME, or model in [vlm].")

    @property
    def _parts(self) -> SplitResult:
        return urlsplit(self.settings.base_url)

    @property
    def host(self) -> str:
        """The name of the machine, with the port where one is given."""
        name, port = self._parts.hostname or "", self._parts.port
        return f"{name}:{port}" if port else name

    @property
    def is_loopback(self) -> bool:
        """Whether the host is this machine."""
        name = self._parts.hostname or ""
        try:
            return name == "localhost" or ip_address(name).is_loopback
        except ValueError:
            return False

    @property
    def place(self) -> str:
        """The address without anything secret."""
        return f"{self._parts.scheme}://{self.host}{self._parts.path.rstrip('/')}"

    @property
    def key_name(self) -> str:
        """The environment variable of the key, empty where the server wants none."""
        named = self.settings.key_env
        return _KEYS.get(self._parts.hostname or "", "") if named is None else named

    def key(self) -> str:
        """Return the key, empty where the server wants none. Raises EndError where its variable is not set."""
        name = self.key_name
        key = os.environ.get(name, "").strip() if name else ""
        if name and not key:
            remedy = f'Set it: export {name}=...; for a server that wants no key write key_env = "" in [vlm].'
            raise EndError(f"the environment variable {name}, which holds the key, is not set", remedy=remedy)
        return key

    @property
    def is_priced(self) -> bool:
        return None not in (self.settings.input_price, self.settings.output_price)

    def price(self, given: float, made: float) -> float:
        """Return what so many tokens in and out cost [$]; a price that is not known counts as none."""
        return (given * (self.settings.input_price or 0) + made * (self.settings.output_price or 0)) / 1_000_000


def approve_host(host: str) -> None:
    """Approve a host, such as `api.openai.com` or `example.org:8443`, from now on. Raises UsageError: no host."""
    parts = urlsplit(f"//{host}")
    if not parts.hostname or parts.netloc != host or "@" in host or len(host.split()) != 1:
        raise UsageError(f"{host!r} is no host", remedy="Give it like api.openai.com, or example.org:8443.")
    lines = sorted({*_read_approved(), host.lower()})
    write_atomically(_approvals_path(), _HEAD + "".join(f"{line}\n" for line in lines))


def check_approved(endpoint: Endpoint, typed: Collection[str] = ()) -> None:
    """Raise UsageError where the user has approved neither an endpoint's host, nor its address, which is one of those
    `typed` for this run; this machine needs no approval."""
    approved = endpoint.is_loopback or endpoint.settings.base_url in typed or endpoint.host in _read_approved()
    if not approved:
        problem = f"you have not approved {endpoint.host} yet: {describe_sending(endpoint)}"
        remedy = f"If you trust it: meshforge label PROJECT --approve-host {endpoint.host}"
        raise UsageError(problem, remedy=remedy)


def describe_sending(endpoint: Endpoint) -> str:
    """Return a sentence on what is sent where."""
    key = f" and the key in the environment variable {endpoint.key_name}" if endpoint.key_name else ""
    return f"pictures of the assets{key} are sent to {endpoint.host}"


def _approvals_path() -> Path:
    """The file of approved hosts, outside of all projects, where the platform keeps what a user configures."""
    folder = {
        "win32": Path(os.environ.get("APPDATA") or Path.home() / "AppData" / "Roaming"),
        "darwin": Path.home() / "Library" / "Application Support",
    }.get(sys.platform, Path.home() / ".config")
    return Path(os.environ.get("XDG_CONFIG_HOME") or folder) / "meshforge" / "approved_hosts"


def _read_approved() -> set[str]:
    try:
        lines = _approvals_path().read_text("utf-8").splitlines()
    except FileNotFoundError:
        return set()
    return {line.strip().lower() for line in lines if line.strip() and not line.startswith("#")}
