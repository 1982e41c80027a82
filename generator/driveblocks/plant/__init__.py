"""A plant: all drives of a machine, their lines and groups, from one file of its user's."""
