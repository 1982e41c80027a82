"""Vendor maps: strict YAML -> frozen data with positions -> rules across the map. Knows nothing of ST or Jinja."""
