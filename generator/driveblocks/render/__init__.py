"""Model -> context -> Jinja templates -> canonical Structured Text. Templates hold the ST, Python holds the facts."""
