"""A drive made from its map: states, ramps, faults, refusals, memory and replies, without a clock and without chance.

What a manual does not say is a `Habits` of the drive, with a stated default. Tables of numbers are between map and
drive, so that the same drive can be had in C.
"""
