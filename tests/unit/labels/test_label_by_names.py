from functools import partial
from pathlib import Path

import pytest

from meshforge.common import ProjectError, UsageError
from meshforge.labels import LabelOutcome, NameLabeler, OfferCache
from meshforge.project import Project
from meshforge.symbolic import Label
from tests.unit.batch.families import Corner, tree

BOX: tuple[Corner, Corner] = ((0, 0, 0), (1, 1, 1))
URDF = '<robot name="r">{links}</robot>'
LINK = '<link name="{link}">{parts}</link>'
PART = '<collision name="{name}"><geometry><box size="1 1 1"/></geometry></collision>'


def named(folder: Path, *vocabulary: str, **bodies: tuple[str, ...]) -> Project:
    """A project of one robot of some bodies with collisions of some names."""
    links = "".join(
        LINK.format(link=link, parts="".join(PART.format(name=name) for name in names))
        for link, names in bodies.items()
    )
    joints = "".join(
        f'<joint name="j{k}" type="fixed"><parent link="{next(iter(bodies))}"/><child link="{link}"/></joint>'
        for k, link in enumerate(list(bodies)[1:])
    )
    (folder / "assets").mkdir(parents=True)
    (folder / "assets/robot.urdf").write_text(URDF.format(links=links + joints))
    return Project.create(folder / "p", [folder / "assets"], vocabulary=vocabulary)


def found(project: Project) -> dict[str, str]:
    return dict(OfferCache().of(project).names.get("robot.urdf", {}))


def test_labels_are_taken_where_there_are_none(tmp_path: Path) -> None:
    project = named(tmp_path, "door", "leg", base=("door1", "door2", "thing"))
    project.set_labels("robot.urdf", {"base/door1": "leg"})
    before = tree(project.folder / "labels")
    assert found(project) == {"base/door2": "door"}
    assert tree(project.folder / "labels") == before
    assert project.label("names").outcomes == (LabelOutcome("robot.urdf", taken=1, unlabelled=1),)
    labels = project.labels("robot.urdf").labels
    assert labels == {"base/door1": Label("leg"), "base/door2": Label("door", 0.7, "name")}
    assert project.label("names").outcomes == (LabelOutcome("robot.urdf", unlabelled=1),)


def test_without_a_vocabulary_nothing_can_be_taken(tmp_path: Path) -> None:
    project = named(tmp_path, base=("door",))
    assert OfferCache().of(project).names == {}
    with pytest.raises(ProjectError, match="the vocabulary is empty"):
        project.label("names")


# Patterns


def with_names(project: Project, table: str) -> Project:
    """The project with a table of patterns in its settings."""
    path = project.layout.settings
    path.write_text(f"{path.read_text()}\n[names]\n{table}\n")
    return project


def test_patterns_of_the_settings_count_in_their_order_and_before_words(tmp_path: Path) -> None:
    project = named(tmp_path, "door", "leg", base=("door1", "K_door2", "strut3", "strut4"))
    with_names(project, '"k_*" = ""\n"/strut[0-3]$/" = "leg"\n"strut*" = "door"')
    expected = {"base/door1": "door", "base/strut3": "leg", "base/strut4": "door"}
    assert found(project) == expected
    project.label("names")
    labels = project.labels("robot.urdf").labels
    assert {name: label.name for name, label in labels.items()} == expected
    assert labels["base/strut3"] == Label("leg", 0.9, "name")


def test_given_patterns_precede_those_of_the_settings(tmp_path: Path) -> None:
    project = with_names(named(tmp_path, "door", "leg", base=("strut",)), '"strut" = "door"')
    project.label(NameLabeler([("s*", "leg")]))
    assert project.labels("robot.urdf").labels["base/strut"].name == "leg"


def test_offers_follow_the_patterns(tmp_path: Path) -> None:
    project, offers = named(tmp_path, "door", "leg", base=("strut",)), OfferCache()
    assert offers.of(project).names == {}
    with_names(project, '"strut" = "door"')
    assert offers.of(project).names == {"robot.urdf": {"base/strut": "door"}}


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ('"strut" = "dor"', "the pattern strut means 'dor', which is not in the vocabulary\n  Did you mean 'door'?"),
        (
            '"/[/" = "door"',
            "the pattern /[/ is no regular expression: unterminated character set at position 0\n  Correct it.",
        ),
    ],
)
def test_a_pattern_that_makes_no_sense_is_told_with_its_file(tmp_path: Path, table: str, message: str) -> None:
    project = with_names(named(tmp_path, "door", base=("strut",)), table)
    for ask in (partial(project.label, "names"), partial(OfferCache().of, project)):
        with pytest.raises(UsageError) as told:
            ask()
        assert told.value.message == f"{project.layout.settings}: {message}"


def test_a_label_that_is_renamed_is_renamed_in_the_patterns(tmp_path: Path) -> None:
    project = with_names(named(tmp_path, "door", "leg", base=("strut",)), '"*strut*" = "door"  # as seen\n"a" = "leg"')
    project.rename_label("door", "gate")
    assert '"*strut*" = "gate"  # as seen\n"a" = "leg"\n' in project.layout.settings.read_text()
    assert found(project) == {"base/strut": "gate"}
