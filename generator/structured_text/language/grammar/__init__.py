"""The grammar of Structured Text (annex B): functions that take tokens from a cursor and give parts of the tree."""
