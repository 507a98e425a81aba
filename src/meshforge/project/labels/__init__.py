"""The labels of a project: from people, names, files, a few labelled assets or a model; a person's always wins."""
