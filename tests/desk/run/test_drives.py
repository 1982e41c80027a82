"""Drives that are to be simulated are set by their user: what the program believes of them changes nothing."""

import json

import pytest
from tests.desk.run.desk import EXAMPLE, ONE, Desk, loaded, maps, wired
from tests.simulator.talk import MAPS

from driveblocks.desk.run import drives as called
from driveblocks.desk.run import simulated
from driveblocks.desk.run.controller import Controller
from driveblocks.desk.run.drives import Named
from driveblocks.maps import catalog
from driveblocks.maps.problem import Refused

FILES = {each.path.stem: (each.path, each.drive) for each in maps()}


def named(*words: str, option: str = "") -> list[Named]:
    """The drives of some words."""
    return called.named(called.words(words), lambda name: FILES[catalog.resolve(name).stem], option)


def turning(text: str, word: str) -> Desk:
    """A program at one drive, after its start."""
    (one,) = named(word)
    return Desk(text, [one.made(ascii_mode=False)]).started(8000)


def asking(family: str, hertz: float, **settings: float) -> str:
    """The program with another drive, a reference, and what its author believes of the drive."""
    text = ONE.replace("JSCC", family).replace("Hz : REAL := 20.0", f"Hz : REAL := {hertz}")
    text = text.replace("FullScaleHz := 50.0", f"FullScaleHz := {settings.pop('FullScaleHz', 50.0)}")
    members = ", ".join(f"{name} := {value}" for name, value in settings.items())
    return text.replace("ReferenceScale := 100.0, FrequencyScale := 0.01", members or "StaleMs := 0")


@pytest.mark.parametrize(
    ("full_scale", "word", "hertz", "at_speed"),
    [
        (50.0, "chf@7", 30.0, True),
        (40.0, "chf@7", 37.5, False),
        (40.0, "chf@7:40", 30.0, True),
        (50.0, "chf@7:60", 36.0, False),
    ],
)
def test_a_wrong_full_scale_turns_the_motor_at_a_wrong_speed_and_it_shows(
    full_scale: float, word: str, hertz: float, at_speed: bool
) -> None:
    desk = turning(asking("CHF", 30.0, FullScaleHz=full_scale, FrequencyScale=0.01), word)
    assert desk.drives[0].hertz == pytest.approx(hertz)
    assert desk.instance["Motor.OutputFrequencyHz"] == pytest.approx(hertz)
    assert (desk.instance["Motor.Running"], desk.instance["Motor.AtSpeed"]) == (True, at_speed)


@pytest.mark.parametrize(
    ("counts", "word", "hertz"),
    [
        (100.0, "jscc@7", 20.0),
        (50.0, "jscc@7:ReferenceScale=50", 20.0),
        (100.0, "jscc@7:60:ReferenceScale=50", 40.0),
    ],
)
def test_a_wrong_scale_of_the_reference_shows(counts: float, word: str, hertz: float) -> None:
    desk = turning(asking("JSCC", 20.0, ReferenceScale=counts), word)
    assert desk.drives[0].hertz == pytest.approx(hertz)
    assert desk.instance["Motor.OutputFrequencyHz"] == pytest.approx(hertz)


@pytest.mark.parametrize(
    ("word", "hertz", "volts"),
    [
        ("chf@7", 20.0, 540.0),
        ("chf@7:FrequencyScale=0.02:DcVoltageScale=0.1", 10.0, 54.0),
    ],
)
def test_a_wrong_scale_of_a_measure_shows(word: str, hertz: float, volts: float) -> None:
    """The motor turns right: the reference is a percentage."""
    desk = turning(asking("CHF", 20.0, FrequencyScale=0.01, DcVoltageScale=0.01), word)
    assert desk.drives[0].hertz == pytest.approx(20)
    assert desk.instance["Motor.OutputFrequencyHz"] == pytest.approx(hertz)
    assert desk.instance["Motor.Diagnosis.DcBusVoltageV"] == pytest.approx(volts)


@pytest.mark.thorough
def test_a_program_without_words_gets_its_drives_as_they_left_the_factory() -> None:
    text = EXAMPLE.read_text(encoding="utf-8").replace("MaximumHz := 50.0", "MaximumHz := 70.0")
    program = loaded(text.replace("Setting.ReferenceScale := CountsPerHertz", "Setting.ReferenceScale := 7.0"))
    controller = Controller(program.library, program.program.name, wired(text), program.drives, 10_000)
    controller.instance.scan(0)
    found = list(called.of_program(controller, maps()))
    assert [(one.drive.prefix, one.unit) for one in found] == [("SN300G5", 1), ("JSCC", 2), ("CHF", 3)]
    assert {(one.maximum_hz, one.scales) for one in found} == {(50, ())}


def test_words_name_drives_units_and_what_no_manual_says() -> None:
    one, two, three = named("chf@7:60", "jscc, sn300g5@9:400:CurrentScale=0.1:PowerScale=0.1")
    assert (one.path.stem, one.unit, one.maximum_hz, one.scales) == ("invt_chf", 7, 60, ())
    assert (two.path.stem, two.unit, two.maximum_hz, two.scales) == ("jscc", 1, 50, ())
    assert (three.path.stem, three.unit, three.maximum_hz) == ("shuen_sn300g5", 9, 400)
    assert three.scales == (("CurrentScale", "0.1"), ("PowerScale", "0.1"))


