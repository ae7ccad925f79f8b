# `make help` lists the targets. `make test` and `make reproduce` start from nothing but git and make.
SHELL := /bin/bash
.DEFAULT_GOAL := help

JOBS ?= $(shell nproc)
RESULTS ?= results
TIER ?= quick
ONLY ?= *
CLANG_FORMAT ?= clang-format
# Debian's Python packages are seen by Debian's Python only; another one may come first on the PATH.
PYTHON ?= /usr/bin/python3

INSTALL := .ci/install-packages
PBDCHECK := build/release/pbdcheck
SOURCES = $(shell git ls-files --cached --others --exclude-standard '*.h' '*.cpp')

# One thread for the linear algebra of the references: repeatable, and the experiments have threads of their own.
export OPENBLAS_NUM_THREADS := 1
export CMAKE_BUILD_PARALLEL_LEVEL := $(JOBS)
export CTEST_PARALLEL_LEVEL := $(JOBS)

.PHONY: help deps configure build test verify test-plots test-report mutants reproduce plots report first-figure asan debug format format-check tidy bench clean

help: ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  \1\t\2/p' $(firstword $(MAKEFILE_LIST)) | expand -t 16
	@echo "Variables: JOBS=$(JOBS) TIER=$(TIER) (quick or full) RESULTS=$(RESULTS) ONLY=$(ONLY) (rows of verify)"

deps: ## install what building and testing need
	@$(INSTALL) build

configure: deps ## configure build/release
	cmake --preset release

build: configure ## build the program and its tests
	cmake --build --preset release

test: build ## build, then run all tests
	ctest --preset release

verify: build ## measure the solver against known answers and baselines
	$(PBDCHECK) verify --only '$(ONLY)' --tier $(TIER) --threads $(JOBS) -o $(RESULTS)

test-plots: ## run the tests of the plots, the report and the planted faults
	@$(INSTALL) plots
	$(PYTHON) -m unittest discover --start-directory plots
	$(PYTHON) -m unittest discover --start-directory paper
	$(PYTHON) -m unittest discover --start-directory tests/mutants

# Works on a copy in build/mutants; goes on where it was interrupted.
mutants: deps ## plant faults one at a time and name the test that catches each (hours)
	@$(INSTALL) plots paper
	$(PYTHON) tests/mutants/mutants.py

# Without a report in RESULTS, one of made-up results is tested. test-plots runs this test, too, where a browser is installed.
test-report: ## test the report's page in a browser, without a window
	@$(INSTALL) plots browser
	$(PYTHON) paper/test_browser.py $(if $(wildcard $(RESULTS)/report.html),$(RESULTS))

# A failed verdict (exit code 1) is a result: it goes into the report, and make fails at the end.
reproduce: ## run every experiment, draw the figures, write the report
	@$(INSTALL) build plots pictures paper
	@$(MAKE) --no-print-directory build
	@status=0; $(PBDCHECK) run --all --tier $(TIER) -o $(RESULTS) || status=$$?; \
	if [ $$status -gt 1 ]; then exit $$status; fi; \
	$(MAKE) --no-print-directory report || exit; \
	exit $$status

plots: ## draw the figures of RESULTS
	@$(INSTALL) plots
	$(PYTHON) plots/render.py $(RESULTS)
	$(PYTHON) plots/make.py $(RESULTS)

report: plots ## write RESULTS/report.html and RESULTS/report.pdf
	@$(INSTALL) paper
	$(PYTHON) paper/report.py $(RESULTS)

first-figure: plots ## refresh the README's figure from RESULTS
	cp $(RESULTS)/figures/outer_convergence_map.svg paper/first-figure.svg

asan: deps ## run the tests under the address and undefined-behaviour sanitizers
	cmake --preset asan
	cmake --build --preset asan
	ctest --preset asan

debug: deps ## run the tests of a build without optimisation
	cmake --preset debug
	cmake --build --preset debug
	ctest --preset debug

format: ## format the C++ sources
	@$(INSTALL) format
	$(CLANG_FORMAT) -i $(SOURCES)

# Other versions than Debian 12's lay out some lines otherwise.
format-check: ## fail if a C++ source is not formatted (needs clang-format 14)
	@$(INSTALL) format
	@if $(CLANG_FORMAT) --version | grep -q 'version 14\.'; then $(CLANG_FORMAT) --dry-run --Werror $(SOURCES); \
	else echo "format-check skipped: needs clang-format 14, found $$($(CLANG_FORMAT) --version)"; fi

tidy: deps ## run clang-tidy over the C++ sources, several at once
	@$(INSTALL) tidy
	cmake --preset tidy
	cmake --build --preset tidy --target build_info
	$(PYTHON) "$$(command -v run-clang-tidy)" -quiet -j $(JOBS) -p build/tidy -checks=-bugprone-suspicious-include \
	  -extra-arg=-Wno-unknown-warning-option -extra-arg=-Wno-unused-command-line-argument \
	  "^$(CURDIR)/(build/tidy/)?(solver|reference|experiments|tests)/"

bench: build ## measure times; nothing else should run
	@$(INSTALL) bench
	cmake --preset release
	cmake --build --preset release --target kernels
	mkdir -p $(RESULTS)
	build/release/kernels --benchmark_out=$(RESULTS)/kernels.json --benchmark_out_format=json
	$(PBDCHECK) run work_precision effects_cost threads --tier $(TIER) --threads 1 -o $(RESULTS)

clean: ## remove the builds (results stay)
	rm -rf build
