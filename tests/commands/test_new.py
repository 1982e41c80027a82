"""`driveblocks new` and the map that it writes: the one on the page, small and good."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from click.testing import CliRunner

from driveblocks.cli import app
from driveblocks.desk.site import kept
from driveblocks.desk.site.found import Found, Way
from driveblocks.maps import collection, page

GUIDE = Path(__file__).parents[2] / "vendor_maps/README.md"


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def on_the_page() -> str:
    """The map as it is on the page."""
    (block,) = [part for part in GUIDE.read_text(encoding="utf-8").split("```yaml\n")[1:] if "prefix: ACME" in part]
    return block.partition("```")[0]


def test_the_command_writes_the_good_map_that_is_on_the_page() -> None:
    result = CliRunner().invoke(app, ["new", "ACME"])
    assert result.exit_code == 0
    assert Path("acme.yaml").read_text(encoding="utf-8") == on_the_page() == page.skeleton()
    assert result.stdout.splitlines()[-1] == "driveblocks check acme.yaml"
    checked = CliRunner().invoke(app, ["check", "acme.yaml"])
    assert (checked.exit_code, checked.stderr) == (0, ""), checked.output


def test_the_prefix_is_the_users_as_long_as_it_may_be() -> None:
    assert CliRunner().invoke(app, ["new", "NORDWIND2000", "-o", "nordwind.yaml"]).exit_code == 0
    text = Path("nordwind.yaml").read_text(encoding="utf-8")
    assert "\nprefix: NORDWIND2000 " in text
    assert "ACME" not in text
    collection.read([Path("nordwind.yaml")])


def test_a_file_that_is_there_is_never_touched() -> None:
    Path("acme.yaml").write_text("mine", encoding="utf-8")
    result = CliRunner().invoke(app, ["new", "ACME"])
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr == "acme.yaml: is there already; name another file with -o\n"
    assert Path("acme.yaml").read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["acme"], "this cannot be a prefix; write 1 to 12 upper-case letters and digits, such as SN300G5"),
        (["A\x1b[2J"], "this cannot be a prefix; "),
        (["ACME", "-o", "no/such/folder.yaml"], "no/such/folder.yaml: cannot be written: No such file or directory"),
        (["ACME", "-o", "."], ".: is there already"),
    ],
)
def test_what_cannot_be_written_gives_status_2(arguments: list[str], said: str) -> None:
    result = CliRunner().invoke(app, ["new", *arguments])
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.startswith(said)
    assert list(Path.cwd().iterdir()) == []


@contextmanager
def full() -> Iterator[None]:
    """A disk that takes no byte more."""
    resource = pytest.importorskip("resource")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.parametrize(
    "words",
    ["new ACME -o out", "import-csv table.csv -o out", "line jscc --picture out", "site --html out"],
)
def test_a_full_disk_is_said_of_the_file_and_leaves_no_half_of_one(words: str) -> None:
    about = kept.About("Pump", "jscc", "12345678", "2026-11-23 10:30", "")
    kept.write(Path("site.yaml"), about, Found(Way(9600), 1, "fits"))
    Path("table.csv").write_text("address,name\n2000H,Speed\n", encoding="utf-8")
    with full():
        result = CliRunner().invoke(app, words.split())
    assert (result.exit_code, result.output) == (2, "out: cannot be written: File too large\n")
    assert not Path("out").exists()
    assert CliRunner().invoke(app, words.split()).exit_code == 0
