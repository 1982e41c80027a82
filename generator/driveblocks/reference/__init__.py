"""The reference model: what each generated block must answer, stated a second time and in another way.

It is made from a loaded map and the standard library alone, so that a mistake in what plans, renders or prints the
blocks is not repeated here. Results carry the names that the blocks' result codes have, such as QUANTITY.
"""
