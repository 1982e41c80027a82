"""MODBUS in Python, for product commands: checksums, framing, what a body says, what a reply answers.

It knows of no map. Tests compare with `reference`, which says all of this a second time and shares none of it.
"""
