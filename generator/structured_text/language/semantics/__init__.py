"""What a tree means (clauses 2 and 3): functions that type and check its parts within a scope."""
