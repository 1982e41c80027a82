"""The programs of the example plants: their motors turn, and nothing turns that no hand has started."""

from itertools import pairwise

import pytest
from tests.plant.bench import PLANTS, Bench, example

from driveblocks.plant import program

HALF = 13824


def ready(name: str = "pumps") -> Bench:
    """A plant in which every drive is known and every contact is closed."""
    made = Bench(example(name))
    made.give(**dict.fromkeys(made.plant.inputs, HALF))
    made.give(**{f"{each.name}_Hertz": 20.0 for each in made.plant.drives.values() if each.speed is None})
    made.run(6000)
    made.press("Hmi_Reset")
    made.run(200)
    return made


def started(name: str = "pumps") -> Bench:
    made = ready(name)
    for each in made.plant.buttons.values():
        if each.does == "start":
            made.press(each.name)
    return made


@pytest.mark.parametrize("name", PLANTS)
def test_motors_turn_and_stand_still_again(name: str) -> None:
    made = started(name)
    running = {"pumps": {"P1", "P2", "P4", "P5"}}.get(name, set(made.plant.drives))
    made.until(lambda: {each for each in made.drives if made[f"{each}.Running"]} == running)
    made.run(1500)
    assert made.turning() == running
    assert all(made[f"{each}_Counted.Starts"] == 1 for each in running)
    assert all(made[f"{each}_Counted.RunS"] for each in running)
    made.give(Hmi_StopAll=True)
    made.until(lambda: not made.turning())
    made.until(lambda: all(made[f"{each}.StopConfirmed"] for each in made.drives))
    made.give(Hmi_StopAll=False)
    made.run(3000)
    assert made.turning() == set()


@pytest.mark.parametrize("name", PLANTS)
def test_what_is_held_at_power_up_starts_nothing(name: str) -> None:
    made = Bench(example(name))
    made.give(**dict.fromkeys(made.plant.inputs, HALF))
    held = [f"{each}_Start" for each in program.commanded(made.plant)]
    held += [each.name for each in made.plant.buttons.values() if each.does in {"start", "reset"}]
    made.give(Hmi_Reset=True, **dict.fromkeys(held, True))
    made.run(8000)
    assert all(made[f"{each}.Ready"] for each in made.drives)
    assert made.turning() == set()


@pytest.mark.parametrize("name", PLANTS)
def test_power_cycle_keeps_hours_and_starts_nothing(name: str) -> None:
    before = started(name)
    before.run(3000)
    kept = {
        f"{each}_Counted.{part}": before[f"{each}_Counted.{part}"]
        for each in before.drives
        for part in ("RunS", "Starts")
    }
    made = Bench(example(name), kept=kept)
    made.give(**dict.fromkeys(made.plant.inputs, HALF))
    made.run(8000)
    assert made.turning() == set()
    assert {each: made[each] for each in kept} == kept


def test_standby_starts_once_the_pump_that_tripped_stands() -> None:
    made = started()
    made.until(lambda: made["North.RunCount"] == 2)
    made.drives["P2"].trip(1)
    made.until(lambda: bool(made["North.Waiting"]))
    assert not made["North_Members[2].Run"]
    made.until(lambda: bool(made["North_Members[2].Run"]))
    assert made["P2.StopConfirmed"]
    made.until(lambda: made.turning() >= {"P1", "P3"})
    assert made["NorthFault"]
    assert not made["SouthFault"]


def test_pump_that_proves_no_standstill_while_it_has_a_fault_is_not_replaced() -> None:
    made = started()
    made.until(lambda: made["North.RunCount"] == 2)
    made.drives["P1"].trip(1)
    made.run(6000)
    assert made["North.Waiting"]
    made.drives["P1"].clear_cause()
    made.drives["P1"].reset()
    made.until(lambda: bool(made["P1.StopConfirmed"]))
    made.run(1000)
    assert made.turning() & {"P1", "P2", "P3"} == {"P2"}


def test_pump_without_supply_is_not_replaced_and_opens_the_contact_of_its_house() -> None:
    made = started()
    made.until(lambda: made["North.RunCount"] == 2)
    made.drives["P1"].power(on=False)
    made.until(lambda: not made["HardStopNorth_Ok"])
    made.run(2000)
    assert made["North.Waiting"]
    assert "P3" not in made.turning()
    assert made["HardStopSouth_Ok"]
    assert made.turning() >= {"P4", "P5"}


def test_hard_stop_ends_the_command_of_its_house_alone() -> None:
    made = started()
    made.until(lambda: made["North.RunCount"] == 2)
    made.give(HardStopNorth_Closed=False)
    made.until(lambda: not made.turning() & {"P1", "P2", "P3"})
    made.give(HardStopNorth_Closed=True)
    made.run(3000)
    assert made.turning() == {"P4", "P5"}
    assert not made["North_Run"]


def test_button_that_stops_is_normally_closed() -> None:
    made = started()
    made.until(lambda: made["North.RunCount"] == 2)
    made.give(StopNorth=False)
    made.until(lambda: not made.turning() & {"P1", "P2"})
    made.give(StopNorth=True)
    made.run(2000)
    assert made.turning() == {"P4", "P5"}
    made.give(StopEverything=False)
    made.until(lambda: not made.turning())


def test_broken_wire_stops_what_depends_on_it_until_a_new_start() -> None:
    made = started()
    made.until(lambda: made["North.RunCount"] == 2)
    made.give(Level=32767)
    made.until(lambda: made.turning() == {"P4", "P5"})
    assert made["Level_Scale.Broken"]
    made.give(Level=HALF)
    made.run(3000)
    assert made.turning() == {"P4", "P5"}
    made.press("StartNorth")
    made.until(lambda: len(made.turning()) == 4)


def test_pump_out_of_service_is_neither_started_nor_replaced() -> None:
    made = ready()
    made.give(P1_Off=True)
    made.run(50)
    made.press("StartNorth")
    made.until(lambda: made.turning() == {"P2", "P3"})
    made.give(P1_Off=False, P2_Off=True)
    made.until(lambda: made.turning() == {"P3"})
    made.run(2000)
    assert made.turning() == {"P3"}


def test_belts_start_one_after_the_other_and_one_that_trips_stops_all() -> None:
    made = started("conveyor")
    begun: dict[str, int] = {}
    for _ in range(2600):
        made.scan()
        begun |= {each: made.now_ms for each in made.turning() if each not in begun}
    assert [*begun] == [f"Belt{number}" for number in range(8, 0, -1)]
    times = [*begun.values()]
    assert all(later - sooner >= 2900 for sooner, later in pairwise(times[1:]))
    made.drives["Belt5"].trip(2)
    made.until(lambda: not made.turning())
    assert not made["Belts_Run"]


def test_speed_comes_from_input_number_or_panel() -> None:
    made = started("small")
    made.run(4000)
    assert [round(made.drives[each].motor.output / 1000) for each in ("Mixer", "Pump", "Fan")] == [20, 45, 25]
    assert [made[f"{each}Fault"] for each in ("Mixer", "Pump", "Fan")] == [False] * 3
    made.drives["Fan"].power(on=False)
    made.until(lambda: bool(made["FanFault"]))
