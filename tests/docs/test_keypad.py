"""What the keypad shows, against tables typed from the documents: code, menu, as delivered, what it takes, a count.

A value may carry a word of what the document says of it: `4=19200`. `-` stands for what the document does not print.
Seven drives have 15 settings or more. Fewer have the documents of JSCC (6, all of its chapter), PowerFlex 4M and 400
(6 each: no page of their chapter 3 could be read) and CHF (1: its chapter is on communication alone). Of the MX2, b001
to F003 stand in a list of names and addresses alone; of the SN300G5, b1-03 to C1-02 in its table of addresses alone.
"""

import pytest
from tests import shipped

from driveblocks.meaning.setting import Setting, settings

GD200A = """
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
P14.02 | - | 1 | 0=8n1,_rtu 1=8e1,_rtu 2=8o1,_rtu 3=8n2,_rtu 4=8e2,_rtu 5=8o2,_rtu 6=7n1,_a 7=7e1,_a 8=7o1,_a 9=7n2,_a\
 10=7e2,_a 11=7o2,_a 12=8n1,_a 13=8e1,_a 14=8o1,_a 15=8n2,_a 16=8e2,_a 17=8o2,_a | -
P14.03 | - | 5 ms | 0 to 200 ms | 1 ms
P14.04 | - | 0.0 s | 0.0 to 60.0 s | 0.1 s
P14.05 | - | 0 | 0=coast 1=run 2=stop 3=any | -
P14.06 | - | 0x00 | - | -
"""
"""Goodrive200A, V2.4, pages 34 to 45, 49, 50, 69, 76, 79 and 92 to 94."""
PF525 = """
P041 | - | 10.00 s | 0.00 to 600.00 s | 0.01 s
P042 | - | 10.00 s | 0.00 to 600.00 s | 0.01 s
P043 | - | 0.00 Hz | 0.00 to 500.00 Hz | 0.01 Hz
P044 | - | 60.00 Hz | 0.00 to 500.00 Hz | 0.01 Hz
P045 | - | 0 | 0=ramp,_cf 1=coast,_cf 2=dc_brake,_cf 3=auto,_cf 4=ramp 5=coast 6=dc_brake 7=auto 8=em_brake,_cf\
 9=em_brake 10=point_stop,_cf 11=point_stop | -
P046 | - | 1 | 1=keypad 2=digital 3=serial/dsi 4=network 5=ethernet/ip | -
P047 | - | 1 | 1=potentiometer 2=keypad 3=serial/dsi 4=network 5=10_v 6=20_ma 7=preset 8=multiply 9=mop 10=pulse\
 11=pid1 12=pid2 13=step_logic 14=encoder 15=ethernet/ip 16=positioning | -
A541 | - | 0 | - | -
A543 | - | 0 | - | -
A544 | - | 0 | - | -
C121 | - | 0 | 0=save 1=ram | -
C122 | - | 0 | 0=velocity 1=position | -
C123 | - | 3 | 0=1200 1=2400 2=4800 3=9600 4=19200 5=38400 | -
C124 | - | 100 | 1 to 247 | -
C125 | - | 0 | 0=fault 1=coast 2=stop 3=continue | -
C126 | - | 5.0 s | 0.1 to 60.0 s | 0.1 s
C127 | - | 0 | 0=8-n-1 1=8-e-1 2=8-o-1 3=8-n-2 4=8-e-2 5=8-o-2 | -
"""
"""PowerFlex 525, lists after 520-UM001O, pages 65, 66, 102 and 103, and 520-UM001L; and a backup program."""
PF4 = """
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
PF40P = (
    PF4.replace("5=rs485", "5=comm") + "E207 | - | - | 0=eeprom 1=ram | -\nE249 | - | - | 0=velocity 1=position | -\n"
)
ATV312 = """
LAC | CtL- | L1 | L1 L2 L3 | -
Fr1 | CtL- | AI1 | AI1 AI2 AI3 AIV1 UPdt=inputs UPdH=dial LCC=remote Mdb=modbus 167=canopen | -
CHCF | CtL- | SIM | SIM=combined SEP=separate | -
rFC | CtL- | Fr1 | Fr1 | -
Stt | - | 0 | 0=ramp 1=fast 2=freewheel 3=dc | -
PST | - | 1 | 0=inactive 1=priority | -
Add | - | 1 | 1 to 247 | -
tbr | - | 19.2 | 4.8=4800 9.6=9600 19.2=19200 | -
tFO | - | 8E1 | 8O1 8E1 8N1 8N2 | -
ttO | - | 10.0 s | 0.1 to 30.0 s | 0.1 s
SLL | - | 1 | 0=ignored 1=freewheel 6=ramp 7=fast | -
FLO | - | nO | - | -
Cd1 | CtL- | tEr | - | -
tCC | I-O- | 2C | - | -
Atr | FLt- | nO | - | -
FCS | drC- | nO | - | -
bFr | drC- | 50 Hz | - | Hz
ACC | SEt- | 3 s | - | s
dEC | SEt- | 3 s | - | s
LSP | SEt- | 0.0 Hz | - | 0.1 Hz
HSP | SEt- | bFr | - | 0.1 Hz
"""
"""Altivar 312, a list after BBV46387; numbers of BBV51701, pages 27, 35 to 40, 53 and 55; tbr and ttO of the ATV12."""
SN300G5 = """
b1-01 | - | 1 | 0=keypad 1=terminals 2=communication 3=reserved | -
b1-02 | - | 1 | 0=keypad 1=terminals 2=communication 3=reserved | -
b1-03 | - | - | - | -
O2-01 | - | - | - | -
b1-04 | - | - | - | -
L5-01 | - | - | - | -
E1-04 | - | - | - | Hz
D2-02 | - | - | - | -
C1-01 | - | - | - | s
C1-02 | - | - | - | s
H5-01 | - | 1F | 0 to 20 | -
H5-02 | - | 3 | 0=1200 1=2400 2=4800 3=9600 | -
H5-03 | - | 1 | 0=no 1=even 2=odd | -
H5-04 | - | 1 | 0=deceleration 1=emergency 2=coast 3=continue | -
H5-05 | - | 1 | 0=disabled 1=enabled | -
"""
"""SN300G5, table of communication parameters, and section (V)."""
MX2 = """
A001 | - | - | - | -
A002 | - | - | 03=modbus | -
C071 | - | 05 | 03=2400 04=4800 05=9600 06=19200 07=38400 08=57600 09=76800 10=115200 | -
C072 | - | 1 | 1 to 247 | -
C074 | - | 00 | 00=no 01=even 02=odd | -
C075 | - | - | 01=1 02=2 | -
C076 | - | - | 00=trip 01=trip 02=ignore 03=free-run 04=decelerate | -
C077 | - | - | 0.00 to 99.99 s | 0.01 s
C078 | - | - | 0 to 1000 ms | 1 ms
C102 | - | 00 | 00=signal 03=trip | -
b001 | - | - | 00=no | -
b031 | - | - | - | -
b035 | - | - | - | -
b037 | - | - | - | -
b091 | - | - | - | -
A004 | - | - | - | Hz
A061 | - | - | - | Hz
A062 | - | - | - | Hz
F002 | - | - | - | s
F003 | - | - | - | s
"""
"""MX2: its own pages 5-100, 6-1, 6-31; WJ-C1, page 11-1-1; SJ700, pages 4-113, 4-129, B-52; names of pymx2."""
BASIC, COMM = "F0, basic settings", "FA, communication settings"
JSCC = f"""
F0.04 | {BASIC} | 1 | 1=terminals 2=terminals 3=keypad 4=rs-485 | -
F0.08 | {BASIC} | 1 | 1=keypad 2=ad1 3=ad2 4=combination 5=m1 6=plc 7=pid 8=rs-485 | -
FA.00 | {COMM} | 1 | 1 to 247 | -
FA.01 | {COMM} | 3 | 1=4800 2=9600 3=19200 4=38400 5=57600 | -
FA.02 | {COMM} | 2 | 1=no_parity,_1 2=even_parity,_1 3=odd_parity,_1 4=no_parity,_2 5=even_parity,_2 6=odd_parity,_2 | -
FA.03 | {COMM} | 2 | 1=ascii 2=rtu | -
"""
"""JSCC, section 2."""
PF4M = """
P108 | - | - | 5=rs485 | -
C302 | - | - | 0=1200 1=2400 2=4800 3=9600 4=19200 5=38400 | -
C303 | - | - | 1 to 127 | -
C304 | - | - | 0=fault 1=coast 2=stop 3=continue | -
C305 | - | - | - | s
C306 | - | - | 0=8-n-1 1=8-e-1 2=8-o-1 3=8-n-2 4=8-e-2 5=8-o-2 | -
"""
PF400 = """
P036 | - | - | 5=rs485 | -
P038 | - | - | 5=rs485 | -
C102 | - | - | - | -
C103 | - | - | - | -
C104 | - | - | - | -
C105 | - | - | - | -
"""
CHF = "P0.04 | - | - | - | -"
V20 = """
P0010 | - | 0 | - | -
P0970 | - | - | 1=user 21=factory | -
P0003 | - | 1 | - | -
P0700 | - | 1 | 1=panel 2=terminals 5=rs485 | -
P1000 | - | 1 | 1=potentiometer 5=rs485 | -
P2000 | - | - | - | 0.01 Hz
P2010 | - | 8 (07/2012) or 6 (09/2014) | 6=9600 7=19200 8=38400 12=115200 | -
P2014 | - | 0 (07/2012) or 2000 (09/2014) | - | 1 ms
P2021 | - | 1 | 1 to 247 | -
P2022 | - | 1000 | 0 to 10000 | -
P2023 | - | 1 | 1=uss 2=modbus | -
P2034 | - | 2 | 0=none 1=odd 2=even | -
P2035 | - | 1 | 1=one 2=two | -
P1080 | - | 0.00 | - | Hz
P1082 | - | 50.00 | - | Hz
P1120 | - | 10.00 s | - | 0.01 s
P1121 | - | 10.00 s | - | 0.01 s
"""
"""SINAMICS V20, 07/2012, page 111, and 10/2019, page 179; what a plant and a program say of 09/2014."""
ACS355 = """
9802 | - | - | 1=standard | -
5302 | - | 1 | 0 to 247 | -
5303 | - | 9.6 kbit/s | - | -
5304 | - | - | 0=8n1 1=8n2 2=8e1 3=8o1 | -
5305 | - | 0 | 0=lim 1=dcu 2=full | -
1001 | - | - | 10=comm | -
1003 | - | - | 3=request | -
1102 | - | - | 8=comm | -
1103 | - | - | 8=comm | -
1105 | - | - | - | -
1604 | - | - | - | -
3018 | - | - | - | -
3019 | - | - | - | -
"""
"""ACS550-01, page 151; OM 1191, page 49; ACH550-UH, page 148."""
TYPED = {
    "GD200A": GD200A, "PF525": PF525, "PF4": PF4, "PF40P": PF40P, "ATV312": ATV312, "SN300G5": SN300G5, "MX2": MX2,
    "JSCC": JSCC, "PF4M": PF4M, "PF400": PF400, "CHF": CHF, "V20": V20, "ACS355": ACS355,
}  # fmt: skip


def shown(one: Setting) -> list[str]:
    """Code, menu, as delivered, and a count, as the keypad of the map shows them."""
    number, count = one.factory, one.keypad.factor
    delivered = one.default if number is None else one.keypad.shown(number)
    in_unit = f"{count if count is not None else ''} {one.keypad.unit}".strip()
    return [each or "-" for each in (one.keypad.code, one.keypad.menu, delivered, in_unit)]


@pytest.mark.parametrize("prefix", TYPED)
def test_each_setting_is_as_its_keypad_shows_it(prefix: str) -> None:
    typed = [each.split(" | ") for each in TYPED[prefix].strip().splitlines()]
    held = settings(shipped.drives()[prefix])
    assert sorted(map(shown, held)) == sorted([*each[:3], each[4]] for each in typed)
    takes = {each[0]: each[3] for each in typed}
    for one in held:
        wanted = takes[one.keypad.code]
        if not one.values:
            assert (one.allowed or "-") == wanted, one.id
            continue
        values = [each.split("=") for each in wanted.split(" ")]
        assert [one.keypad.shown(number) for number, _ in one.values] == [text for text, *_ in values], one.id
        for (_, name), (text, *said) in zip(one.values, values, strict=True):
            assert all(word.replace("_", " ") in name.lower() for word in said), (one.id, text)


def test_every_drive_is_typed() -> None:
    assert TYPED.keys() == shipped.drives().keys()
    assert sum(len(each.strip().splitlines()) >= 15 for each in TYPED.values()) >= 7
