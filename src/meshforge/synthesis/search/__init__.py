"""The search for one rule's extractor: what leaves select, which terms they make, what a goal still needs."""

from meshforge.synthesis.search.smallest import Answer, Hit, Miss, Search, Tried, Unfinished

__all__ = ["Answer", "Hit", "Miss", "Search", "Tried", "Unfinished"]
