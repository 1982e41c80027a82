"""What differs between two versions of a map, or of the library, and what of it a PLC project notices."""
