"""A project's labels from a vision-language model: its settings, its cost, and what is written."""
