"""The studio: a web server over a project, and the page that it shows.

From below: `wire` (messages), `edits` (what a person can change), `history` and `showing` (what was done; what is
seen), `assets` and `learner` (what takes processes), `state` (the desk), `jobs`, `serving`: the door,
`serve(Opening)`.
"""
