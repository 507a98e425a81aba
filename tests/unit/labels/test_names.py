"""Labels read off names: right where names say them, sure only where they say them plainly."""

from fnmatch import fnmatchcase

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from meshforge.labels.names.label_by_names import HullNames, NameMatch, match_names, pattern_of
from meshforge.labels.names.words import (
    EXACT,
    common,
    fillers,
    is_same,
    is_synonym,
    match_label,
    places,
    split_joined_word,
    synonyms,
    words_of,
)

VOCABULARY = ("drawer", "handle", "door", "knob", "leg", "top", "back", "frame", "shelf", "panel", "seat", "armrest")
SURE = 0.5


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("leftDoor_2", ("left", "door")),
        ("left-door", ("left", "door")),
        ("URDFLink12b", ("urdf", "link", "b")),
        ("DRAWER", ("drawer",)),
        ("großeTür", ("grosse", "tür")),
        ("geom0", ("geom",)),
        ("12", ()),
        ("", ()),
    ],
)
def test_a_name_is_split_at_all_but_letters_and_at_capitals(name: str, words: tuple[str, ...]) -> None:
    assert words_of(name) == words


@pytest.mark.parametrize(
    ("one", "several"),
    [("box", "boxes"), ("leg", "legs"), ("shelf", "shelves"), ("knife", "knives"), ("body", "bodies")],
)
def test_plurals_are_the_same_word(one: str, several: str) -> None:
    assert is_same(one, several) and is_same(several, one)
    assert not is_same(one, "seat")


@pytest.mark.parametrize(
    ("name", "label", "confidence"),
    [
        ("handle", "handle", 0.7),
        ("Handles_03", "handle", 0.7),
        ("shelves", "shelf", 0.7),
        ("arm_rest", "armrest", 0.7),
        ("desk_drawer_wood", "drawer", 0.7),
        ("table_leg_2", "leg", 0.7),
        # the last thing is what it is
        ("drawer_handle", "handle", 0.6),
        ("doorKnob", "knob", 0.6),
        ("handle_of_drawer", "handle", 0.6),
        ("back_left_leg", "leg", 0.6),
        # joined words
        ("kettlehandle", "handle", 0.7),
        ("lftdoor", "door", 0.7),
        ("hingeleftdoor", "door", 0.7),
        ("microdoorroot", "door", 0.7),
        ("tabletop", "top", 0.7),
        # another thing may be meant
        ("door_left_nob", "door", 0.45),
        ("drawer_top", "drawer", 0.45),
        ("motor_back", "back", 0.45),
        # shortened and misspelt
        ("drwr_1", "drawer", 0.6),
        ("hndl", "handle", 0.6),
        ("pnl", "panel", 0.6),
        ("hanlde", "handle", 0.45),
        ("drawwer", "drawer", 0.45),
        ("pannel", "panel", 0.45),
        ("hamdle", "handle", 0.45),
    ],
)
def test_what_a_name_says_and_how_surely(name: str, label: str, confidence: float) -> None:
    found = match_label(name, VOCABULARY)
    assert found is not None
    assert (found.label, found.confidence) == (label, confidence)


ALIKE = (
    "geom7 12 backend legend handlebar hand solid template laptop stop feedback cupboard adjustable chain shell flame "
    "draw hdl panes but topology outdoor collides seal"
)


@pytest.mark.parametrize("name", ["", *ALIKE.split()])
def test_words_that_only_look_alike_say_nothing(name: str) -> None:
    assert match_label(name, (*VOCABULARY, "lid", "plate", "board", "chair", "button", "table")) is None


def test_the_longer_label_counts_and_two_alike_say_nothing() -> None:
    assert match_label("drawer_front", ("drawer", "drawer front")) == match_label(
        "drawerfront", ("drawer", "drawer front")
    )
    found = match_label("shelf_2_boards", ("shelf", "board", "shelf board"))
    assert found and found.label == "shelf board"
    assert match_label("door", ("Door", "door")) is None


def test_a_label_that_means_nothing_gives_way() -> None:
    found = match_label("base_link", ("base", "link"))
    assert found and found.label == "base"


@given(st.sampled_from(VOCABULARY), st.sampled_from(["left_", "", "Upper"]), st.sampled_from(["", "_01", "_collision"]))
def test_the_word_of_a_label_says_it(label: str, before: str, after: str) -> None:
    assume(label not in places())
    for word in (label, label.upper(), label.title(), f"{label}s"):
        found = match_label(f"{before}{word}{after}", VOCABULARY)
        assert found is not None
        assert (found.label, found.confidence, found.how) == (label, EXACT, "word")


@given(st.text("abcdefghijklmnopqrstuvwxyz", min_size=1, max_size=12))
def test_common_words_stand_for_themselves_and_guesses_are_unsure(word: str) -> None:
    found = match_label(word, VOCABULARY)
    if found and found.how != "word" and not is_synonym(word, found.label):
        assert word not in common() | fillers()
        assert word[0] == found.label[0]
        assert found.confidence < EXACT


@given(st.sampled_from(sorted(common())))
def test_no_common_word_is_taken_for_another(word: str) -> None:
    found = match_label(word, VOCABULARY)
    is_exact = (
        found is not None and found.how == "word" and is_same(split_joined_word(word, VOCABULARY)[-1], found.label)
    )
    assert found is None or is_exact or is_synonym(word, found.label)


