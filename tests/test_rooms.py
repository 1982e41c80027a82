"""The rooms of the generator, each above what it may use: nothing imports from above, and no modules go in a circle."""

import sys
from collections import Counter
from graphlib import TopologicalSorter

from tests.rooms import graph, modules, room

ROOMS = (
    "structured_text", "driveblocks", "console", "modbus", "maps", "simulator", "desk", "reference", "show",
    "explain", "render", "diff", "export", "docs", "testing", "prove", "output", "plc", "site", "stand", "commands",
    "cli", "__main__",
)  # fmt: skip
"""From the bottom up; `driveblocks` is the package's own file, `structured_text` a package of its own."""
FLOORS = ("structured_text", "visible", "files", "language", "findings", "engines", "cli", "__main__")
"""Those of `structured_text`."""

# render: compiled templates are kept from one command to the next; what templates are given has types, and the
# constants of the line have moved in from templates, in one table; each template's values are a class, so that mypy
# sees what it is given; so are the tables of the drives' pages (docs).
# output: what is tested together is a module of its own, so that `test` need not import what builds a folder.
MOST = {
    # commands: which files of `listen` are not complete
    # commands: `listen`; trust in `list`; the options of `line`, of `parameters` and of `diff`, in their help
    # maps: a register table from a spreadsheet becomes rows of a map
    # diff: what differs between two versions of a map or of the blocks
    # commission and site: theirs; docs, output: pages with what was measured on one drive, where they are built with it
    # commands: one function writes a file, or says of it why not
    # commands, desk: no option writes over a file that no such command has written; nor a trace before there is a run
    # commands, testing: a table of keys or a picture is written over no file of the user's
    "commands": 1790, "diff": 328, "desk": 1635, "docs": 1181, "explain": 2019, "export": 2055,
    # maps: `on_site`, which marks the gaps for commissioning, and its rule; trust by document, `never`, and their rules
    # maps: a watchdog that trips the drive names the fault
    # docs: a reset that waits until a tripped drive is proved to be at standstill
    # explain, show, reference: `never`; render, simulator: `differs`
    # maps: what gives the reference its meaning, for scenes, too
    # maps: a map that says only what is different from a sister's; the manual's own numbers of registers; reads as long
    # as others, which the slot says; show: a register's number in the manual; what the bus cannot do with a drive
    # a document that only the base needed goes with the fact that named it
    # maps: settings of which several values serve, that a keypad hides, or at which the drive answers nobody; what lets
    # it answer later; groups of addresses, which no request crosses. Elsewhere: the same, said and kept
    # maps: what a write stores, by twin or setting; a fault code that is part of a word; a scale that a setting chooses
    # the four tables of Modbus and values of 32 bits: which address is where, what may be what, how they are read and
    # written; simulator, reference, testing, prove, render and explain: the same, shown and tried
    # maps: fractions of a full scale, a direction by the sign of the reference, speeds in r/min, and their rules
    # simulator, reference, render, prove, testing, show, docs: the same, and more measures
    # maps, modbus, plc, site: requests by the table of their address, to end a run, commission and save parameters
    # maps: stops that are exchanged, which a reason excused; numbering and documents of limits in the JSON
    # maps: a base is read once for all that are made of it; output: a way through folders is looked at once per folder,
    # and the tests begin before the blocks do; docs: the pages read trees that were made for the targets
    # a drive that is silent in a fault reset
    # several scales of a measure, of which a register chooses one
    # codes of warnings, and what is read at an address apart from what is written there: their rules, and in every
    # room that shows or tries them
    # what is derived from a map is kept by the map, and no writer looks at all maps for each one, in output, export and
    # structured_text, too: a thousand maps are built in a time that grows with their number
    # a span as the manual numbers it, for `show`, `simulate` and `run`; diff: an address with its table, a span in one
    # the frequency is read last of what proves standstill, and the code of a fault first of what is read slowly; prove,
    # render, testing: the same
    # maps: settings of a keypad that were not read in the maker's own words are listed as such
    # maps, explain, show, reference, render: an address bit that spares the memory may belong to a section of rows, too
    # maps: how often a memory can be written may be a million
    # maps: words for a map that ends inside brackets
    # render, reference: the maximum that the full scale is compared with is refused; where parity is a pin of the line
    "maps": 8561, "output": 871,
    # desk: why a run ends and what ends it, and words of the command line that several commands share, came from plc
    # desk: why a port refuses a rate or a format is said once, for what only listens, too
    # desk: a name is looked up once; plc: the last stop waits for a port that is being opened again
    # modbus: the longest good frame of several that bytes may begin with
    # the framing of what came over a wire, which `explain` and `stand` read alike, came from explain
    # a program after its first scan, and a request with its reply, are modules of their own: `site` has them, too
    # prove: who commands a drive is what its status says
    # modbus: what sets a coil and how coils are packed, which five modules said; prove, render, simulator: less by it
    # simulator: the state after power-up, where a map names it
    # render: what several commands wait for alike is asked once; structured_text: long lines are broken where they are
    # written, not in three templates
    # reference: names and numbers that cases have in common are found once; render: its strict environment of
    # templates is that of test programs, too
    # what the writes of a command wait for is said by the block that writes them
    # sums of REALs have names, which takes half of the time from a proof; all families are one library, made once
    # render: parts of the line that are functions have names; a busy drive has a result of its own; what to do about a
    # reason says that a mode bars a reset, and that a refused start has to be given again; two ranks
    "modbus": 531, "plc": 2528, "prove": 1958, "reference": 1137, "render": 2963, "simulator": 1504, "stand": 517,
    # what a person needs before and at commissioning; `line`, from the drives to the picture; `parameters`
    # `commission` and `site`: the search and the steps, what is kept and read again, the page and the report
    # `listen`: frames from bytes, who asks whom, rate and format, a table per unit, a log
    # a file that its user edits is kept with every comment; what was found before is not replaced unasked
    # ... echoes, late and doubled replies and the first moments of a line, as a thousand random lines showed them
    # site: what neither side has given is not equal; nor is what the map does not list any more passed over;
    # what is replaced is copied; files of which a full disk takes the end alone; what was read before is read again
    # structured_text: a paragraph without hyphens is broken like any other line
    # structured_text: where decisions stand is noted in place, not copied for each statement
    # a file is put into place by one function, which names it where the disk is full,
    # writes where a link leads and keeps its mode; what a person types into site.yaml has types
    # parameters that a spreadsheet has saved are read, and their notes kept
    "site": 3781, "show": 1121, "structured_text": 16081,
    # a meter beside a motor has scenes of its own; a read and a store that are not answered, a reference refused;
    # the blocks that others are made of are called by themselves, by a table, and those of a family by its map
    # processes that compile and run a share of the programs each
    # whether the settings that give the reference its meaning are read late differs from drive to drive
    # how many reads take turns differs, too
    # registers and words of a simulated drive are looked up once, elements that take any byte are not checked one by
    # one: a scan costs less (maps, modbus, simulator, structured_text, testing)
    # what a line knows and counts, with a start of several writes
    # bodies of programs that drives have in common are printed once; another process makes what a build needs of them
    # what a line knows and counts, with a start of several writes, and what each of them waits for
    # a program is printed without its head, which alone differs from drive to drive; another process makes some
    "testing": 8518,
}  # fmt: skip
"""Lines of each room at most. Lower it without a word; who raises it says why, in a line above it."""


