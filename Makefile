# SPDX-License-Identifier: GPL-3.0-or-later
# `make demo` and `make test` need nothing prepared: each makes the environments it uses, in .env/.

# Any Python from 3.9 on can run tools/environment.py; names that are shims without a version behind them are skipped.
PYTHON ?= $(shell for p in python3 python3.13 python3.12 python3.11 /usr/bin/python3; do \
	"$$p" -c 'import sys; sys.exit(sys.version_info < (3, 9))' >/dev/null 2>&1 && echo "$$p" && break; done)
NEED_PYTHON = $(error Python 3.9 or later is missing: install python3 and its venv module \
	(apt install python3-venv, dnf install python3, brew install python) and run make again)
MAKE_ENVIRONMENT = $(or $(strip $(PYTHON)),$(NEED_PYTHON)) tools/environment.py

BLENDER_5.2 = .env/blender-5.2/bin/python
BLENDER_4.5 = .env/blender-4.5/bin/python

# What `make demo` renders: four to five minutes on two idle cores, a frame of film some 5 s of that.
DEMO_PRESET ?= moderate
STILL_SAMPLES ?= 48
FILM_FRAMES ?= 1:30
FILM_RESOLUTION ?= 480x270
FILM_SAMPLES ?= 6

# Passed on to pytest, for example: make test TESTS="tests/core -k dispersion"
TESTS ?=

# Passed on to the benchmark, for example: make bench BENCH=--full
BENCH ?=

.PHONY: help demo test test-5.2 test-4.5 fuzz fuzz-5.2 fuzz-4.5 hard-cases lint bench bench-without-blas cost effects sea-checks zip clean \
	environment-blender-5.2 environment-blender-4.5 \
	environment-lint

help:
	@echo 'make demo    render a still and a short film of the sea to out/'
	@echo 'make test    run all tests on Blender 5.2 and on Blender 4.5'
	@echo 'make fuzz    look for settings that break the sea, for hours, on both Blenders'
	@echo 'make hard-cases  measure the hard cases again, into docs/hard-cases.md'
	@echo 'make lint    check the style of the code'
	@echo 'make bench   measure the time a frame takes (BENCH=--full for the whole table)'
	@echo 'make bench-without-blas    the same, and with a NumPy without BLAS, which it compiles'
	@echo 'make cost    measure what accuracy costs in time, into docs/accuracy-and-cost.md'
	@echo 'make effects measure what each effect takes, on and off, into docs/effects.md'
	@echo 'make sea-checks  look for repetition and flicker in pictures of the sea, into out/'
	@echo 'make zip     build the extension, to install in Blender, in dist/'
	@echo 'make clean   remove the environments and everything that was built'

demo: environment-blender-5.2
	@mkdir -p out
	$(BLENDER_5.2) -m ocean_lod_addon render --preset $(DEMO_PRESET) --engine CYCLES \
		--resolution 960x540 --samples $(STILL_SAMPLES) --output out/ocean_still.png
	$(BLENDER_5.2) -m ocean_lod_addon render --preset $(DEMO_PRESET) --engine CYCLES \
		--frames $(FILM_FRAMES) --resolution $(FILM_RESOLUTION) --samples $(FILM_SAMPLES) --denoise \
		--output out/ocean_film.mp4
	@echo
	@echo 'Still: $(CURDIR)/out/ocean_still.png'
	@echo 'Film:  $(CURDIR)/out/ocean_film.mp4'

test: test-5.2 test-4.5

test-5.2: environment-blender-5.2
	$(BLENDER_5.2) tools/run_tests.py $(TESTS)

test-4.5: environment-blender-4.5
	$(BLENDER_4.5) tools/run_tests.py $(TESTS)

# Examples of each property, steps in Blender, and frames over which memory stays flat; another seed looks elsewhere.
FUZZ_EXAMPLES ?= 10000
FUZZ_STEPS ?= 2000
FUZZ_FRAMES ?= 2000
FUZZ_SEED ?= 0

fuzz: fuzz-5.2 fuzz-4.5

fuzz-5.2 fuzz-4.5: fuzz-%: environment-blender-%
	OCEAN_LOD_EXAMPLES=$(FUZZ_EXAMPLES) $(BLENDER_$*) tools/run_tests.py \
		tests/hard_cases/test_any_settings.py tests/hard_cases/test_any_light.py
	OCEAN_LOD_FRAMES=$(FUZZ_FRAMES) $(BLENDER_$*) tools/run_tests.py tests/hard_cases/test_memory_is_flat.py
	$(BLENDER_$*) tools/fuzz_blender.py --steps $(FUZZ_STEPS) --seed $(FUZZ_SEED)

hard-cases: environment-blender-5.2
	$(BLENDER_5.2) tools/hard_cases_table.py

lint: environment-lint
	.env/lint/bin/python -m ruff check .

bench: environment-blender-5.2
	$(BLENDER_5.2) -m ocean_lod_addon bench $(BENCH)

bench-without-blas: environment-blender-5.2
	$(BLENDER_5.2) tools/numpy_without_blas.py
	$(BLENDER_5.2) -m ocean_lod_addon bench --numpy-without-blas .env/numpy-without-blas/bin/python $(BENCH)

# Passed on to the measurement, for example: make cost COST=--quick
COST ?= --full

# Passed on to the measurement, for example: make effects EFFECTS=--full
EFFECTS ?=

cost: environment-blender-5.2
	$(BLENDER_5.2) -m ocean_lod_addon cost $(COST) --output out/cost.json
	$(BLENDER_5.2) -m tools.accuracy_document out/cost.json

effects: environment-blender-5.2
	$(BLENDER_5.2) -m ocean_lod_addon effects $(EFFECTS) --output out/effects.json
	$(BLENDER_5.2) -m tools.effects_document out/effects.json

# Passed on to both checks, for example: make sea-checks SEA_CHECKS="--engine EEVEE --width 128"
SEA_CHECKS ?=

sea-checks: environment-blender-5.2
	$(BLENDER_5.2) -m tools.sea_checks repetition --save out $(SEA_CHECKS)
	$(BLENDER_5.2) -m tools.sea_checks flicker --save out $(SEA_CHECKS)

zip: environment-blender-5.2
	$(BLENDER_5.2) tools/extension.py

clean:
	rm -rf .env dist out

environment-blender-5.2 environment-blender-4.5 environment-lint: environment-%:
	@$(MAKE_ENVIRONMENT) $*
