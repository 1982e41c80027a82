# Short names for what CONTRIBUTING.md explains. Nothing here is needed to use the project.
PY := .venv/bin/python
DB := .venv/bin/driveblocks
.PHONY: help test blocks bench long release
.DEFAULT_GOAL := help

help:                 ## this list
	@sed -n 's/^\([a-z]*\):.*## /\1\t/p' Makefile

test:                 ## set up, then run what continuous integration runs
	python3 generator/bootstrap.py test

blocks:               ## what is made from maps and templates: blocks/, tables of drives in the READMEs, schema and keys
	$(DB) build
	$(DB) counts README.md vendor_maps/README.md
	$(DB) schema vendor_maps

bench:                ## every figure, side by side in one run; writes docs/measured/performance.md
	$(PY) -m tests.bench.run

long:                 ## one long run by its name, WHAT=line; without it the list
	@$(PY) -m tests.long $(WHAT)

release:              ## an archive per platform and family into dist/, the same bytes each time
	$(DB) build --check
	$(PY) -m driveblocks release
