"""The files that make up an SDF: where references lead, the model of a folder, elements and their values."""
