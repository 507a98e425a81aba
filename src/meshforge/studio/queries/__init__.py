"""What the page asks about assets, programs and the project, and how the answer is worked out."""
