"""The paper's three questions, asked anew on the 24 tasks; `benchmark/README.md` is written from the answers."""
