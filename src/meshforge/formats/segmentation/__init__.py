"""Points that another tool gave classes, and the names of these classes."""
