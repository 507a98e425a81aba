"""The search for one rule's extractor: what leaves select, which terms they make, what a goal still needs."""
