"""The studio: a web server over a project, and the page that it shows."""
