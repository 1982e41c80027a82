"""Maps of drives that do not exist, as many and as large as a measurement wants, without a mistake in them."""

from collections.abc import Iterator

PER_GROUP = 40
"""Parameters of one group; each group has a series of its own."""
MOST_MONITORS = 60
"""Monitors of a map of 120 registers or more; half of the registers in a smaller one."""
STATUS_WORDS = 10


def synthetic(number: int, registers: int) -> str:
    """The text of a map with this many registers, at least 30; maps of different numbers differ."""
    monitors = min(MOST_MONITORS, registers // 2)
    parameters = registers - monitors - STATUS_WORDS - 3
    frames = registers // 40
    parts = (
        _head(number),
        _commands(),
        _status(),
        *_monitors(number, monitors),
        *_parameters(number, parameters),
        _operation(),
        *(_exchange(index, number) for index in range(frames)),
        "errata:\n",
        *(_erratum(index) for index in range(0, parameters, 8)),
        "absent:\n",
        *(_absence(index) for index in range(0, monitors, 3)),
    )
    return "".join(parts)


def crc16(body: bytes) -> bytes:
    """CRC-16 of MODBUS over Serial Line V1.02, 6.2.2, low byte first."""
    crc = 0xFFFF
    for byte in body:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0xA001 if crc & 1 else 0)
    return crc.to_bytes(2, "little")


def _frame(*body: int) -> str:
    data = bytes(body)
    return (data + crc16(data)).hex(" ").upper()


def _head(number: int) -> str:
    return f"""format: 1
prefix: SYN{number}
vendor: {{en: Synthetic Drives, zh: 合成电气}}
family: {{en: SYN{number} series, zh: SYN{number}系列}}
manual:
  title: {{en: Communication manual of SYN{number}, zh: SYN{number}通讯手册}}
  publisher: {{en: Synthetic Drives, zh: 合成电气}}
id_forms: [A9-99, A99-99]
serial:
  interface: {{en: RS-485 half duplex, zh: RS485 半双工}}
  mode: {{modes: [rtu], source: section 1}}
  unit: {{min: 1, max: 247, source: section 1}}
  silence: {{characters: 3.5, source: section 1}}
limits:
  read_words: {{value: 16, source: section 1}}
functions:
  - {{code: 03H, name: Read, zh: 读寄存器, source: section 1}}
  - {{code: 06H, name: Write, zh: 写寄存器, source: section 1}}
settings: []
sections:
"""


def _section(name: str, access: str, ids: str = "", base: int = 0) -> str:
    series = f"    series:\n      - {{ids: {ids}, base: {base:04X}H}}\n" if ids else ""
    title = f"{{en: Table of {name}, zh: {name}表}}"
    return f"  - id: {name}\n    title: {title}\n    source: section 2\n    access: {access}\n{series}    registers:\n"


def _commands() -> str:
    return (
        _section("commands", "rw")
        + """      - address: 0000H
        name: Run command
        zh: 运行指令
        values:
          - {value: 1, name: Run forward, zh: 正转}
          - {value: 2, name: Run reverse, zh: 反转}
          - {value: 5, name: Stop, zh: 停机}
      - {address: 0001H, name: Frequency reference, zh: 频率给定, unit: Hz, scale: {factor: 0.01, source: section 2}}
      - {address: 0002H, name: Output terminals, zh: 输出端子}
"""
    )


def _status() -> str:
    words = (
        f"      - address: {0x10 + word:04X}H\n        name: Status word {word}\n        zh: 状态{word}\n"
        "        bits:\n"
        for word in range(STATUS_WORDS)
    )
    bits = ("".join(_bit(word, bit) for bit in range(12)) for word in range(STATUS_WORDS))
    hole = "          - {bit: C-F, unused: true}\n"
    return _section("status", "r") + "".join(word + named + hole for word, named in zip(words, bits, strict=True))


def _bit(word: int, bit: int) -> str:
    name, zh = ("Running", "运行中") if word == bit == 0 else (f"Signal {word} {bit}", f"信号{bit}")
    return f"          - {{bit: {bit:X}, name: {name}, zh: {zh}}}\n"