@given(
    st.lists(st.sampled_from(VOCABULARY), unique=True, min_size=1), st.sampled_from(["oak_drwr", "doors", "legHandle"])
)
def test_the_order_of_the_vocabulary_does_not_matter(vocabulary: list[str], name: str) -> None:
    assert match_label(name, vocabulary) == match_label(name, vocabulary[::-1])


@pytest.mark.parametrize(
    ("name", "vocabulary", "label"),
    [
        ("knob_1", ("drawer", "handle"), "handle"),
        ("table_slab", ("panel", "leg"), "panel"),
        ("stretchers", ("rail", "seat"), None),
        ("rung_2", ("stretcher", "seat"), "stretcher"),
        ("door_knob", ("door", "handle"), "handle"),
        ("tabletop", ("panel", "leg"), "panel"),
        ("tabletop", ("top", "panel"), "top"),
        ("drawer_top", ("drawer", "panel"), "drawer"),  # a place says which drawer
        ("knob", ("handle", "dial"), None),  # it may be either
        ("knob", ("handle", "knob"), "knob"),
        ("lamp", ("bulb", "shade"), None),  # the whole thing
    ],
)
def test_another_word_for_a_part_is_read_less_surely(name: str, vocabulary: tuple[str, ...], label: str | None) -> None:
    found = match_label(name, vocabulary)
    assert (found and found.label) == label
    assert found is None or found.how == "word" or found.confidence <= SURE


def test_synonyms_are_words_and_none_of_places() -> None:
    for word, others in synonyms().items():
        assert word not in others
        assert all(one == one.lower() and one.isalpha() for one in (word, *others))
        assert not others & fillers()


def test_the_lists_of_words_hold_no_word_twice_over() -> None:
    assert not common() & places()
    assert all(word == word.lower().strip() for word in common() | fillers())


# Names of a hull together


def test_the_own_name_counts_first_then_what_is_its_own_then_the_body_then_the_rest() -> None:
    names = HullNames("b1/geom0", "left_door", (("mesh", "handle"), ("class", "leg"), ("material", "seat")))
    assert match_names(names, VOCABULARY) == NameMatch("handle", 0.7, "mesh", "handle", "word")
    assert match_names(HullNames("b/knob", "left_door", names.mentions[1:]), VOCABULARY) == NameMatch(
        "knob", 0.7, "hull", "b/knob", "word"
    )
    bare = HullNames("left_door/geom0", "left_door", (("class", "leg"), ("material", "seat")))
    assert match_names(bare, VOCABULARY) == NameMatch("door", 0.6, "body", "left_door", "word")
    assert match_names(HullNames("x/geom0", "x", bare.mentions), VOCABULARY) == NameMatch(
        "leg", 0.6, "class", "leg", "word"
    )
    assert match_names(HullNames("x/geom0", "x", (("material", "seat"),)), VOCABULARY) == NameMatch(
        "seat", 0.5, "material", "seat", "word"
    )


def test_a_name_that_is_unsure_gives_way_to_a_surer_one() -> None:
    names = HullNames("b/drawer_top", "b", (("mesh", "draw"),))
    assert match_names(HullNames("b/draw", "oak_door"), VOCABULARY) == NameMatch(
        "door", 0.6, "body", "oak_door", "word"
    )
    only = match_names(names, VOCABULARY)
    assert only and only.confidence < SURE and only.name == "drawer_top"


def test_names_of_its_own_that_contradict_each_other_make_it_unsure() -> None:
    names = HullNames("b/drawer", "b", (("mesh", "drawer_handle"),))
    assert match_names(names, VOCABULARY) == NameMatch("drawer", 0.45, "hull", "drawer", "word")
    agreeing = HullNames("handle/drawer", "handle", (("mesh", "drawer1"), ("material", "seat")))
    assert match_names(agreeing, VOCABULARY) == NameMatch("drawer", 0.7, "hull", "drawer", "word")


def test_the_body_of_a_format_without_bodies_says_nothing() -> None:
    assert match_names(HullNames("geom0", "body"), ("body",)) is None


def test_patterns_come_before_words_and_may_leave_a_hull_bare() -> None:
    names = HullNames("door/knob1", "door")
    glob, none = pattern_of("*DOOR*", "frame"), pattern_of("/^knob[0-9]$/", "")
    assert match_names(names, VOCABULARY, [glob]) == NameMatch("frame", 0.9, "body", "door", "pattern")
    assert match_names(names, VOCABULARY, [glob, none]) == NameMatch(None, 0.9, "hull", "knob1", "pattern")
    assert match_names(names, VOCABULARY, [pattern_of("door/*", "leg")]) == NameMatch(
        "leg", 0.9, "hull", "door/knob1", "pattern"
    )
    assert match_names(names, VOCABULARY, [pattern_of("nob", "leg")]) == match_names(names, VOCABULARY)


texts = st.text("abAB*?[]!-_.\n", max_size=8)


@given(texts, texts)
def test_globs_fit_whole_names_whatever_their_case(pattern: str, name: str) -> None:
    assume(not (pattern.startswith("/") and pattern.endswith("/")))
    assert pattern_of(pattern, "leg").matches(name) == fnmatchcase(name.lower(), pattern.lower())
