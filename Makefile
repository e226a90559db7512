# Everything a new machine needs: python3, a C++ compiler, and these two words.
#   make demo   install into .venv and check an example node
#   make test   the whole test suite, live tests with real rclpy included

PYTHON ?= python3
VENV := .venv
JAZZY := .venv-jazzy
BIN := $(VENV)/bin
# mypy does not know setuptools' package-dir: it is shown the installed layout by links.
TYPES := build/types
PIP_FLAGS ?= --quiet --disable-pip-version-check

.PHONY: demo test test-long lint schema paper clean

demo: $(VENV)/installed
	$(BIN)/ros2cc-extract launch_free_examples/service_deadlock/node.py || test $$? = 1

test: $(VENV)/developed $(JAZZY)/installed
	ROS2CC_RCLPY_PYTHON=$(CURDIR)/$(JAZZY)/bin/python $(BIN)/python -m pytest -n auto $(PYTEST_FLAGS)

# Random comparisons in the numbers of record; hours on the pure Python checker.
test-long: $(VENV)/developed $(JAZZY)/installed
	ROS2CC_RCLPY_PYTHON=$(CURDIR)/$(JAZZY)/bin/python $(BIN)/python -m pytest -m slow $(PYTEST_FLAGS)

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

schema: $(VENV)/installed
	$(BIN)/python -c 'import json; from ros2cc_extract.spec.yaml_io import SPEC; \
	  print(json.dumps(SPEC.schema, indent=2))' > ros2cc_extract/spec/schema.json

rules: $(VENV)/installed
	$(BIN)/python scripts/write-rule-pages

# The published SARIF schema, with which a test validates ours; a 43 MB npm package carries it.
sarif-schema:
	mkdir -p .cache && cd .cache && npm pack --silent @microsoft/sarif-multitool-linux@5.7.0 > /dev/null
	cd .cache && tar xzf microsoft-sarif-multitool-linux-*.tgz --strip-components=1 package/sarif-2.1.0.json
	rm .cache/microsoft-sarif-multitool-linux-*.tgz

$(VENV)/bin/python:
	@./scripts/make-venv $(PYTHON) $(VENV)

$(JAZZY)/bin/python:
	@./scripts/make-venv $(PYTHON) $(JAZZY)

$(VENV)/installed: $(VENV)/bin/python pyproject.toml
	$(BIN)/python -m pip install $(PIP_FLAGS) -e .
	@touch $@

$(VENV)/developed: $(VENV)/bin/python pyproject.toml
	$(BIN)/python -m pip install $(PIP_FLAGS) -e '.[dev]'
	@touch $(VENV)/installed $@

$(JAZZY)/installed: $(JAZZY)/bin/python pyproject.toml
	$(JAZZY)/bin/python -m pip install $(PIP_FLAGS) -e '.[jazzy]'
	@touch $@

clean:
	rm -rf $(VENV) $(JAZZY) build dist *.egg-info
