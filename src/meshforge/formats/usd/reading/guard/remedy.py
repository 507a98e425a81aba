"""What helps where a file is damaged, and how deep things may lie in each other."""

REMEDY = "Fetch or export it anew."
NEEDLESS = "No asset needs that."
DEEPEST = 1000
"""Things within things: the library goes down by recursion, and overflows its stack at some ten thousands."""
