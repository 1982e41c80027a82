"""Made-up drives of the shapes that commands have: paths of states, edges, pulses, two registers, active-low bits.

Those of tests/shapes are maps as an author has to write them. Here are some that `check` refuses, since a drive does
not ask whether a map is careful: stops that leave the run bit set, a direction that is one bit more than the other.
"""

from functools import cache

from tests.simulator.talk import made_up

from driveblocks.maps.model import Drive

STATUS = """\
  - id: monitors
    title: {en: Monitors, zh: 监测}
    source: table 3
    access: r
    registers:
      - {address: 0010H, name: Status word, zh: 状态, bits: [
          {bit: 0, name: Ready, zh: 准备}, {bit: 1, name: Switched on, zh: 接通}, {bit: 2, name: Running, zh: 运行中},
          {bit: 3, name: Fault, zh: 故障}, {bit: 6, name: Reverse, zh: 反转}]}
      - {address: 0020H, name: Output frequency, zh: 输出频率, unit: Hz, signed: true}
      - {address: 0030H, name: Present fault, zh: 当前故障}
"""
COMMANDS = """\
  - id: commands
    title: {en: Commands, zh: 指令}
    source: table 2
    access: rw
    registers:
      - {address: 0001H, name: Frequency reference, zh: 频率给定, unit: Hz}
"""
SHOWN = """\
  reference: {register: 0001H, means: frequency, source: table 2}
  standstill:
    {all: [{register: 0010H, bit: 2, equals: 0}, {register: 0020H, equals: 0}], source: table 3, why: both say so}
  measures: [{shows: output_frequency, register: 0020H, source: table 3}]
  status:
    - {shows: running, any: [{register: 0010H, bit: 2, equals: 1}], source: table 3}
    - {shows: reverse, any: [{register: 0010H, bit: 6, equals: 1}], source: table 3}
    - {shows: fault, any: [{register: 0010H, bit: 3, equals: 1}], source: table 3}
"""
CONTROL = """\
      - {address: 0000H, name: Control word, zh: 指令, bits: [
          {bit: 0, name: Switch on, zh: 接通}, {bit: 1, name: Enable voltage, zh: 电压},
          {bit: 2, name: No quick stop, zh: 急停}, {bit: 3, name: Enable operation, zh: 运行},
          {bit: 7, name: Fault reset, zh: 复位}, {bit: A, name: From bus, zh: 通讯}, {bit: B, name: Reverse, zh: 反转}]}
"""
WORDS = {
    "states": """\
  commands:
    - {does: run_forward, register: 0000H, value: 000FH, source: table 2, first: [
        {register: 0000H, value: 0006H, until: ready}, {register: 0000H, value: 0007H, until: switched_on}]}
    - {does: run_reverse, register: 0000H, value: 080FH, source: table 2, first: [
        {register: 0000H, value: 0006H, until: ready}, {register: 0000H, value: 0007H, until: switched_on}]}
    - {does: stop, register: 0000H, value: 0007H, source: table 2}
    - {does: coast_stop, register: 0000H, value: 0000H, source: table 2}
    - {does: quick_stop, register: 0000H, value: 0002H, source: table 2}
    - {does: fault_reset, register: 0000H, set: [7], source: table 2, first: [{register: 0000H, clear: [7]}]}
  states:
    - {name: ready, register: 0010H, mask: 000FH, equals: 0001H, source: table 3}
    - {name: switched_on, register: 0010H, mask: 000FH, equals: 0003H, source: table 3}
""",
    "edge": """\
  commands:
    - {does: run_forward, register: 0000H, value: 040FH, source: table 2, first: [
        {register: 0000H, value: 040EH, until: ready}]}
    - {does: run_reverse, register: 0000H, value: 0C0FH, source: table 2, first: [
        {register: 0000H, value: 040EH, until: ready}]}
    - {does: stop, register: 0000H, value: 040EH, source: table 2}
    - {does: fault_reset, register: 0000H, value: 048EH, source: table 2, first: [
        {register: 0000H, value: 040EH}]}
  states:
    - {name: ready, register: 0010H, mask: 0007H, equals: 0001H, source: table 3}
""",
    "active low": """\
  commands:
    - {does: run_forward, register: 0000H, set: [0], source: table 2}
    - {does: run_reverse, register: 0000H, set: [0, B], source: table 2}
    - {does: stop, register: 0000H, clear: [0], source: table 2}
    - {does: coast_stop, register: 0000H, clear: [1], source: table 2}
    - {does: quick_stop, register: 0000H, clear: [2], source: table 2}
""",
}
BUTTONS = """\
      - {address: 0000H, name: Buttons, zh: 指令, bits: [
          {bit: 0, name: Run forward, zh: 正转}, {bit: 1, name: Run reverse, zh: 反转}, {bit: 2, name: Stop, zh: 停止}]}
"""
PULSE = """\
  commands:
    - {does: run_forward, register: 0000H, clear: [0-2], source: table 2, first: [
        {register: 0000H, set: [0], clear: [1-2], for_ms: 100}]}
    - {does: run_reverse, register: 0000H, clear: [0-2], source: table 2, first: [
        {register: 0000H, set: [1], clear: [0, 2], for_ms: 100}]}
    - {does: stop, register: 0000H, set: [2], clear: [0-1], source: table 2}
"""
TWO = """\
      - {address: 0003H, name: Direction, zh: 方向, values: [
          {value: 0, name: Forward, zh: 正转}, {value: 1, name: Reverse, zh: 反转}]}
      - {address: 0004H, name: Start, zh: 起动, values: [
          {value: 0, name: Stop, zh: 停止}, {value: 1, name: Run, zh: 运行}]}
"""
REGISTERS = """\
  commands:
    - {does: run_forward, register: 0004H, value: 1, source: table 2, first: [{register: 0003H, value: 0}]}
    - {does: run_reverse, register: 0004H, value: 1, source: table 2, first: [{register: 0003H, value: 1}]}
    - {does: stop, register: 0004H, value: 0, source: table 2}
"""


@cache
def shape(name: str) -> Drive:
    """A made-up drive: states, edge, active low, pulse, two registers."""
    rows, operation = {"pulse": (BUTTONS, PULSE), "two registers": (TWO, REGISTERS)}.get(name) or (CONTROL, WORDS[name])
    return made_up(COMMANDS + rows + STATUS, operation + SHOWN)
