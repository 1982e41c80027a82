"""Proof of the safety rules: typed trees as terms of a solver, rules that an engineer can read, counterexamples."""
