"""What documents say of PowerFlex 4 and 40, typed from them by hand; no map was read for it."""

STATUS = 0x2100
FACES = {"stands": 0x0401, "ramps": 0x040B, "runs": 0x050B, "reverse": 0x0503, "fault": 0x0480, "warning": 0x0441}
"""Bit 0 ready, 1 active, 3 rotating forward, 6 alarm, 7 faulted, 8 at reference, A commanded by comm."""
FREQUENCY = 0x2103
COUNTS_PER_HZ = 10
FAULT = (0x2101, 18)
CODES = (1, 2, 3, 3, 2, None, None)
"""Its manual has none: those of the standard."""
PASSING = (3, 1, 1)
PINS = {"ManualChecked"}
BRIEF = (
    "pin 4, TxRxD+; - (D0, A of the standard) on pin 5, TxRxD-",
    "P036 = 5, P038 = 5",
    "(A105 0 = Fault) the drive trips after 5.0 s of silence (A106)",
    "a rising FaultReset",
    "24 codes",
    "250 in 2001H",
)
ALIKE = {("fault_reset", "Clear faults"), ("stop", "Stop")}
PLUG = "4 positive, 5 negative, I/O terminal 04 common"
"""Starkest's library, PowerFlex 4/40/4M: pins 4 and 5, TxRxD+, TxRxD-; common at I/O terminal 04."""
TERMINATION = ("120 ohm", "each end")
KEYPAD = """
P034 | - | 0.0 Hz | 0.0 to 400.0 Hz | 0.1 Hz
P035 | - | 60 Hz | 0 to 400 Hz | 1 Hz
P036 | - | - | 5=rs485 | -
P037 | - | 0 | - | -
P038 | - | - | 5=rs485 | -
P039 | - | 10.0 s | - | 0.1 s
P040 | - | 10.0 s | - | 0.1 s
A092 | - | 0 | - | -
A094 | - | 0 | - | -
A095 | - | 0 | - | -
A101 | - | 0 | - | -
A103 | - | 3 | 0=1200 1=2400 2=4800 3=9600 4=19200 5=38400 | -
A104 | - | 100 | 1 to 247 | -
A105 | - | 0 | 0=fault 1=coast 2=stop 3=continue | -
A106 | - | 5.0 s | 0.1 to 60.0 s | 0.1 s
A107 | - | 0 | 0=8-n-1 1=8-e-1 2=8-o-1 3=8-n-2 4=8-e-2 5=8-o-2 | -
"""
"""PowerFlex 4, lists of the PowerFlex 40 after 22B-UM001J, pages 53 and 76; factory settings of a backup program."""
