# Everything a new machine needs: make, python3, a C++ compiler, and these two words.
#   make demo   install into .venv and check an example node
#   make test   the whole test suite, live tests with real rclpy included

PYTHON ?= python3
VENV := .venv
# Real rclpy from PyPI, an environment for each distribution.
JAZZY := .venv-jazzy
KILTED := .venv-kilted
RELEASE := .venv-release
BIN := $(VENV)/bin
# mypy does not know setuptools' package-dir: it is shown the installed layout by links.
TYPES := build/types
PIP_FLAGS ?= --quiet --disable-pip-version-check
# Thousands of tests start the command, and without bytecode each start compiles it anew: 0.5 s of 0.8.
unexport PYTHONDONTWRITEBYTECODE
pytest_with = ROS2CC_RCLPY_PYTHON=$(CURDIR)/$(1)/bin/python $(BIN)/python -m pytest

.PHONY: demo quick test test-long texts slices shapes waits why confirm explore random-waits random-systems conformance releases rclpy-tests attack wheels release-check dependencies pythons lint schema site paper screenshot clean enter

demo: $(VENV)/installed
	$(BIN)/ros2cc-extract launch_free_examples/service_deadlock/node.py || test $$? = 1

# Before each commit: lint, types, and the tests of single modules, which need no ROS; some 40 s.
quick: lint
	$(BIN)/python -m pytest -q -n auto -m 'not slow and not live' $(QUICK) $(PYTEST_FLAGS)
QUICK ?= tests/architecture tests/unit/findings tests/unit/generator tests/unit/report tests/unit/spec tests/unit/cli

# The whole suite with Jazzy; before it, that source and live run agree on Kilted too.
test: $(VENV)/developed $(JAZZY)/installed $(KILTED)/installed
	$(call pytest_with,$(KILTED)) -q -n auto tests/live/test_live_examples_hold.py -k static_and_live
	ROS2CC_KILTED_PYTHON=$(CURDIR)/$(KILTED)/bin/python $(call pytest_with,$(JAZZY)) $(SHARED) $(PYTEST_FLAGS)
# Each worker has files as a whole, whose tests share what they are about, until one has none left.
SHARED := -n auto --dist worksteal

# Random comparisons in the numbers of record, hours on the pure Python checker; before them all
# live tests on Kilted, after them the examples of hypothesis drawn anew.
test-long: $(VENV)/developed $(JAZZY)/installed $(KILTED)/installed
	$(call pytest_with,$(KILTED)) -n auto -m 'slow or not slow' tests/live
	$(call pytest_with,$(JAZZY)) -m slow $(PYTEST_FLAGS)
	$(call pytest_with,$(JAZZY)) -n auto --hypothesis-profile=new tests/property tests/unit
	$(MAKE) texts

# Plain and compact texts of random units: the same verdicts. Goes on where it was cut.
UNITS ?= 2000
compare_texts = $(BIN)/python tests/property/compared_texts.py $(1) --units $(UNITS) --record build/texts_$(1).jsonl
texts: $(VENV)/developed
	@mkdir -p build
	$(call compare_texts,paper) --reduced-states 100000000 --memory-mb 8000
	$(call compare_texts,rclpy)

# Slices of random units of every kind of entity: the verdicts of the whole. Goes on where it was cut.
slices: $(VENV)/developed
	@mkdir -p build
	$(BIN)/python tests/property/compared_slices.py --units $(UNITS) --record build/slices.jsonl

# Random node programs on real executors of both distributions: each trace a path of its model.
PROGRAMS ?= 1000
# Seeds from which on all programs run on the EventsExecutor: tests/conformance/programs.py.
ON_EVENTS ?= --first 10000000 --programs 300
conformance: $(VENV)/developed $(JAZZY)/installed $(KILTED)/installed
	$(BIN)/python -m tests.conformance.suite --python $(JAZZY)/bin/python --programs $(PROGRAMS)
	$(BIN)/python -m tests.conformance.suite --python $(KILTED)/bin/python --programs $(PROGRAMS)
	$(BIN)/python -m tests.conformance.suite --python $(JAZZY)/bin/python $(ON_EVENTS)
	$(BIN)/python -m tests.conformance.suite --python $(KILTED)/bin/python $(ON_EVENTS)
	$(BIN)/python -m tests.conformance.three --python $(JAZZY)/bin/python
	$(BIN)/python -m tests.conformance.three --python $(KILTED)/bin/python

