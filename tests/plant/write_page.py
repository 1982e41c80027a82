"""Make the tables of docs/plant.md anew: `python -m tests.plant.write_page`."""

from tests.plant.test_page import PAGE

from driveblocks.plant import page

if __name__ == "__main__":
    PAGE.write_text(page.update(PAGE.read_text("utf-8")), encoding="utf-8")
