# make book   compute every notebook and build the book   RUNS=10 runs per condition; 4 is a quick look, 100 the papers' scale
# make test   run the tests
# make exact  run the reference runs in every way that must give the same bits, and print which do; PYTHONS="python3.13"
# make verify recompute a random sample of the runs behind the figures and compare; SAMPLE=20 runs, SEED=of the sample
# make lab    open the notebooks in JupyterLab
# make readme write the claims of the last build into the README
# make bench  measure the speed of the kernels
# make wheel build the wheel to publish, dist/*.whl, which carries the kernels as WebAssembly modules
# make clean  remove all that these made, and nothing else
PYTHON ?= python3
PYTHONS ?=
SAMPLE ?= 20
SEED ?=
RUNS ?= 10
STEPS ?=
BIN := .venv/bin
export NEORL_CACHE := $(CURDIR)/.cache
export PYTHONUNBUFFERED := 1

.DEFAULT_GOAL := book
.PHONY: book test exact verify lab readme bench wheel clean

book: .venv/ready
	$(BIN)/python book/build.py --runs $(RUNS) $(if $(STEPS),--steps $(STEPS))

test: .venv/ready
	$(BIN)/python -m pytest --numprocesses auto --maxprocesses 4 --dist loadfile --no-loadscope-reorder $(ARGS)

exact: .venv/ready
	$(BIN)/python tests/exactness.py $(PYTHONS)

verify: .venv/ready
	$(BIN)/python book/verify.py --sample $(SAMPLE) $(if $(SEED),--seed $(SEED))

lab: .venv/ready
	$(BIN)/jupyter lab --notebook-dir notebooks

readme: .venv/ready
	$(BIN)/python book/readme.py

bench: .venv/ready
	$(BIN)/python -m pytest --benchmark-only --benchmark-disable-gc tests/benchmarks.py

# What is compiled is kept in .cache and put into the wheel alone: an installation from a clone compiles on first use.
wheel: .venv/ready
	rm -rf build dist
	$(BIN)/python -c "from neorl.browser import wasm; wasm.ship('neorl')"
	$(BIN)/python -m pip wheel --quiet --no-deps --no-build-isolation --wheel-dir dist . ; \
	    status=$$?; rm -f neorl/browser/*.wasm; exit $$status

# Pins are complete, so pip need not resolve anything; modules are compiled when first used, which is far fewer.
.venv/ready: environment.txt pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Python 3.11 or later is needed; name it with make PYTHON=...")'
	$(PYTHON) -m venv --clear .venv
	$(BIN)/python -m pip install --quiet --no-deps --no-compile -r environment.txt
	$(BIN)/python -m pip install --quiet --no-deps --no-build-isolation --editable .
	touch $@

clean:
	rm -rf .venv .cache _build build dist book/chapters .pytest_cache .benchmarks .hypothesis *.egg-info
