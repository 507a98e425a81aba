"""What the start page does: remembers projects, lists folders, looks at assets, and makes projects."""
