"""What documents say of PowerFlex 4M, typed from them by hand; no map was read for it."""

BRIEF = (
    "pin 4, TxRxD+; - (D0, A of the standard) on pin 5, TxRxD-",
    "P108 = 5",
    "C304",
    "a rising FaultReset",
    "24 codes",
    "250 in 2001H",
)
PLUG = "4 positive, 5 negative, I/O terminal 04 common"
TERMINATION = ("120 ohm", "each end")
KEYPAD = """
P108 | - | - | 5=rs485 | -
C302 | - | - | 0=1200 1=2400 2=4800 3=9600 4=19200 5=38400 | -
C303 | - | - | 1 to 127 | -
C304 | - | - | 0=fault 1=coast 2=stop 3=continue | -
C305 | - | - | - | s
C306 | - | - | 0=8-n-1 1=8-e-1 2=8-o-1 3=8-n-2 4=8-e-2 5=8-o-2 | -
"""
"""SINAMICS V20, 07/2012, page 111, and 10/2019, page 179; what a plant and a program say of 09/2014."""
