"""The studio: a web server over a project, and the page that it shows.

From below: `wire` (messages), `edits` (what a person can change), `queries` (what a page asks), `learning`,
`session` (one open project), `jobs` (long work), and `api`, whose `server.serve` is the entry.
"""
