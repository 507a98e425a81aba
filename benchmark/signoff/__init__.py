"""What it takes a person until every asset of a family is right, and how far the tool's figures can be believed."""
