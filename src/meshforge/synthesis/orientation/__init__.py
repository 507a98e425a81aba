"""Which orientation makes the rules learnable, or their extractors smaller."""
