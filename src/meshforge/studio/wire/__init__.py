"""The messages between server and page; the one source of both sides' types."""
