# SPDX-License-Identifier: Apache-2.0
# The workspace's commands; each makes what it needs. `make help` lists them.

# A Python for which the ROS 2 wheels exist, if there is one.
PYTHON ?= $(shell for p in python3 python3.12 python3.13 python3.11 python3.10; do \
    "$$p" -c 'import sys; sys.exit(not (3, 10) <= sys.version_info[:2] <= (3, 13))' 2>/dev/null \
    && echo "$$p" && exit; done; echo python3)
# An environment elsewhere: make setup VENV=/other/place
VENV ?=
# Any ros2 command: make run ARGS='topic list'
ARGS ?=
COLCON_ARGS ?=
# A folder of wheels to use instead of PyPI: make setup WHEELS=/media/stick/wheels; `make mirror` fills it
WHEELS ?=
# Versions of Python for make mirror: PYTHONS='3.12 3.13'; all without it
PYTHONS ?=
export VENV WHEELS PYTHONS

SETUP := $(PYTHON) tools/setup
RUN := tools/foreground tools/in_environment

.DEFAULT_GOAL := help
.PHONY: help setup cluster mirror prepare build bringup demo run test check fix bench soak trials stories docs site pictures lock clean distclean

help: ## Show this list
	@echo 'The humanoid workspace. Each command makes what it needs.'
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/  make \1	\2/p' Makefile | expand -t 20

setup: ## Make the environment in .venv (VENV=/other/place keeps it elsewhere)
	@$(SETUP) setup

cluster: ## Add Ray to the environment, for sweeps on several machines
	@$(SETUP) cluster

mirror: ## Download all wheels into a folder for machines without internet (WHEELS=/path PYTHONS='3.12')
	@$(SETUP) mirror

prepare: export ASKED_FOR = $(ARGS)
prepare: # what bringup and run need: other messages, and what ARGS does not name, wait for setup
	@$(SETUP) prepare

build: ## Build src/ with colcon (COLCON_ARGS='--packages-select NAME')
	@$(SETUP) build $(COLCON_ARGS)

bringup: prepare ## Start the humanoid, print its page (ARGS='gui:=false'); Ctrl-C ends it
	@$(RUN) ros2 launch humanoid_bringup bringup.launch.py $(ARGS)

demo: export ASKED_FOR = full_system $(ARGS)
demo: ## Start everything: tell the robot what to do (ARGS='gui:=false'); Ctrl-C ends it
	@$(SETUP) prepare
	@$(RUN) ros2 launch humanoid_bringup full_system.launch.py $(ARGS)

run: prepare ## Run a ros2 command: make run ARGS='topic list'
	@$(RUN) ros2 $(ARGS)

test: build ## Run every test: all packages, then the tools
	@$(SETUP) tests
	@tools/in_environment --underlay python3 tools/test/run_all.py

check: setup ## Check format, lint and types
	@tools/in_environment --underlay ruff format --check . || { echo 'make fix formats them.'; exit 1; }
	@tools/in_environment --underlay ruff check .
	@for linter in ament_flake8 ament_pep257; do \
	  found=$$(tools/in_environment --underlay $$linter src 2>&1) || { echo "$$found"; exit 1; }; done
	@tools/in_environment --underlay mypy

fix: setup ## Format the code and mend what ruff can
	@tools/in_environment --underlay ruff format .
	@tools/in_environment --underlay ruff check --fix .

bench: build ## Measure what commands, launches, bags, transforms, RViz, physics, navigation, perception and planning cost
	@$(RUN) python3 tools/benchmarks/command_times.py $(ARGS)
	@$(RUN) python3 tools/benchmarks/launch_times.py $(ARGS)
	@$(RUN) python3 tools/benchmarks/prefork_times.py $(ARGS)
	@$(RUN) python3 tools/benchmarks/graph_times.py $(ARGS)
	@$(RUN) python3 tools/benchmarks/bag.py $(ARGS)
	@$(RUN) python3 tools/benchmarks/robot_state_publisher.py $(ARGS)
	@$(RUN) python3 tools/benchmarks/tf2_lookups.py $(ARGS)
	@$(RUN) python3 tools/benchmarks/rviz.py $(ARGS)
	@$(RUN) python3 tools/benchmarks/bringup_cost.py $(ARGS)
	@$(RUN) python3 tools/benchmarks/simulation.py $(ARGS)
	@$(RUN) python3 tools/benchmarks/gym_steps.py $(ARGS)
	@$(RUN) python3 tools/benchmarks/navigation.py $(ARGS)
	@$(RUN) python3 tools/benchmarks/perception.py $(ARGS)
	@$(RUN) python3 tools/benchmarks/compressed_images.py $(ARGS)
	@$(RUN) python3 tools/benchmarks/planner.py $(ARGS)

soak: build ## Let the humanoid walk for 20 minutes under bad conditions; an interrupted soak goes on
	@$(RUN) ros2 run humanoid_simulation sweep soak --output build/soak $(ARGS)

trials: build ## Let the humanoid walk into 200 obstacles
	@$(RUN) python3 tools/benchmarks/obstacle_trials.py $(ARGS)

stories: build ## Run the stories that take too long for make test
	@$(SETUP) tests
	@$(RUN) python3 -m pytest -p tools.test.stories -m story -o python_files='test_*.py story_*.py' \
	  src tools/test/story_*.py tools/underlay/*/test/story_*.py $(ARGS)

docs: build ## Write docs/reference anew from the code, the commands and the launch files
	@tools/in_environment python3 tools/reference/generate.py

site: ## Build the documentation as a site: open site/index.html
	@$(SETUP) site

pictures: build ## Take docs/pictures anew from running robots (needs Chromium; some: ARGS=apartment)
	@$(SETUP) tests
	@$(RUN) python3 tools/pictures/take.py $(ARGS)

lock: ## Pin the versions of tools/setup/requirements*.in anew (needs uv)
	@tools/setup/lock.sh $(ARGS)

clean: ## Delete what was built from src/, and the site
	@$(SETUP) clean

distclean: ## Delete the environment too
	@$(SETUP) distclean
