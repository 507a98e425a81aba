"""What happens to a run that is killed, or whose disk or inputs fail it: many times, at random moments, recorded."""