# On releases that are no wheel, RELEASES="7.1.11 11.0.0" some of them: random programs, every row of
# the table of behaviours, every blocking pattern. ROS2CC_RELEASES is a folder with a program that
# builds them, and without it they are skipped. Each day one of them has its turn in `make test`.
# Of CORES only the executor core is there.
RELEASES ?= 3.3.21 7.1.11 9.1.5 10.0.10 11.0.0
CORES ?= 3.3.10 7.1.9
releases: $(VENV)/developed $(JAZZY)/installed $(KILTED)/installed
	$(BIN)/python -m tests.conformance.releases $(RELEASES) $(CORES)
	for release in $(RELEASES) $(CORES); do ROS2CC_RELEASE=$$release \
	    $(call pytest_with,$(JAZZY)) tests/releases tests/live/test_live_blocking.py \
	    -k 'of_the_day or table_of_releases' || exit 1; done

# Every shape of waiting and ending of docs/waits.md, on both distributions.
observe_on = $(BIN)/python -m tests.shapes.observe --python .venv-$(1)/bin/python --as $(1)
shapes: $(VENV)/developed $(JAZZY)/installed $(KILTED)/installed
	$(call observe_on,jazzy) $(SHAPES)
	$(call observe_on,kilted) $(SHAPES)
	$(BIN)/python -m pytest -q -m 'slow or not slow' tests/shapes

# What `why` says of every blocking pattern and of random programs, on both distributions; none that
# goes on is a deadlock.
why: $(VENV)/developed $(JAZZY)/installed $(KILTED)/installed
	$(BIN)/python -m tests.live.standing $(CURDIR)/$(JAZZY)/bin/python
	$(BIN)/python -m tests.live.standing $(CURDIR)/$(KILTED)/bin/python
	$(BIN)/python -m tests.live.standing $(CURDIR)/$(JAZZY)/bin/python --hooked
	$(BIN)/python -m tests.live.moments $(CURDIR)/$(JAZZY)/bin/python 200
	$(BIN)/python -m tests.live.moments $(CURDIR)/$(KILTED)/bin/python 200

# What `confirm` says of every node here that has a finding, and of its good twin; no twin is confirmed.
confirm: $(VENV)/developed $(JAZZY)/installed
	@mkdir -p build
	$(BIN)/python -m tests.confirm.table --python $(CURDIR)/$(JAZZY)/bin/python --record build/confirm_jazzy.jsonl

# Nodes with a race or a rare hang: schedules to the failure against plain repetition, and replays.
explore: $(VENV)/developed $(JAZZY)/installed
	@mkdir -p build
	$(BIN)/python -m tests.explore.table --python $(CURDIR)/$(JAZZY)/bin/python --record build/explore_jazzy.jsonl

# 300 entries into a process that allocates, loads C modules, makes entities and keeps the interpreter,
# on both distributions: none of its threads stands, and nothing of ours is left in it.
ENTRIES ?= 300
enter: $(VENV)/developed $(JAZZY)/installed $(KILTED)/installed
	$(BIN)/python -m tests.live.entries $(CURDIR)/$(JAZZY)/bin/python $(ENTRIES)
	$(BIN)/python -m tests.live.entries $(CURDIR)/$(KILTED)/bin/python $(ENTRIES)

# What the table of shapes excuses, asked anew, and docs/waits.md from it.
waits: $(VENV)/developed
	$(BIN)/python -m tests.shapes.renew
	$(BIN)/python -m tests.shapes.page

