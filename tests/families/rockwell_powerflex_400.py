"""What documents say of PowerFlex 400, typed from them by hand; no map was read for it."""

COUNTS_PER_HZ = 100
PINS: set[str] = set()
BRIEF = (
    "not known",
    "P036 = 5, P038 = 5",
    "count on a motor that runs on",
    "a rising FaultReset",
    "27 codes",
    "2500 in 2001H",
)
TERMINATION = ("each end",)
KEYPAD = """
P036 | - | - | 5=rs485 | -
P038 | - | - | 5=rs485 | -
C102 | - | - | - | -
C103 | - | - | - | -
C104 | - | - | - | -
C105 | - | - | - | -
"""
