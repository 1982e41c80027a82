"""Scenes: a drive block on its line with a simulated drive, all in Structured Text, as a user wires them."""