# Random programs that wait, on both distributions: who hangs is never said to end. They run first,
# then all are judged, and whom the model calls stuck runs once more with pauses. Goes on where it
# was cut.
waits_suite = $(BIN)/python -m tests.random_waits.suite --programs $(PROGRAMS)
waits_record = build/random_waits_$(1).jsonl
random_waits_on = $(waits_suite) --python $(1)/bin/python --record $(call waits_record,$(2)) && \
	$(waits_suite) --python $(1)/bin/python --judge $(call waits_record,$(2)) $(3)
random-waits: $(VENV)/developed $(JAZZY)/installed $(KILTED)/installed
	@mkdir -p build
	$(call random_waits_on,$(JAZZY),jazzy)
	$(call random_waits_on,$(KILTED),kilted,--known $(call waits_record,jazzy))

# Random systems of two to four processes on Jazzy: one that hung is never satisfied, and what its parts
# say is what one network of all says. Goes on where it was cut.
SYSTEMS ?= 1000
COMPARED ?= 2000
random-systems: $(VENV)/developed $(JAZZY)/installed
	@mkdir -p build
	$(BIN)/python -m tests.random_systems.suite --python $(JAZZY)/bin/python --systems $(SYSTEMS) \
	    --record build/random_systems.jsonl
	$(BIN)/python -m tests.random_systems.suite --unrun --systems $(COMPARED) \
	    --record build/random_systems_compared.jsonl

# rclpy's own tests with the hook and without, from a checkout of the version that ROS holds.
ROS ?= $(JAZZY)
rclpy-tests: $(VENV)/developed $(ROS)/installed
	$(ROS)/bin/python -m pip install $(PIP_FLAGS) pytest typing_extensions
	$(BIN)/python scripts/rclpy-tests --python $(ROS)/bin/python $(RCLPY)

# Mutated scanner cases: 2,000 in continuous integration, 100,000 before a release.
FUZZ_RUNS ?= 2000
fuzz: $(VENV)/developed
	$(BIN)/python scripts/fuzz-scanner --runs $(FUZZ_RUNS)

# The same texts, chosen by atheris as coverage grows.
fuzz-guided: $(VENV)/developed
	$(BIN)/python -m pip install $(PIP_FLAGS) -e '.[fuzz]'
	$(BIN)/python scripts/fuzz-scanner --runs $(FUZZ_RUNS) --atheris

# Texts for each other parser, chosen by atheris: an hour each before a release.
FUZZ_SECONDS ?= 3600
fuzz-parsers: $(VENV)/developed
	$(BIN)/python -m pip install $(PIP_FLAGS) -e '.[fuzz]'
	$(BIN)/python scripts/fuzz-parsers --seconds $(FUZZ_SECONDS)

# What strangers may do to us, in the numbers of record: hostile files, caches, repositories, users,
# signals and environments; a table at the end says how many of each class, and what gave way.
ATTACKS ?= 5000
# Of a class: a test that takes longer ends all, and the table is lost.
ATTACK_SECONDS ?= 7200
attack: $(VENV)/developed $(JAZZY)/installed
	$(call pytest_with,$(JAZZY)) -m 'slow or not slow' --timeout $(ATTACK_SECONDS) tests/attack \
	    --at-least $(ATTACKS) $(PYTEST_FLAGS)

