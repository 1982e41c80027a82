"""What appendix C of the PowerFlex 4 manual says, typed by hand; its line as extracts of sisters have it."""

FAULTS = """
2 Auxiliary Input|3 Power Loss|4 Undervoltage|5 Overvoltage|6 Motor Stalled|7 Motor Overload|8 Heatsink Overtemperature|
12 HW Overcurrent (300%)|13 Ground Fault|29 Analog Input Loss|33 Auto Restart Tries|38 Phase U to Ground Short|
39 Phase V to Ground Short|40 Phase W to Ground Short|41 Phase UV Short|42 Phase UW Short|43 Phase VW Short|
63 Software Overcurrent|64 Drive Overload|70 Power Unit Fail|80 AutoTune Fail|81 Communication Loss|
100 Parameter Checksum Error|122 I/O Board Fail
"""

COMMAND = (
    "0 Stop|1 Start|2 Jog|3 Clear Faults|5,4 Direction|7,6 -|9,8 Accel Rate|11,10 Decel Rate"
    "|14,13,12 Frequency source|15 -"
)
DIRECTION = ["No direction", "Forward command", "Reverse command", "No command"]
STATUS = (
    "0 Ready|1 Active (Running)|2 Cmd Forward|3 Rotating Forward|4 Accelerating|5 Decelerating|6 Alarm|7 Faulted"
    "|8 At Reference|9 Reference by comm|10 Operation Cmd by comm|11 Parameters locked|12 Digital Input 1"
    "|13 Digital Input 2|15,14 -"
)
"""Bits of 8192 and 8448, the highest first where there are more."""

WORDS = {"run_forward": 0x12, "run_reverse": 0x22, "stop": 0x01, "fault_reset": 0x08}
TOUCHED = 0x3F
"""What the commands set of bits 0 to 5, in words made from the table."""

TENTHS = {8193, 8451}
"""A decimal 100 is 10.0 Hz: reference and feedback."""

SHOWS = """
running | 2100H.1 = 1
reverse | 2100H AND 10 = 2
ready | 2100H.0 = 1
at_speed | 2100H.8 = 1
warning | 2100H.6 = 1
fault | 2100H.7 = 1
output_frequency | 2103H
fault code | 2101H
"""

SETTINGS = {
    "P034": (34, "0.0 Hz", None), "P035": (35, "60 Hz", None), "P036": (36, None, 5), "P037": (37, "0", None),
    "P038": (38, None, 5), "P039": (39, "10.0 s", None), "P040": (40, "10.0 s", None), "A092": (92, "0", None),
    "A094": (94, "0", None), "A095": (95, "0", None), "A101": (101, "0", None), "A103": (103, "3", None),
    "A104": (104, "100", None), "A105": (105, "0", None), "A106": (106, "5.0 s", None), "A107": (107, "0", None),
}  # fmt: skip
"""Register, factory setting, and the value that the bus needs."""
BAUD = {0: 1200, 1: 2400, 2: 4800, 3: 9600, 4: 19200, 5: 38400}
FORMAT = {0: "8N1", 1: "8E1", 2: "8O1", 3: "8N2", 4: "8E2", 5: "8O2"}
SILENT = {0: "trips", 1: "coast_stop", 2: "stop", 3: "runs_on"}

ERRATA = NOTICES = ""

ABSENT = """
register 2000H | start | once
operation | stop bit | ramp
setting P036 | stop key | terminals
watchdog | frames | standstill
identity | recognised | register
own_maximum | maximum frequency | scale
trip_output | coasting | ramp
errors | refusals | form
limit read_words | registers | read
storage | kept | writes
broadcast | broadcast | obeys
"""

FORTY_FAULTS = """
2 Auxiliary Input, 3 Power Loss, 4 Undervoltage, 5 Overvoltage, 6 Motor Stalled, 7 Motor Overload, 8 Heatsink
Overtemperature, 12 HW Overcurrent (300%), 13 Ground Fault, 29 Analog Input Loss, 33 Auto Restart Tries, 38 Phase U
to Ground Short, 39 Phase V to Ground Short, 40 Phase W to Ground Short, 41 Phase UV Short, 42 Phase UW Short, 43
Phase VW Short, 63 Software Overcurrent, 64 Drive Overload, 70 Power Unit Fail, 80 AutoTune Fail, 81 Communication
Loss, 100 Parameter Checksum Error, 122 I/O Board Fail
"""
"""PowerFlex 40, 22B-UM001I, page C-6."""
FORTY_BITS = {0: "Stop", 1: "Start", 2: "Jog", 3: "Clear Faults"}
FORTY_DIRECTION = ["Forward Command", "Reverse Command"]
"""... page C-4; bits 6, 7 and 15 are outputs from FRN 4.01 on."""
FORTY_STATUS = [
    "Ready", "Active (Running)", "Cmd Forward", "Rotating Forward", "Accelerating", "Decelerating", "Alarm",
    "Faulted", "At Reference", "Reference by Comm", "Operation Cmd by Comm", "Parameters locked", "Digital Input 1",
    "Digital Input 2",
]  # fmt: skip
"""... page C-4 of an earlier edition, from bit 0 on, the names in short."""
FORTY_TENTHS = {8193: (543, "54.3"), 8451: (123, "12.3")}
"""... pages C-3 of that edition and C-6: what a decimal is in Hz."""