@pytest.mark.parametrize("path", ["my.yaml", "maps/my.yaml", "C:\\maps\\my.yaml", "C:/maps/my.yaml"])
def test_a_map_is_named_by_its_path_too(path: str) -> None:
    assert called.words([f"{path}@2:50", path]) == [called.Word(path, "2", ("50",)), called.Word(path, "", ())]


def test_another_process_gets_the_drives_as_they_are_set() -> None:
    drives = named("chf@7:60:CurrentScale=0.1:PowerScale=2", "jscc")
    assert simulated.named(json.loads(json.dumps(simulated.rows(drives)))) == drives


def test_what_is_set_is_printed_with_the_defaults() -> None:
    chf, jscc, shuen = named("chf@7:60:CurrentScale=0.1", "jscc", "sn300g5")
    assert chf.told() == [
        "CHF at unit 7: maximum 60 Hz (100 %), FrequencyScale=0.01,",
        "  CurrentScale=0.1, VoltageScale=0.01, DcVoltageScale=0.01,",
        "  PowerScale=0.01",
    ]
    assert chf.unwritten() == ["  reads 0 until written: 3007H-300DH, 3010H, 3012H-3014H"]
    assert jscc.told() == ["JSCC at unit 1: maximum 50 Hz, ReferenceScale=100"]
    assert shuen.told()[0].startswith("SN300G5 at unit 2: maximum 50 Hz, CurrentScale=0.01,")
    assert jscc.unwritten() == []
    assert list(called.told([jscc, chf])) == [
        *jscc.told(),
        *chf.told(),
        "11 registers read 0 until written: see driveblocks simulate DRIVE",
    ]
    assert list(called.told([jscc])) == jscc.told()


@pytest.mark.parametrize(
    ("word", "says"),
    [
        ("chf@1:0", "chf: `0` is no maximum; write whole Hz, 1 to 600, such as :50"),
        ("chf:601", "`601` is no maximum"),
        ("chf:49.5", "`49.5` is no maximum"),
        ("chf:-50", "`-50` is no maximum"),
        ("chf:50Hz", "`50Hz` is no maximum"),
        ("chf:\u0665\u0660", "is no maximum"),  # digits, but not those
        ("chf:", "`` is no maximum"),
        ("chf:50:60", "`60` comes after another one; write one of them"),
        ("chf:PowerScale=1:PowerScale=1", "`PowerScale=1` comes after another one"),
        ("chf:=50", "`=50` cannot be set"),
        ("jscc:FrequencyScale=1", "`FrequencyScale=1` cannot be set; the manual of JSCC does not give: ReferenceScale"),
        (
            "chf:ReferenceScale=100",
            "`ReferenceScale=100` cannot be set; the manual of CHF does not give: FrequencyScale,",
        ),
        ("sn300g5:FrequencyScale=1", "the manual of SN300G5 does not give: CurrentScale, DcVoltageScale, PowerScale"),
        ("chf:PowerScale=0", "`PowerScale=0` is no scale; write 0.01 to 10 per count, such as PowerScale=0.01"),
        ("chf:PowerScale=0.0125", "`PowerScale=0.0125` is no scale"),
        ("chf:PowerScale=1e1", "`PowerScale=1e1` is no scale"),
        ("jscc:ReferenceScale=0", "is no scale; write 0.1 to 1000 counts per Hz, such as ReferenceScale=100"),
        ("jscc:ReferenceScale=1001", "`ReferenceScale=1001` is no scale"),
    ],
)
def test_nonsense_is_refused(word: str, says: str) -> None:
    with pytest.raises(Refused) as error:
        named(word, option="--simulate ")
    assert says in str(error.value)
    assert str(error.value).startswith(f"--simulate {word.partition(':')[0].partition('@')[0]}: ")


def test_what_a_simulated_drive_shows_at_its_most_fits_a_word_at_the_finest_scale() -> None:
    for drive in MAPS.values():
        finest = tuple((name, "0.01") for name in called.open_scales(drive) if name != called.REFERENCE)
        made = Named(FILES["jscc"][0], drive, 1, called.HIGHEST_HZ, finest).made(ascii_mode=False)
        habits, gauges = made.habits, {each.shows: each for each in made.table.gauges}
        made.load = 100
        made.keypad_run(called.HIGHEST_HZ)
        made.step(1000 * called.HIGHEST_HZ)
        most = {
            "output_frequency": called.HIGHEST_HZ, "output_current": habits.amperes, "output_power": habits.kilowatts,
            "output_voltage": habits.motor_volts, "dc_bus_voltage": habits.bus_volts,
            "output_speed": 60 * called.HIGHEST_HZ // habits.pole_pairs, "relative_power": 100,
        }  # fmt: skip
        for shows, gauge in gauges.items():
            assert made.word(gauge.register) * gauge.milli == 1000 * most[shows], (drive.prefix, shows)
