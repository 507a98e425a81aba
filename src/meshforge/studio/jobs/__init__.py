"""Long work: begun by a page, seen by all, and stopped by any."""

from meshforge.studio.jobs.board import Jobs
from meshforge.studio.jobs.running import Running

__all__ = ["Jobs", "Running"]
