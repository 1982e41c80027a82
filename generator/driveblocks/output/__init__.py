"""What is written to the output folder: library, test programs, pages; and how: all of it or nothing."""
