"""What is written: drafts of outputs, their stamps, and how they come into place whatever happens."""
