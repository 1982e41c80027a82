"""What `show` prints: pieces of a map as tables and cards for a person. Knows the model and rich, reads no files."""
