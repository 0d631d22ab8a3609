# make book   compute every notebook and build the book   RUNS=10 runs per condition, the fewest that give verdicts; 100 are
#                                                         the papers' scale; by default each notebook's own, mostly 3
#                                                         READING=letter for the reading of the thesis to the letter
#                                                         JOBS=2 notebooks at a time, of up to 4 GB each
# make test   run the tests                               WORKERS=4 processes, since tests of pages wait for a browser
# make types  check the types of the public modules and of typical uses of them
# make package test the package as installed from WHEEL=dist/*.whl, or from one that is built, with ARGS="of pytest"
# The tests that `make test` leaves out, since they take long, are marked, and each mark has a target:
# make deep   begin the stored runs of deep learners again; installs their packages, among them PyTorch, into .venv
# make exact  run the reference runs in every way that must give the same bits; PYTHONS="python3.13"
# make pages  run the pages in a kernel in the ways of their readers; PAGES="paper_a paper_b"
# make fuzz   try random kernels of a user's that write and return wild values; SETTINGS=1000 of them
#
# make verify recompute a random sample of the runs behind the figures and compare; SAMPLE=20 runs, SEED=of the sample
# make lab    open the notebooks in JupyterLab, which saves pages without outputs
# make record compute the record that book and README show, in some three core-hours; other pages' claims are of RUNS=100
# make readme write the recorded claims into the README
# make pictures draw the star again, the README's moving picture and the front page's still one
# make bench  measure the speed of the kernels
# make wheel build the wheel to publish, dist/*.whl, which carries the kernels as WebAssembly modules
# make clean  remove all that these made, and nothing else
PYTHON ?= python3
WHEEL ?=
SAMPLE ?= 20
SEED ?=
RUNS ?=
READING ?= calibrated
STEPS ?=
JOBS ?= 2
WORKERS ?= 4
BIN := .venv/bin
DEEP := torch==2.13.0 stable-baselines3==2.9.2 sb3-contrib==2.9.2
# A relative NEORL_CACHE counts from here, whether or not a recipe starts a shell.
export PWD := $(CURDIR)
export PYTHONUNBUFFERED := 1
# Where the environment forbids it, every process would compile all modules again that it imports, for seconds.
unexport PYTHONDONTWRITEBYTECODE

