"""What is run by hand: set-up, checks, tests, and the maker of the bundled samples."""
