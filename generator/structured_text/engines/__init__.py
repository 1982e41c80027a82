"""Engines that run Structured Text on this computer: the embedded one, and matiec with a C compiler."""
