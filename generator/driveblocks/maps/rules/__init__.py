"""Rules across a map, one module per part of it; each rule notes what contradicts and where."""
