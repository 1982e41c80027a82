"""The bench: a drive made from its map, and Structured Text programs that try the blocks at it.

What programs expect comes from the map's vectors and from the reference model, never from what renders the blocks.
`simulator` is the drive, `scenes` are what a motor goes through, the rest are single blocks and the runner.
"""
