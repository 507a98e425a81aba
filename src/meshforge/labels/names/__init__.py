"""Labels read off names: by patterns, by the words in them, and by words that are nearly those of a label."""
