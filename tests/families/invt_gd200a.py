"""What documents say of Goodrive200A, typed from them by hand; no map was read for it."""

STATUS = 0x2100
FACES = {"stands": 0x0003, "ramps": 0x0001, "runs": 0x0001, "reverse": 0x0002, "fault": 0x0004, "warning": 0x0003}
"""1 forward, 2 reverse, 3 stopped, 4 fault."""
FREQUENCY = 0x3000
COUNTS_PER_HZ = 100
FAULT = (0x2102, 18)
CODES = (1, 2, 4, 4, 2, 8, None)
PASSING = (3, 4, 3)
CONTROL = "transcribed"
PINS = {"ManualChecked"}
BRIEF = (
    "485+, A (+)",
    "P00.01 = 2",
    "(P14.04 0.0 s) the motor runs on",
    "a rising FaultReset",
    "31 codes",
    "2500 in 2001H",
)
ALIKE = {
    ("coast_stop", "Coast to stop"),
    ("fault_reset", "Fault reset"),
    ("jog_forward", "Jog forward"),
    ("jog_reverse", "Jog reverse"),
    ("jog_stop", "Jog stop"),
    ("run_forward", "Run forward"),
    ("run_reverse", "Run reverse"),
    ("stop", "Stop"),
}
PLUG = "485+ positive, 485- negative"
"""Goodrive200A, 9.3.1: A (+) and B (-), "485+ on the terminal board corresponds to A and 485- to B"."""
TERMINATION = ("120 ohm",)
HELD = {"read_rtu_request": {4: 5000}, "read_ascii_request": {4: 5000}}
KEYPAD = """
P00.01 | - | 0 | 0=keypad 1=terminals 2=communication | -
P00.02 | - | 0 | 0=modbus | -
P00.03 | - | 50.00 Hz | - | 0.01 Hz
P00.04 | - | 50.00 Hz | - | 0.01 Hz
P00.05 | - | 0.00 Hz | - | 0.01 Hz
P00.06 | - | 0 | 0=keypad 1=ai1 2=ai2 3=ai3 4=hdi 5=plc 6=multi-step 7=pid 8=modbus | -
P00.09 | - | 0 | 0=a 1=b 2=+ 3=- 4=larger 5=smaller | -
P00.11 | - | depends on the model | 0.0 to 3600.0 s | 0.1 s
P00.12 | - | depends on the model | 0.0 to 3600.0 s | 0.1 s
P00.13 | - | 0 | 0 1=opposite 2=reverse | -
P01.08 | - | 0 | 0=decelerate 1=coast | -
P01.19 | - | 0 | 0=lower 1=stop 2=hibernate 3=sleep | -
P01.21 | - | 0 | 0=disable 1=enable | -
P03.11 | - | 0 | 0=off 1=keypad 2=ai1 3=ai2 4=ai3 5=hdi 6=multi-step 7=modbus | -
P07.04 | - | 0 | 0=keypad 1=terminal 2=communication 3=always | -
P08.28 | - | 0 | 0 to 10 | -
P08.47 | - | 0x000 | - | -
P14.00 | - | 1 | 1 to 247 | -
P14.01 | - | 4 | 0=1200 1=2400 2=4800 3=9600 4=19200 5=38400 6=57600 7=115200 | -
P14.02 | - | 1 | 0=8n1,_rtu 1=8e1,_rtu 2=8o1,_rtu 3=8n2,_rtu 4=8e2,_rtu 5=8o2,_rtu 6=7n1,_a 7=7e1,_a 8=7o1,_a\
 9=7n2,_a 10=7e2,_a 11=7o2,_a 12=8n1,_a 13=8e1,_a 14=8o1,_a 15=8n2,_a 16=8e2,_a 17=8o2,_a | -
P14.03 | - | 5 ms | 0 to 200 ms | 1 ms
P14.04 | - | 0.0 s | 0.0 to 60.0 s | 0.1 s
P14.05 | - | 0 | 0=coast 1=run 2=stop 3=any | -
P14.06 | - | 0x00 | - | -
"""
"""Goodrive200A, V2.4, pages 34 to 45, 49, 50, 69, 76, 79 and 92 to 94."""
PRINTED_WRONG = {"write_words_rtu_request": "CHECKSUM", "write_words_rtu_reply": "CHECKSUM"}