lint: $(VENV)/developed
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	@rm -rf $(TYPES) && mkdir -p $(TYPES)/ros2cc_extract
	@ln -s $(CURDIR)/ros2cc_extract/* $(CURDIR)/generator $(TYPES)/ros2cc_extract/
	cd $(TYPES) && $(CURDIR)/$(BIN)/mypy --config-file $(CURDIR)/pyproject.toml

# The publication from our own tools: docs/paper.md and its picture.
paper: $(VENV)/developed $(JAZZY)/installed
	$(BIN)/python -m pip install $(PIP_FLAGS) -e '.[bench]'
	ROS2CC_RCLPY_PYTHON=$(CURDIR)/$(JAZZY)/bin/python $(BIN)/python benchmarks/paper.py

# dist/: sources, and wheels for each CPython that is here or in Debian's packages, on glibc and musl, x86-64
# and aarch64; audited, installed where no compiler is, and their tests run (aarch64 by qemu-user-static).
WHEELS ?= dist
release_with = $(RELEASE)/bin/python -m release.$(1)
wheels: $(RELEASE)/prepared
	$(call release_with,wheels) -o $(WHEELS)
	$(call release_with,audit) $(WHEELS)
	$(call release_with,trial) $(WHEELS)

# All that a release needs and that can be done without publishing; RELEASE_CHECK=--unreleased before
# its changelog is.
release-check: wheels dependencies
	$(call release_with,check) $(RELEASE_CHECK) $(WHEELS)

# Tests with the lowest versions of all dependencies on the lowest CPython here, and the newest on the newest.
dependencies: $(RELEASE)/prepared
	$(call release_with,dependencies)

# The wheels on each CPython, the extremes first: an example, --diff-base, the suite without ROS; some
# 20 minutes of CPU each. PYTHONS="3.14 3.10" are some of them.
pythons: $(RELEASE)/prepared
	$(call release_with,pythons) --wheels $(WHEELS) $(PYTHONS)

schema: $(VENV)/installed
	$(BIN)/python -c 'import json; from ros2cc_extract.spec.yaml.yaml_io import SPEC; \
	  print(json.dumps(SPEC.schema, indent=2))' > ros2cc_extract/spec/yaml/schema.json

# docs/ as a site in build/site, strict; each node that it shows is checked anew, some 20 s of CPU.
site: $(VENV)/documented
	NO_MKDOCS_2_WARNING=1 $(BIN)/python -m mkdocs build --quiet
	@echo "look at it: python3 -m http.server --directory build/site"

rules: $(VENV)/installed
	$(BIN)/python scripts/write-rule-pages

# The pictures of the README and of the site, where there is a chromium.
screenshot: $(VENV)/installed
	$(BIN)/python scripts/draw-first-screen
	$(BIN)/python scripts/draw-report

# The published SARIF schema, with which a test validates ours; a 43 MB npm package carries it.
sarif-schema:
	mkdir -p .cache && cd .cache && npm pack --silent @microsoft/sarif-multitool-linux@5.7.0 > /dev/null
	cd .cache && tar xzf microsoft-sarif-multitool-linux-*.tgz --strip-components=1 package/sarif-2.1.0.json
	rm .cache/microsoft-sarif-multitool-linux-*.tgz

$(RELEASE)/prepared: $(RELEASE)/bin/python release/requirements.txt
	$(RELEASE)/bin/python -m pip install $(PIP_FLAGS) -r release/requirements.txt
	@touch $@

$(VENV)/bin/python:
	@./scripts/make-venv $(PYTHON) $(VENV)

$(JAZZY)/bin/python $(KILTED)/bin/python $(RELEASE)/bin/python:
	@./scripts/make-venv $(PYTHON) $(@:/bin/python=)

$(VENV)/installed: $(VENV)/bin/python pyproject.toml
	$(BIN)/python -m pip install $(PIP_FLAGS) -e .
	@touch $@

$(VENV)/documented: $(VENV)/bin/python pyproject.toml
	$(BIN)/python -m pip install $(PIP_FLAGS) -e '.[docs]'
	@touch $(VENV)/installed $@

$(VENV)/developed: $(VENV)/bin/python pyproject.toml
	$(BIN)/python -m pip install $(PIP_FLAGS) -e '.[dev]'
	@touch $(VENV)/installed $@

# What is native stands beside the sources already, made by the same Python.
.venv-%/installed: .venv-%/bin/python pyproject.toml | $(VENV)/developed
	ROS2CC_NATIVE_BUILD=none .venv-$*/bin/python -m pip install $(PIP_FLAGS) -e '.[$*]'
	@touch $@

clean:
	rm -rf $(VENV) $(JAZZY) $(KILTED) $(RELEASE) build dist *.egg-info
