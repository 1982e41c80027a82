"""The Structured Text front end: text -> tokens -> tree with types, and the portability rules on that tree.

    unit = parse(text, path) # .parser: tree.Unit, or ParseError with everything that is wrong
    checked = check([unit])  # .checker: Checked, or CheckError with everything that is wrong
    lint([unit])             # .lint: list of Problem, never an error

`check` passes what the second edition defines, and fills every slot that `tree` documents. What only other dialects
have (pointers, methods, bit access, `S=`) parses, so that the linter can name it, and is an error of `check`.
"""
