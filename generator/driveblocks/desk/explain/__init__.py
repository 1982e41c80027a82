"""What a frame that somebody pasted says, or what is wrong with it and what it might be instead.

paste -> bytes -> framing -> layout -> reading -> explanation -> page or plain data; nothing here reads a file. `trace`
explains the frames of a line as they come.
"""
