"""Rules on what must never be written: no command writes it, nor passes through it."""

from driveblocks.maps.form import address_text, bits_text
from driveblocks.maps.model import Drive, Never
from driveblocks.maps.problem import Report
from driveblocks.meaning.words import words


def check(drive: Drive, report: Report) -> None:
    """Note every `never` that cannot hold, and every write that gives one."""
    written = {one.register for command in drive.operation.commands for one in command.writes}
    for _, row in drive.registers():
        if row.never and row.address.first not in written:
            wrong = f"no command writes {address_text(row.address.first)}"
            report.miss(row.place("never"), wrong, "remove `never`, or move it to a command register")
        for never in row.never:
            _possible(never, report)
    for command in words(drive).commands:
        for write in command.writes:
            target = drive.register_at(write.register, "w")
            for never in target.never if target else ():
                if never.bit and never.holds(write.word):
                    where = address_text(write.register)
                    wrong = (
                        f"`{command.does}` writes {write.word:04X}H to {where}, whose bits {bits_text(never.bit)} must "
                        f"never be {never.equals}: {never.why}"
                    )
                    report.add(write.at, wrong, "correct the command, or `never`")


def _possible(never: Never, report: Report) -> None:
    if not never.bit:
        report.add(never.place("bit"), f"bits {bits_text(never.bit)} run backwards", "write the lower bit first")
    elif not 0 <= never.equals < 1 << len(never.bit):
        wrong = f"{never.equals} does not fit {len(never.bit)} bit{'s' * (len(never.bit) > 1)}"
        report.add(never.place("equals"), wrong, f"write 0 to {(1 << len(never.bit)) - 1}")