# Pages of the book. Long ones come first. A page that measures times is computed alone, after the others, and the
# conclusion, which measures times too and reads the findings of all, comes last.
CHAPTERS := book/chapters
NAMES := $(notdir $(basename $(wildcard notebooks/*.ipynb)))
LONG := assumptions beyond_agents calibration paper_a paper_b paper_c
TIMED := performance
CONCLUSION := chapter_5
TOGETHER := $(filter $(NAMES),$(LONG)) $(filter-out $(LONG) $(TIMED) $(CONCLUSION),$(NAMES))
EXPLORERS := $(notdir $(basename $(shell grep -l -e neorl.Explorer -e 'import Turn' notebooks/*.ipynb)))
SOURCES := $(shell find neorl notebooks/companion -type f -not -path '*/__pycache__/*') environment.txt \
    $(addprefix book/computing/,cells.py compute.py excerpts.py programs.py)
HTML := _build/html/index.html
page = $(1:%=$(CHAPTERS)/%.ipynb)

.DEFAULT_GOAL := book
# Files that are replaced only by complete ones, so make need not remove them when it is interrupted.
.PRECIOUS: $(HTML) $(call page,$(NAMES))
.PHONY: book test types deep exact pages fuzz package verify lab record readme pictures bench wheel clean FORCE

book: .venv/ready
	@$(MAKE) --no-print-directory --keep-going --jobs=$(JOBS) $(HTML)
	@$(BIN)/python -c "from pathlib import Path; print('the book is at', Path('$(HTML)').absolute().as_uri())"

# Threads of linear algebra that wait for each other beside another notebook took fifty times as long as one thread.
book test: export OPENBLAS_NUM_THREADS := 1
$(CHAPTERS)/%.ipynb: notebooks/%.ipynb $(SOURCES) $(CHAPTERS)/.parameters
	@$(BIN)/python book/computing/compute.py $< $(if $(RUNS),--runs $(RUNS)) $(if $(STEPS),--steps $(STEPS)) --reading $(READING)

# One core builds the WebAssembly modules while the first page compiles the kernels for all others.
AT_ONCE := 1
$(CHAPTERS)/.modules: $(SOURCES) | .venv/ready
	@mkdir -p $(@D)
	@echo "compiling the kernels for the browser, unless .cache has them: a minute or more …"
	@$(BIN)/python -c "from neorl.browser import wasm; wasm.modules(at_once=$(AT_ONCE))"
	@echo "the kernels for the browser are ready"
	@touch $@

$(call page,$(EXPLORERS)): | $(CHAPTERS)/.modules
$(call page,$(TIMED)): | $(call page,$(TOGETHER))
$(call page,$(CONCLUSION)): $(call page,$(filter-out $(CONCLUSION),$(NAMES)))

# Changes only if the parameters do.
$(CHAPTERS)/.parameters: FORCE
	@case "$(RUNS)-$(STEPS)" in *[!0-9-]*|0*|*-0*) \
	    echo "RUNS and STEPS must be integers of at least 1, but are '$(RUNS)' and '$(STEPS)'"; exit 1;; esac
	@case "$(READING)" in calibrated|letter) ;; *) \
	    echo "READING must be 'calibrated' or 'letter', but is '$(READING)'"; exit 1;; esac
	@mkdir -p $(@D)
	@echo "$(RUNS) $(STEPS) $(READING)" | cmp -s - $@ || echo "$(RUNS) $(STEPS) $(READING)" > $@

$(CHAPTERS)/claims-table.md: $(call page,$(TOGETHER) $(filter $(NAMES),$(TIMED) $(CONCLUSION))) $(wildcard book/*/*.py) \
    $(wildcard book/*.toml book/star.* book/game.* book/rules_before.*) book/_toc.yml
	@$(BIN)/python book/writing/tables.py

# Readers of the last book have it until the next is complete.
$(HTML): $(CHAPTERS)/claims-table.md $(shell find book -type f -not -path '$(CHAPTERS)/*' -not -path '*/__pycache__/*') \
    _config.yml pyproject.toml
	@rm -rf _build/next _build/last
	@$(BIN)/jupyter-book build book --config _config.yml --path-output _build/next --all --quiet --warningiserror \
	    --keep-going --nitpick > /dev/null
	@if [ -e _build/html ]; then mv _build/html _build/last; fi
	@mv _build/next/_build/html _build/html
	@rm -rf _build/next _build/last

test: .venv/ready
	$(BIN)/python -m pytest --numprocesses $(WORKERS) --dist loadfile --no-loadscope-reorder $(ARGS)

types: .venv/ready
	$(BIN)/mypy --warn-unused-ignores

deep exact pages fuzz: .venv/ready
	$(if $(filter deep,$@),$(BIN)/python -m pip install --quiet $(DEEP))
	$(BIN)/python -m pytest --numprocesses $(JOBS) --dist load -m $@ $(ARGS)

# On every system, so without .venv.
package:
	rm -rf build
	$(PYTHON) tests/installation.py "$(WHEEL)" $(ARGS)

verify: .venv/ready
	$(BIN)/python book/computing/verify.py --sample $(SAMPLE) $(if $(SEED),--seed $(SEED))

lab: AT_ONCE := 2
lab: .venv/ready $(CHAPTERS)/.modules
	$(BIN)/jupyter lab --ServerApp.root_dir=. --LabApp.default_url=/lab/tree/notebooks \
	    --ContentsManager.pre_save_hook=companion.page.saving.keep_source \
	    $(if $(filter 0,$(shell id -u)),--allow-root) $(ARGS)

record: .venv/ready
	@$(BIN)/python book/computing/record.py

readme: .venv/ready
	$(BIN)/python book/writing/readme.py

pictures: .venv/ready
	$(BIN)/python book/writing/moving.py

bench: .venv/ready
	$(BIN)/python -m pytest --benchmark-only --benchmark-disable-gc tests/benchmarks.py

# What is compiled is kept in .cache and put into the wheel alone: an installation from a clone compiles on first use.
wheel: .venv/ready
	rm -rf build dist
	$(BIN)/python -c "from neorl.browser import wasm; wasm.ship('neorl')"
	$(BIN)/python -m pip wheel --quiet --no-deps --no-build-isolation --wheel-dir dist . ; \
	    status=$$?; rm -f neorl/browser/*.wasm; exit $$status

# Pins are complete, so pip need not resolve anything; modules are compiled when first used, which is far fewer. Pages
# find `companion` from any folder, and what computes and writes the book finds its parts.
.venv/ready: environment.txt pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Python 3.11 or later is needed; name it with make PYTHON=...")'
	@echo "installing the packages of environment.txt into .venv, once: some minutes …"
	$(PYTHON) -m venv --clear .venv
	$(BIN)/python -m pip install --no-deps --no-compile -r environment.txt
	$(BIN)/python -m pip install --quiet --no-deps --no-build-isolation --editable .
	cd .venv/lib/python3.* && printf "%s\n" "$(CURDIR)/notebooks" "$(CURDIR)/book" > site-packages/pages.pth
	touch $@

clean:
	rm -rf .venv .cache _build build dist book/chapters .pytest_cache .mypy_cache .ruff_cache .benchmarks .hypothesis \
	    *.egg-info
