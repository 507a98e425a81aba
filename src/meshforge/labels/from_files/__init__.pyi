# Written by `python -m script.stubs`.
from meshforge.labels.from_files.label_by_files import label_from_files as label_from_files
from meshforge.labels.from_files.label_by_files import propose_from_files as propose_from_files
from meshforge.labels.from_files.read import LabelFileOptions as LabelFileOptions
