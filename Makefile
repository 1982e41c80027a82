# Short names for what CONTRIBUTING.md explains. Nothing here is needed to use the project.
PY := .venv/bin/python
DB := .venv/bin/driveblocks
SEED := $(shell od -An -N3 -tu4 /dev/urandom)
.PHONY: demo test blocks counts schema fuzz mutation promise compare compare-blocks traces verdicts coverage sanitize libfuzzer exhaustive bench line drives matrix mutants linux-line desk-line release prove

demo test:            ## set up, then run the main job / every test
	python3 generator/bootstrap.py $@

blocks:               ## blocks/ from the maps and templates
	$(DB) build

counts:               ## the tables of drives in the READMEs, from the maps
	$(DB) counts README.md vendor_maps/README.md

schema:               ## vendor_maps/schema.json and keys.md from the model, and the smallest map in the guide
	$(DB) schema vendor_maps

fuzz:                 ## random maps, texts for both YAML parsers, every property of the suite, damaged replies; hostile files
	@echo "again: make fuzz SEED=$(strip $(SEED))"
	$(PY) tests/maps/fuzz.py --seed $(SEED)
	$(PY) -m tests.maps.agreement --seed $(SEED)
	$(PY) -m pytest -n auto -m hypothesis --hypothesis-profile search --hypothesis-seed $(SEED)
	$(PY) -m pytest -n auto -m long
	$(PY) -m tests.blocks.fuzz --seed $(SEED)

mutation:             ## change every fact of the maps that reaches a block, and see a test turn red
	$(PY) -m tests.blocks.mutation

promise:              ## 3000 changes of maps as authors make them: what check calls good builds, lints clean and passes its tests
	$(PY) -m tests.blocks.promise

compare:              ## 10^5 scans of every block of the corpus and 10^6 expressions, embedded against matiec
	$(PY) -m tests.structured_text.engines.compare.long

compare-blocks:       ## 10^5 scans of every block and function of the library, three engines, the full state after each
	$(PY) -m tests.blocks.compare.long

traces:               ## record how matiec runs the corpus and the library (needs both lines of matiec)
	$(PY) -m tests.structured_text.engines.traces.record

verdicts:             ## record what matiec says of the accept/reject corpus
	$(PY) -m tests.structured_text.engines.accept.record

coverage:             ## lines and branches of the blocks that the test programs reach, on every engine found
	$(DB) test --engine all --require-coverage 90

sanitize:             ## every block under ASan and UBSan: 10^7 damaged inputs per parser, 10^6 per other block
	$(PY) -m tests.native.sanitize

libfuzzer:            ## coverage-guided fuzzing of parsers, framing and requests, a minute per target and line
	$(PY) -m tests.native.fuzz

exhaustive:           ## CRC, decoders, permissions, standstill, lengths, all 2^32 REALs of the references, on each line of matiec
	$(PY) -m tests.native.exhaustive

line:                 ## the line at length on a virtual RS-485 line: 10^6 random stop scenarios, planted mistakes; writes docs/measured/line.md
	$(PY) -m tests.line.long --page

drives:               ## drive blocks at length: planted mistakes, the matrix, 10^5 random walks, 24 hours of bus per family (matiec: faster)
	$(PY) -m tests.drives.long

matrix:               ## every mode x event x state on second models of the drives, TIMES=4 each, and random walks; matiec: faster
	$(PY) -m tests.second.long --times $(or $(TIMES),4)

prove:                ## every rule for every family and made-up drive, 10^4 calls per block on the engine, 100 planted changes
	$(DB) prove
	$(PY) -m tests.prove.agreement
	$(PY) -m tests.prove.mutants
	$(PY) -m pytest -n auto -m long tests/prove

mutants:              ## 300 single changes of the blocks that run a motor, SEED=611: which of them `driveblocks test` finds
	$(PY) -m tests.testing.mutants --seed $(or $(SEED),611)

linux-line:           ## an hour of a soft PLC by matiec against the simulator, 1 % of the frames damaged (SECONDS=3600)
	$(PY) -m tests.stand.softplc $(or $(SECONDS),3600)

desk-line:            ## an hour of `driveblocks run` at pymodbus's server over pseudo-terminals, 1 % of the frames damaged (SECONDS=3600)
	$(PY) -m tests.stand.deskplc $(or $(SECONDS),3600)

bench:                ## every figure, side by side in one run; writes docs/measured/performance.md
	$(PY) -m tests.bench.run

release:              ## one archive per platform from blocks/ into dist/, the same bytes each time
	$(DB) build --check
	$(PY) -m driveblocks.output.release
