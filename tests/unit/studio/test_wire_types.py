"""The page's types are those of the server's messages."""

from script.wire import TARGET, generate


def test_the_types_of_the_page_are_made_from_the_messages_as_they_are() -> None:
    assert TARGET.read_text(encoding="utf-8") == generate(), "run script/make-wire"