def _monitors(number: int, count: int) -> Iterator[str]:
    yield _section("monitors", "r", f"U1-01..U1-{count}", 0x100)
    for index in range(count):
        name = "Output frequency" if index == 0 else f"Monitor {index} of {number}"
        row = f"address: {0x100 + index:04X}H, id: U1-{index + 1:02}, name: {name}, zh: 监测{index}"
        yield f"      - {{{row}, unit: V, scale: {{factor: 0.1, source: section 3}}}}\n"


def _parameters(number: int, count: int) -> Iterator[str]:
    for first in range(0, count, PER_GROUP):
        group, size = first // PER_GROUP + 1, min(PER_GROUP, count - first)
        base = 0x1000 + 0x40 * group
        yield _section(f"group_{group}", "rw", f"P{group}-01..P{group}-{size:02}", base)
        for index in range(size):
            id_ = f"P{group}-{index + 1:02}"
            printed = ", printed: {id: PO-01}" if (first + index) % 8 == 0 else ""
            row = f"address: {base + index:04X}H, id: {id_}, name: Parameter {id_} of {number}, zh: 参数{id_}"
            yield f"      - {{{row}, range: {{min: 0, max: {1000 + index}}}{printed}}}\n"


def _operation() -> str:
    return (
        """storage: {method: unexplained, source: section 4, note: the manual says nothing}
operation:
  commands:
    - {does: run_forward, register: 0000H, value: 1, source: section 2}
    - {does: run_reverse, register: 0000H, value: 2, source: section 2}
    - {does: stop, register: 0000H, value: 5, source: section 2}
  reference: {register: 0001H, means: frequency, source: section 2}
  standstill:
    all: [{register: 0010H, bit: 0, equals: 0}, {register: 0100H, equals: 0}]
    source: section 2
    why: the status and the frequency say so
  status: [{shows: running, any: [{register: 0010H, bit: 0, equals: 1}], source: section 2}]
faults:
  source: section 5
  registers: [0019H]
  present: 0019H
  codes:
"""
        + "".join(
            f"    - {{code: {code}, id: F{code:02}, name: Fault {code}, zh: 故障{code}}}\n" for code in range(1, 41)
        )
        + """errors:
  form: {kind: exception, add: 80H, source: section 6}
  source: section 6
  codes:
    - {code: 1, name: Illegal function, zh: 非法命令}
    - {code: 2, name: Illegal address, zh: 非法地址}
notices: []
frames:
"""
    )


def _exchange(index: int, number: int) -> str:
    register, value = 0x100 + index, (number * 7 + index * 13) % 6000
    request = _frame(1, 3, 1, index, 0, 1)
    reply = _frame(1, 3, 2, value >> 8, value & 0xFF)
    quantities = f"quantities: [{{register: {register:04X}H, value: {value / 10}, unit: V}}]"
    return f"""  - id: read_{index}_request
    direction: request
    mode: rtu
    source: section 7
    printed: {request}
    checksum: right
    correct: {request}
    means: {{says: reads a monitor, unit: 1, function: 03H, address: {register:04X}H, words: 1}}
  - id: read_{index}_reply
    direction: reply
    mode: rtu
    source: section 7
    printed: {reply}
    checksum: right
    correct: {reply}
    answers: read_{index}_request
    means: {{says: carries it, unit: 1, function: 03H, words: 1, byte_count: 2, values: [{value}], {quantities}}}
"""


def _erratum(index: int) -> str:
    group, place = index // PER_GROUP + 1, index % PER_GROUP
    address = 0x1000 + 0x40 * group + place
    return (
        f"  - {{about: [register {address:04X}H], where: section 3, printed: PO-01, used: P{group}-{place + 1:02}, "
        f"why: row {index} has another letter, confidence: certain, measured: false}}\n"
    )


def _absence(index: int) -> str:
    return (
        f"  - {{what: filter time of monitor {index}, about: [register {0x100 + index:04X}H], "
        "matters: a fast reading may be late, find_out: compare with a meter}\n"
    )
