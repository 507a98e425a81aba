"""What a project of a stranger cannot have sent: nothing to a host that the user did not approve, no other secrets."""

import sys
from pathlib import Path

import pytest

from meshforge.common import UsageError
from meshforge.labels import Endpoint, VlmLabeler, approve_host, check_approved
from meshforge.labels.vlm import label_by_vlm
from meshforge.project import Project
from meshforge.store import VlmSettings
from tests.loopback import KEY
from tests.unit.cli.in_process import Run
from tests.unit.cli.terminal import Terminal
from tests.unit.labels.vlm.asking import endpoint
from tests.unit.labels.vlm_family import VARIABLE, family

EVIL = "https://evil.example/v1"
APPROVALS = "config/meshforge/approved_hosts"


@pytest.fixture(autouse=True)
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    """A project that came from somebody, whose settings lead elsewhere; nothing is approved."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("AWS_SECRET", "secret")
    monkeypatch.setenv(VARIABLE, KEY)
    return family(tmp_path, 2)


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The addresses to which a client would have been opened."""
    addresses = list[str]()

    def refuse(endpoint: Endpoint, *words: object, **more: object) -> None:
        addresses.append(endpoint.settings.base_url)
        raise UsageError("opened")

    monkeypatch.setattr(label_by_vlm, "Client", refuse)
    return addresses


def _lead_to(project: Project, address: str, key: str = VARIABLE) -> None:
    with project.layout.settings.open("a") as file:
        file.write(f'\n[vlm]\nbase_url = "{address}"\nmodel = "m"\nkey_env = "{key}"\n')


def test_a_host_that_is_not_approved_ends_with_2_and_names_how_to(project: Project, run: Run, asked: list[str]) -> None:
    _lead_to(project, EVIL)
    done = run("label", "p", "--with", "vlm")
    assert done.code == 2 and asked == [] and not Path(APPROVALS).exists()
    assert "you have not approved evil.example yet: pictures of the assets" in done.err
    assert f"the key in the environment variable {VARIABLE} are sent to evil.example" in done.err
    assert "label PROJECT --approve-host evil.example" in done.err


def test_an_approved_host_is_one_line_in_the_users_folder(project: Project, run: Run, asked: list[str]) -> None:
    _lead_to(project, EVIL)
    assert run("label", "p", "--approve-host", "Evil.example").code == 0
    assert Path(APPROVALS).read_text().splitlines()[1:] == ["evil.example"]
    done = run("label", "p", "--with", "vlm")
    assert asked == [EVIL]
    assert f"the key in the environment variable {VARIABLE} are sent to evil.example" in done.err
    with pytest.raises(UsageError, match=r"you have not approved evil\.example:8443"):
        check_approved(endpoint("https://evil.example:8443/v1"))


def test_an_approval_in_the_project_counts_for_nothing(project: Project, run: Run, asked: list[str]) -> None:
    _lead_to(project, EVIL)
    for folder in (project.folder, project.folder / ".meshforge", Path()):
        folder.mkdir(exist_ok=True)
        (folder / "approved_hosts").write_text("evil.example\n")
    assert run("label", "p", "--with", "vlm").code == 2 and asked == []


def test_an_address_that_is_typed_is_approved_for_that_run(project: Project, run: Run, asked: list[str]) -> None:
    _lead_to(project, "https://other.example/v1")
    run("label", "p", "--with", "vlm", "--base-url", EVIL)
    assert asked == [EVIL] and not Path(APPROVALS).exists()


@pytest.mark.parametrize("key", ["AWS_SECRET", "HOME", "API_KEY_OF_MINE"])
def test_only_variables_of_keys_are_sent(project: Project, run: Run, asked: list[str], key: str) -> None:
    _lead_to(project, EVIL, key)
    approve_host("evil.example")
    done = run("label", "p", "--with", "vlm")
    assert done.code == 2 and asked == [] and f"key_env names {key}" in done.err and "_API_KEY" in done.err


def test_no_key_is_sent_in_clear_but_to_this_machine() -> None:
    with pytest.raises(UsageError, match="would be sent where others can read it"):
        endpoint("http://evil.example/v1", VARIABLE)
    endpoint("http://evil.example/v1")
    for host in ("localhost", "127.0.0.1:80", "127.9.9.9", "[::1]:8000"):
        check_approved(endpoint(f"http://{host}/v1", VARIABLE))
    for host in ("localhost.evil.example", "127.0.0.1.evil.example", "evil.example"):
        with pytest.raises(UsageError):
            check_approved(endpoint(f"https://{host}/v1"))


def test_python_refuses_alike(project: Project, asked: list[str]) -> None:
    with pytest.raises(UsageError, match="--approve-host evil"):
        project.label(VlmLabeler(VlmSettings(base_url=EVIL, model="m", key_env=VARIABLE)))
    assert asked == []


@pytest.mark.parametrize("host", ["", "https://evil.example", "evil.example/v1", "a@evil.example", "a b"])
def test_what_is_no_host_is_not_approved(host: str) -> None:
    with pytest.raises(UsageError, match="is no host"):
        approve_host(host)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="no pseudo-terminals there")
def test_at_a_terminal_a_person_is_asked_once(project: Project) -> None:
    _lead_to(project, "https://meshforge.invalid/v1")
    words = ("label", "p", "--with", "vlm")
    with Terminal(*words, cwd=Path()) as terminal:
        terminal.until("are sent to meshforge.invalid. Is that right?")
        terminal.enter("n")
        assert terminal.end() == 2
    assert not Path(APPROVALS).exists()
