# Written by `python -m script.stubs`.
from meshforge.labels.names.label_by_names import PatternPairs as PatternPairs
from meshforge.labels.names.label_by_names import label_from_names as label_from_names
from meshforge.labels.names.label_by_names import propose_from_names as propose_from_names
