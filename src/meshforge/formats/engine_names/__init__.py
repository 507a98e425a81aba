"""The names by which game engines know collision, which formats without such a mark use instead."""