def test_no_room_outgrows_its_ceiling() -> None:
    lines = Counter[str]()
    for name, path in modules().items():
        lines[room(name)] += len(path.read_text("utf-8").splitlines())
    assert {each: count for each, count in lines.items() if count > MOST.get(each, 200)} == {}


def test_nothing_imports_from_a_room_above() -> None:
    assert {room(name) for name in graph()} == set(ROOMS)
    upwards = [
        f"{name} -> {other}"
        for name, others in graph().items()
        for other in others
        if other in graph() and ROOMS.index(room(other)) > ROOMS.index(room(name))
    ]
    assert not upwards


def test_simulated_drives_need_nothing_that_explains_frames_or_runs_programs() -> None:
    stand = {other for name, others in graph().items() if room(name) == "stand" for other in others}
    assert not [name for name in stand if name in graph() and room(name) == "explain"]
    # a word such as chf@1:60:CurrentScale=0.1 means the same to `simulate` as to `run --simulate`
    assert {name for name in stand if name in graph() and room(name) == "plc"} == {"driveblocks.plc.drives"}


def test_no_modules_go_in_a_circle() -> None:
    assert graph().keys() <= set(TopologicalSorter(graph()).static_order())


def test_the_toolchain_knows_no_drive() -> None:
    own = {name: others for name, others in graph().items() if room(name) == "structured_text"}
    foreign = {
        other.partition(".")[0]
        for others in own.values()
        for other in others
        if other.partition(".")[0] not in sys.stdlib_module_names
    }
    assert foreign == {"structured_text"}
    floors = {name: FLOORS.index([*name.split("."), "structured_text"][1]) for name in own}
    upwards = [f"{name} -> {other}" for name in own for other in own[name] if floors.get(other, 0) > floors[name]]
    assert not upwards
