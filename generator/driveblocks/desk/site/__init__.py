"""What a person needs on site, or before: the figures of a line."""
