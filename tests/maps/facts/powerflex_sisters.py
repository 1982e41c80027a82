"""What is different in the sisters of the PowerFlex 4, typed from other editions or documents than their maps.

525: editions A (pages 175 and 177) and G (191 and 194) of 520-UM001, and the fault names of edition O as others took
them from its pages 161 to 163. 40P and 4M: page 215 of 2080-UM002L and pages C-1 and C-2 of 22COMM-UM005E; faults of a
second copy of their own page, C-7 and C-6. 400: pages 171 and 172 of edition J of 22C-UM001, and page E-5 of edition I.
"""

from dataclasses import dataclass

from tests.maps.facts import powerflex_4

MORE = {
    "40P": "48 Parameters Defaulted|71 Network Loss|94 Encoder Loss|111 Hardware Enable",
    "4M": "",
    "400": "15 Load Loss|48 Params Defaulted|71 Net Loss|94 Function Loss",
    "525": """
9 Control Module Overtemperature|15 Load Loss|21 Output Phase Loss|48 Params Defaulted|59 Safety Open|71 DSI Net Loss|
72 Option Card Net Loss|73 Embedded EtherNet/IP Adapter Net Loss|81 DSI Comm Loss|82 Option Card Comm Loss|
83 Embedded EtherNet/IP Adapter Comm Loss|91 Encoder Loss|94 Function Loss|101 External Storage|
105 Control Module Connect Error|106 Incompatible Control-Power Module|107 Unrecognized Control-Power Module|
109 Mismatched Control-Power Module|110 Keypad Membrane|111 Safety Hardware|114 Microprocessor Failure|
125 Flash Update Required|126 Non Recoverable Error|127 DSI Flash Update Required
""",
}
"""Faults beside those of the PowerFlex 4, or instead of them."""
ABSENT = "".join(each for each in powerflex_4.ABSENT.splitlines(True) if not each.startswith(("setting", "watchdog")))
"""... but for what its parameters are called."""


@dataclass(frozen=True)
class Sister:
    """A sister: what is another word, bit, scale or setting; the rest is that of the PowerFlex 4."""

    faults: str
    hundredths: frozenset[int]
    """Registers where a decimal 100 is 1.00 Hz; those of the PowerFlex 4 have tenths."""
    settings: dict[str, tuple[int, int | None]]
    """Register, and the value that the bus needs."""
    lacks: frozenset[int] = frozenset()
    """Faults of the PowerFlex 4 that it has not."""
    never: frozenset[tuple[tuple[int, ...], int]] = frozenset({((4, 5), 3)})
    touched: int = powerflex_4.TOUCHED
    """What the commands set or clear of 8192."""
    command: str = "6 -|7 -|15 -"
    """Bits of 8192 that differ by model."""
    status: str = "6 Alarm|14 -|15 -"
    SHOWS: str = powerflex_4.SHOWS
    ERRATA: str = ""
    ABSENT: str = ABSENT
    NOTICES: str = ""


WITH_SIX = frozenset({((4, 5), 3), ((6,), 1)})
"""Bit 6 gives the drive to its keypad, or to terminals: no command sets it, and each clears it."""

PF40P = Sister(
    faults=MORE["40P"],
    hundredths=frozenset({8193}),
    settings={
        "P034": (34, None), "P035": (35, None), "P036": (36, 5), "P037": (37, None), "P038": (38, 5),
        "P039": (39, None), "P040": (40, None), "A092": (92, None), "A094": (94, None), "A095": (95, None),
        "A101": (101, None), "A103": (103, None), "A104": (104, None), "A105": (105, None), "A106": (106, None),
        "A107": (107, None), "E207": (207, None), "E249": (249, 0),
    },
    command="6 Logic In 1|7 Logic In 2|15 -",
    ERRATA="\nregister 2103H | 123 is 12.3 Hz | 12.3 Hz\n",
)  # fmt: skip
PF4M = Sister(
    faults=MORE["4M"],
    hundredths=frozenset(),
    settings={
        "P108": (108, 5), "C302": (302, None), "C303": (303, None), "C304": (304, None), "C305": (305, None),
        "C306": (306, None),
    },
    command="6 C-form relay|7 MOP Increment|15 MOP Decrement",
)  # fmt: skip
PF400 = Sister(
    faults=MORE["400"],
    hundredths=frozenset({8193, 8451}),
    settings={
        "P036": (36, 5), "P038": (38, 5), "C102": (102, None), "C103": (103, None), "C104": (104, None),
        "C105": (105, None),
    },
    lacks=frozenset({80}),
    command="6 Local Control|7 MOP Increment|15 MOP Decrement",
    status="6 Alarm|14 Digital Input 3|15 Digital Input 4",
    never=WITH_SIX,
    touched=0x7F,
)  # fmt: skip
PF525 = Sister(
    faults=MORE["525"],
    hundredths=frozenset({8193, 8450, 8451}),
    settings={
        "P041": (41, None), "P042": (42, None), "P043": (43, None), "P044": (44, None), "P045": (45, None),
        "P046": (46, 3), "P047": (47, 3), "A541": (541, None), "A543": (543, None), "A544": (544, None), "C121": (121, None), "C122": (122, 0), "C123": (123, None),
        "C124": (124, None), "C125": (125, None), "C126": (126, None), "C127": (127, None),
    },
    lacks=frozenset({81}),
    command="6 Force Keypad Control|7 MOP Increment|15 MOP Decrement",
    status="6 -|14 Digital Input 3|15 Digital Input 4",
    SHOWS=powerflex_4.SHOWS.replace("warning | 2100H.6 = 1\n", "").replace(
        "fault code", "output_current | 2104H\ndc_bus_voltage | 2105H\noutput_voltage | 2106H\nfault code"
    ),
    never=WITH_SIX,
    touched=0x7F,
)  # fmt: skip
SISTERS = {"PF40P": PF40P, "PF4M": PF4M, "PF400": PF400, "PF525": PF525}
