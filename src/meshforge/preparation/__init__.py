"""What is done to an asset before any program sees it: geometry decomposed, hulls split; kept as data, replayed."""

from meshforge.preparation.decomposing import Decomposed, decompose_asset
from meshforge.preparation.file import (
    RECORD,
    prepared_by,
    read_preparation,
    read_prepared,
    record_digest,
    remove_preparation,
    write_preparation,
)
from meshforge.preparation.record import Preparation, Replaced, Step
from meshforge.preparation.replay import Lost, fitting, prepared
from meshforge.preparation.sources import Source, sources
from meshforge.preparation.splitting import cut_hull, split_hull

__all__ = [
    "RECORD",
    "Decomposed",
    "Lost",
    "Preparation",
    "Replaced",
    "Source",
    "Step",
    "cut_hull",
    "decompose_asset",
    "fitting",
    "prepared",
    "prepared_by",
    "read_preparation",
    "read_prepared",
    "record_digest",
    "remove_preparation",
    "sources",
    "split_hull",
    "write_preparation",
]
