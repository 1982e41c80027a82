"""The library in the forms that PLC programming systems import: one module per target."""

CANONICAL = "iec61131"
"""The target that all others are made from."""
TARGETS = (CANONICAL, "openplc", "plcopen", "codesys", "twincat", "siemens")
