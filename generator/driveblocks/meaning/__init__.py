"""What a machine does, read off its map: commands, status, scales, settings."""
