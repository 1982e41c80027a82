"""What the manual of INVT's Goodrive200A says, typed from it by hand, misprints corrected; no map was read for it."""

WRITTEN = """
2000H -
2001H 0.01 Hz
2002H 0.1 %
2003H 0.1 %
2004H 0.1 %
2005H 0.01 Hz
2006H 0.01 Hz
2007H 0.1 %
2008H 0.1 %
2009H -
200AH -
200BH -
200CH 0.1 %
200DH 0.1 %
200EH 0.1 %
"""
"""R/W of 9.5.2: what one count is worth."""

READ = """
2100H -
2101H -
2102H -
2103H -
3000H 0.01 Hz
3001H 0.01 Hz
3002H 1 V
3003H 1 V
3004H 0.1 A
3005H 1 r/min
3006H 0.1 %
3007H -
3008H 0.1 %
3009H 0.1 %
300AH -
300BH -
300CH 0.01 V
300DH 0.01 V
300EH 0.01 V
300FH -
3010H 0.01 kHz
3011H -
3012H -
3013H -
3014H -
3015H -
3016H -
5000H -
"""
"""R of 9.5.2: by the digits after the point of the printed ranges (9.5.3)."""

SETTINGS = """
P00.01 0001H 0 2
P00.02 0002H 0 0
P00.03 0003H 50.00 -
P00.04 0004H 50.00 -
P00.05 0005H 0.00 -
P00.06 0006H 0 8
P00.09 0009H 0 0
P00.11 000BH depends on the model -
P00.12 000CH depends on the model -
P00.13 000DH 0 0
P01.08 0108H 0 0
P01.19 0113H 0 -
P01.21 0115H 0 0
P03.11 030BH 0 0
P07.04 0704H 0 -
P08.28 081CH 0 0
P08.47 082FH 0x000 -
P14.00 0E00H 1 -
P14.01 0E01H 4 -
P14.02 0E02H 1 -
P14.03 0E03H 5 -
P14.04 0E04H 0.0 -
P14.05 0E05H 0 -
P14.06 0E06H 0x00 0
"""
"""Function code, its address by 9.5.1, factory setting, and what it must be."""

COMMANDS = {
    "run_forward": 1, "run_reverse": 2, "jog_forward": 3, "jog_reverse": 4, "stop": 5, "coast_stop": 6,
    "fault_reset": 7, "jog_stop": 8,
}  # fmt: skip

FAULTS = (
    "1 OUt1,2 OUt2,3 OUt3,4 OC1,5 OC2,6 OC3,7 OV1,8 OV2,9 OV3,10 UV,11 OL1,12 OL2,13 SPI,14 SPO,15 OH1,16 OH2,17 EF,"
    "18 CE,19 ItE,20 tE,21 EEP,22 PIDE,23 bCE,24 END,25 OL3,26 PCE,27 UPE,28 DNE,32 ETH1,33 ETH2,36 LL"
)

FORMATS = "8N1 8E1 8O1 8N2 8E2 8O2 7N1 7E1 7O1 7N2 7E2 7O2 8N1 8E1 8O1 8N2 8E2 8O2"
"""P14.02 from 0; ASCII from 6."""

RATES = (1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200)

SHOWS = """
running | 2100H = 1, 2100H = 2
reverse | 2100H = 2
warning | 2101H.4 = 1
fault | 2100H = 4
output_frequency | 3000H
dc_bus_voltage | 3002H
output_voltage | 3003H
output_current | 3004H
output_speed | 3005H
relative_power | 3006H
fault code | 2102H
"""

ERRATA = """
serial | RTU mode | ASCII
serial | communication address of the slave | broadcast
function 10H | reading number is 16 | written
frame write_words_rtu_request | C5H 6EH | F8H 63H
frame write_words_rtu_reply | C5H 6EH | 00H 3AH
register 2100H | 0002H: forward running | reverse
register 2103H | 0x0107 | no identity
register 3007H | 65535RPM | no scale
error 4 | 04H in the example | both
error 7 | exceeds the parameter range | both
fault 24H | Undervoltage | underload
setting P00.03 | 600.00Hz | 400.00
register 5000H | Fault code | 2102H
"""

NOTICES = """
serial |  | cannot be 0
operation |  | P00.01 to communication
storage |  | EEPROM
storage |  | 8007H
"""

ABSENT = """
identity | recognised | address
watchdog | own address | CE
trip_output | coasting | ramp
register 2000H | ends a jog | 0008H
register 2000H | in fault | 01H
operation | quick stop | coast
setting P01.21 | power cycle | unplug
register 2100H | ramps down | coasts
register 3000H | coasts | standstill
serial | turn-round | time-out
pins | common | J5
silence | ASCII | pause
storage | EEPROM | writes
"""
