# make setup | demo | test | test-long | verification | stability | stability-reference | study | reproduction | bench-tests | lint: each sets up what it needs and is quick when there is nothing to do.
SHELL := /bin/bash
.DELETE_ON_ERROR:
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
RESULTS := cases/bolt-hole/results
LADDER := build/verification
SCENES := build/stability

.PHONY: setup demo test test-long verification stability stability-reference study reproduction bench-tests lint clean

setup: $(READY)

$(READY): pyproject.toml .ci/setup.sh peenflow/__init__.py
	.ci/setup.sh $(VENV)
	touch $@

demo: setup
	$(BIN)/peenflow run cases/bolt-hole --out $(RESULTS)
	@echo "Open $(CURDIR)/$(RESULTS)/report/index.html"

# two workers, one solver thread each: more would only take turns on two cores; a file stays on one worker, for its
# tests share runs
test: setup
	NUMBA_NUM_THREADS=1 OMP_NUM_THREADS=1 $(BIN)/pytest -n 2 --dist loadfile -m "not long"

test-long: setup
	$(BIN)/pytest -m long

# the whole ladder; the page is written whether or not a rung failed, and says which
verification: setup
	rm -rf $(LADDER)
	$(BIN)/pytest tests/verification --record $(LADDER); told=$$?; \
	  $(BIN)/python tests/support/ladder_page.py verification $(LADDER) docs && exit $$told

# the hard scenes, likewise; two workers as in `test`
stability: setup
	rm -rf $(SCENES)
	NUMBA_NUM_THREADS=1 OMP_NUM_THREADS=1 $(BIN)/pytest tests/stability -n 2 --record $(SCENES); told=$$?; \
	  $(BIN)/python tests/support/ladder_page.py stability $(SCENES) docs && exit $$told

# half an hour: finer results of the hard scenes, for `stability` to be held to; GROUPS="speeds grazing …" chooses
stability-reference: setup
	$(BIN)/python tests/support/hard_scenes/record.py $(GROUPS)

# accuracy against time: hours for all parts, of which PARTS="single-shot depth …" chooses; finished points are kept
study: setup
	$(BIN)/python docs/scripts/study.py $(PARTS)

# the paper's tables and figures, docs/reproduction.md: under 40 minutes on two cores, two parts side by side with one
# solver thread each; PARTS chooses here too, one part alone takes all threads
reproduction: setup
	$(BIN)/python docs/scripts/reproduction/make.py $(PARTS)

# how fast, not whether right: files bench_*.py, which no other target collects
bench-tests: setup
	$(BIN)/pytest tests/benchmark -o python_files="bench_*.py" -o python_functions="bench_*" -p benchmark

lint: setup
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

clean:
	rm -rf $(VENV) dist build .pytest_cache .mypy_cache .ruff_cache .hypothesis
