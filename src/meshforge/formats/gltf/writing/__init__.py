"""From an edited asset back to its scene: nodes emptied and added in the convention of the file."""
