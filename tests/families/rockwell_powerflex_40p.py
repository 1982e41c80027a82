"""What documents say of PowerFlex 40P, typed from them by hand; no map was read for it."""

BRIEF = (
    "pin 4, TxRxD+; - (D0, A of the standard) on pin 5, TxRxD-",
    "E249 = 0",
    "(A105 0 = Fault) the drive trips after 5.0 s of silence (A106)",
    "a rising FaultReset",
    "28 codes",
    "2500 in 2001H",
)
PLUG = "4 positive, 5 negative, I/O terminal 04 common"
TERMINATION = ("120 ohm", "each end")
KEYPAD = """
P034 | - | 0.0 Hz | 0.0 to 400.0 Hz | 0.1 Hz
P035 | - | 60 Hz | 0 to 400 Hz | 1 Hz
P036 | - | - | 5=comm | -
P037 | - | 0 | - | -
P038 | - | - | 5=comm | -
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
E207 | - | - | 0=eeprom 1=ram | -
E249 | - | - | 0=velocity 1=position | -
"""
