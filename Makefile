# `make study` and `make test` are all one needs; both set up .venv first. Only Python (>= 3.11) and make are required.
PYTHON ?= python3
TRIALS ?= 3
STUDY  ?= studies/sma.toml
NEWEST ?=
SUBJECTS ?= effects bouc_wen free_energy kernels resources evidence start_up runner
BIN    := .venv/bin

.PHONY: install study test test-long test-newest schemas docs benchmark torture fuzz clean

install: .venv/installed

study: install
	$(BIN)/hysteresis-bench run $(STUDY) --trials $(TRIALS)

test: .venv/installed-test
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/python -m pytest -n auto --dist loadfile  # what the tests of a file share is made once

# What is too long for every change: whole diagnoses, ill-treated studies, built wheels.
test-long: .venv/installed-test
	$(BIN)/python -m pytest -n auto --dist worksteal -m long

# NEWEST: arguments for pytest, such as what to leave out.
test-newest: .venv/installed
	.ci/test-newest -n auto $(NEWEST)

# The JSON schemas of study, model and diagnosis files, from the forms in hysteresis_bench/schemas/.
schemas: .venv/installed
	$(BIN)/python -c "from hysteresis_bench.schemas.forms import write_schemas; write_schemas()"

docs: .venv/installed-docs
	$(BIN)/mkdocs build --strict --config-file docs/mkdocs.yml

# Under ten minutes: ratios inside one run, each line held or missed.
benchmark: .venv/installed-test
	for subject in $(SUBJECTS); do $(BIN)/python benchmarks/$$subject.py || exit; done
	$(BIN)/python benchmarks/search.py --truths 5

# About ten minutes: bad trials, kills of the runner and of its workers.
torture: .venv/installed-test
	$(BIN)/python benchmarks/torture.py --dask

# About half an hour: 10 000 inputs to everything that is read, and to every model and effect.
fuzz: .venv/installed-test
	$(BIN)/python benchmarks/fuzzing.py

clean:
	rm -rf .venv .venv-newest site .pytest_cache .ruff_cache .mypy_cache .hypothesis

.venv/installed: pyproject.toml
	test -x $(BIN)/python || $(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable .
	touch $@

.venv/installed-test: .venv/installed
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[test,docs,cluster]'
	touch $@

.venv/installed-docs: .venv/installed
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[docs]'
	touch $@
