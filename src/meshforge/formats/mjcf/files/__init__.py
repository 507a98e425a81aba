"""The files of an MJCF as they were authored: includes, what they refer to, and the one text that MuJoCo gets."""
