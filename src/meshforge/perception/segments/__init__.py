"""Labels of hulls from points and faces that something else has segmented."""

from meshforge.perception.segments.placing import Placing, placed
from meshforge.perception.segments.samples import Samples, of_faces, of_points
from meshforge.perception.segments.votes import Vote, Votes, votes

__all__ = ["Placing", "Samples", "Vote", "Votes", "of_faces", "of_points", "placed", "votes"]
