"""The Structured Text front end: text -> tokens -> tree with types, and the portability rules on that tree."""
