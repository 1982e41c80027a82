"""What goes into the output folder: library, test programs, pages; and how it gets there, all of it or nothing."""
