"""Very many damaged files for every reader, each read or refused in little time and memory."""
