"""A page per drive block with its pictures, made from the typed tree of the block and from the map."""
