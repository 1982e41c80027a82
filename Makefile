# Short names for what CONTRIBUTING.md explains. Nothing here is needed to use the project.
PY := .venv/bin/python
.PHONY: demo test fuzz bench counts schema traces compare

demo test:            ## set up, then run the main job / every test (demo: 1 min, test: under 5 min)
	python3 generator/bootstrap.py $@

fuzz:                 ## 10^4 random mutations of the vendor maps (some minutes)
	$(PY) tests/maps/fuzz.py

bench:                ## every figure, side by side in one run (some minutes)
	$(PY) tests/bench/run.py

schema:               ## write vendor_maps/schema.json from the model
	.venv/bin/driveblocks schema vendor_maps
