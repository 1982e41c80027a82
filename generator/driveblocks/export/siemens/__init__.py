"""Target `siemens`: sources of TIA Portal for S7-1200 and S7-1500, types as `.udt`, blocks as `.scl`."""
