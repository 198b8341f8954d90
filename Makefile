# mrpt_fastlio: one command each for the usual jobs; `make help` lists them.
# SPDX-License-Identifier: BSD-3-Clause
#
# The build itself is CMake: see CMakePresets.json for its variants.

PRESET ?= release
JOBS ?= $(shell nproc)
RECORDINGS ?=
DEMO_DIR ?= demo-output
SCENARIOS_DIR ?= scenarios-output
CALIBRATION_DIR ?= calibration-output
EXPERIMENTS_DIR ?= experiments-output
TUNE_DIR ?= tune-output
GROWTH_DIR ?= growth-output
PEERS_DIR ?=
MAP_DIR ?= map-output
MOLA_SOURCES ?=
FUZZ_SECONDS ?= 600

BUILD_DIR := build/$(PRESET)
# Tests are of the build that packages are made of, which is the same on every machine, unless a preset is given.
TEST_PRESET := $(if $(filter file,$(origin PRESET)),baseline,$(PRESET))
DEMO_PROGRAMS := fastlio-sim fastlio-replay fastlio-eval
TUNE_PROGRAMS := $(DEMO_PROGRAMS) fastlio-tune

.DEFAULT_GOAL := help
.PHONY: help dependencies test-dependencies lint-dependencies configure build test faults fuzz sanitize instructions \
  benchmark growth stage-costs peers demo replay scenarios calibration-table map-table tune-demo tune-proxy tune-effects \
  experiments docs format lint packages test-packages test-trixie test-mola test-mola-trixie clean

help:
	@echo "make demo    install what is missing, build, run the odometry on a simulated recording"
	@echo "make test    install what is missing, build, run every test"
	@echo "               RECORDINGS=DIR also tests on the recordings (NAME.rawlog + NAME.gt.tum) there"
	@echo "               PRESET=release|debug|asan|tsan tests another build than that for any machine"
	@echo "make faults  faults put into recordings, the table of docs/robustness.md; outages at every second"
	@echo "make fuzz    libFuzzer on everything that reads files   FUZZ_SECONDS=$(FUZZ_SECONDS) for each"
	@echo "make sanitize  every test with address and undefined-behaviour sanitizers, then with that of threads"
	@echo "make instructions  instructions of a fixed run against their budget (valgrind), in build/baseline"
	@echo "make benchmark  times of stages and of whole runs; RECORDINGS=DIR as above; see BENCHMARK.md"
	@echo "make growth  time per scan and memory over an hour, 10 km, points per scan and rates (20 minutes)"
	@echo "make peers RECORDINGS=DIR PEERS_DIR=DIR  error and time beside those of peers, whose clones are in PEERS_DIR"
	@echo "make stage-costs RECORDINGS=DIR  instructions and cache misses of each stage (valgrind)"
	@echo "make calibration-table  errors of realistic rigs before and after fastlio-calibrate"
	@echo "make map-table  errors of realistic rides before and after fastlio-map"
	@echo "make tune-demo  fastlio-tune makes a bad parameter file better, on simulated recordings"
	@echo "make tune-proxy  rank correlation of its proxy with true errors; RECORDINGS=DIR as above"
	@echo "make tune-effects  what each of ten keys does to the error, of four platforms"
	@echo "make scenarios  table of errors on every simulated scenario, through the programs"
	@echo "make experiments  the paper's experiments and the ablation; writes docs/experiments.md"
	@echo "make replay  install what is missing, build fastlio-replay and nothing else"
	@echo "make build   install what is missing, build            PRESET=release|baseline|debug|asan|tsan"
	@echo "make lint    check format, structure and clang-tidy"
	@echo "make format  format the sources"
	@echo "make docs    regenerate docs/parameters.md and params/*.yaml from the tables"
	@echo "make packages    Debian packages (runtime, dev, plugin) in build/packages/apt, a folder that apt reads"
	@echo "make test-packages  installs them in a clean Debian 12 root and runs them there (needs root)"
	@echo "make test-trixie builds and tests in a Debian 13 root, with MRPT 2.14 (needs root)"
	@echo "make test-mola MOLA_SOURCES=DIR   builds MOLA and our module, runs the real mola-cli; test-mola-trixie: in Debian 13"
	@echo "make clean   remove build/, $(DEMO_DIR)/, $(SCENARIOS_DIR)/, $(EXPERIMENTS_DIR)/, $(GROWTH_DIR)/ and $(TUNE_DIR)/"

dependencies:
	@cmake/install_dependencies.sh build

test-dependencies:
	@cmake/install_dependencies.sh build test

lint-dependencies:
	@cmake/install_dependencies.sh build lint

configure: dependencies
	cmake --preset $(PRESET) -DMRPT_FASTLIO_RECORDINGS_DIR="$(abspath $(RECORDINGS))"

build: configure
	cmake --build --preset $(PRESET) --parallel $(JOBS)

test: test-dependencies
	cmake --preset $(TEST_PRESET) -DMRPT_FASTLIO_BENCHMARKS=ON -DMRPT_FASTLIO_RECORDINGS_DIR="$(abspath $(RECORDINGS))"
	cmake --build --preset $(TEST_PRESET) --parallel $(JOBS)
	@test -n "$(RECORDINGS)" || echo "RECORDINGS is not given: tests on recordings will be skipped."
	ctest --preset $(TEST_PRESET) --parallel $(JOBS)

faults: test-dependencies
	cmake --preset $(TEST_PRESET) -DMRPT_FASTLIO_RECORDINGS_DIR="$(abspath $(RECORDINGS))"
	cmake --build --preset $(TEST_PRESET) --parallel $(JOBS) --target test_faults test_outages test_endurance test_rest \
	  test_given_recordings test_consistency test_online_calibration
	FASTLIO_EVERYTHING=1 build/$(TEST_PRESET)/tests/faults/test_faults
	FASTLIO_EVERYTHING=1 build/$(TEST_PRESET)/tests/outages/test_outages
	FASTLIO_EVERYTHING=1 build/$(TEST_PRESET)/tests/endurance/test_endurance
	FASTLIO_EVERYTHING=1 build/$(TEST_PRESET)/tests/rest/test_rest
	FASTLIO_EVERYTHING=1 build/$(TEST_PRESET)/tests/consistency/test_consistency --gtest_filter='*Realistic*'
	FASTLIO_EVERYTHING=1 build/$(TEST_PRESET)/tests/online_calibration/test_online_calibration
	FASTLIO_EVERYTHING=1 build/$(TEST_PRESET)/tests/recordings/test_given_recordings --gtest_filter='*Outage*'

fuzz:
	@cmake/install_dependencies.sh build fuzz
	cmake --preset fuzz
	cmake --build --preset fuzz --parallel $(JOBS) --target fuzzers
	tests/fuzz/run.sh build/fuzz $(FUZZ_SECONDS)

sanitize:
	$(MAKE) test PRESET=asan
	$(MAKE) test PRESET=tsan

instructions:
	@cmake/install_dependencies.sh build instructions
	cmake --preset baseline
	cmake --build --preset baseline --parallel $(JOBS) --target fastlio-fixed-run
	ctest --preset baseline --tests-regex instructions.budget

benchmark:
	@cmake/install_dependencies.sh build benchmark
	cmake --preset $(PRESET) -DMRPT_FASTLIO_BENCHMARKS=ON
	cmake --build --preset $(PRESET) --parallel $(JOBS) --target fastlio-benchmark fastlio-microbenchmark
	benchmarks/run.sh $(BUILD_DIR) $(RECORDINGS)

growth: configure
	cmake --build --preset $(PRESET) --parallel $(JOBS) --target fastlio-sim fastlio-replay
	benchmarks/growth.sh $(BUILD_DIR) $(GROWTH_DIR)

peers: configure
	@cmake/install_dependencies.sh build benchmark peers
	cmake --preset $(PRESET) -DMRPT_FASTLIO_BENCHMARKS=ON
	cmake --build --preset $(PRESET) --parallel $(JOBS) \
	  --target fastlio-replay fastlio-eval fastlio-benchmark fastlio-peer-input
	benchmarks/peers.sh $(BUILD_DIR) $(PEERS_DIR) $(wildcard $(RECORDINGS)/*.rawlog)

stage-costs:
	@cmake/install_dependencies.sh build benchmark instructions
	cmake --preset baseline -DMRPT_FASTLIO_BENCHMARKS=ON
	cmake --build --preset baseline --parallel $(JOBS) --target fastlio-benchmark
	benchmarks/stage_costs.sh build/baseline $(wildcard $(RECORDINGS)/*.rawlog)

replay: configure
	cmake --build --preset $(PRESET) --parallel $(JOBS) --target fastlio-replay
	@echo "Built: $(BUILD_DIR)/bin/fastlio-replay"

demo: configure
	cmake --build --preset $(PRESET) --parallel $(JOBS) --target $(DEMO_PROGRAMS)
	cmake/demo.sh $(BUILD_DIR) $(DEMO_DIR)

calibration-table: build
	benchmarks/calibration_table.sh $(BUILD_DIR) $(CALIBRATION_DIR)

map-table: build
	benchmarks/map_table.sh $(BUILD_DIR) $(MAP_DIR)

tune-demo: configure
	cmake --build --preset $(PRESET) --parallel $(JOBS) --target $(DEMO_PROGRAMS)
	JOBS=$(JOBS) cmake/tune_demo.sh $(BUILD_DIR) $(TUNE_DIR)/demo

tune-proxy: configure
	cmake --build --preset $(PRESET) --parallel $(JOBS) --target $(TUNE_PROGRAMS)
	JOBS=$(JOBS) benchmarks/tune_proxy.sh $(BUILD_DIR) $(TUNE_DIR)/proxy $(RECORDINGS)

tune-effects: configure
	cmake --build --preset $(PRESET) --parallel $(JOBS) --target $(TUNE_PROGRAMS)
	JOBS=$(JOBS) benchmarks/tune_effects.sh $(BUILD_DIR) $(TUNE_DIR)/effects

scenarios: build
	benchmarks/scenario_table.sh $(BUILD_DIR) $(SCENARIOS_DIR)

experiments: build
	benchmarks/experiments/all.sh $(BUILD_DIR) $(EXPERIMENTS_DIR)

docs: build
	MRPT_FASTLIO_REGENERATE=1 $(BUILD_DIR)/modules/config/test_config \
	  --gtest_filter="ConfigDocument.*:Presets.*"

format: lint-dependencies
	cmake/list_sources.sh | xargs clang-format -i

# Not of a build with precompiled headers, as clang cannot read those of g++, nor in unity units, which
# the compilation database names instead of the sources.
lint: lint-dependencies
	@cmake/install_dependencies.sh test benchmark
	cmake/list_sources.sh | xargs clang-format --dry-run --Werror
	tests/structure/check_structure.sh
	cmake --preset $(PRESET) -B build/lint -DMRPT_FASTLIO_PRECOMPILE=OFF -DMRPT_FASTLIO_UNITY=OFF \
	  -DMRPT_FASTLIO_BENCHMARKS=ON
	cmake/run_clang_tidy.sh build/lint $(JOBS)

packages:
	@cmake/install_dependencies.sh build packages
	cmake --preset baseline -DBUILD_TESTING=OFF -DCMAKE_INSTALL_PREFIX=/usr -B build/packages
	cmake --build build/packages --parallel $(JOBS)
	$(RM) build/packages/*.deb
	cd build/packages && cpack
	cmake/apt_folder.sh build/packages

test-packages: packages
	cmake/test_packages.sh build/packages build/bookworm

test-trixie:
	cmake/test_in_trixie.sh build/trixie

test-mola:
	cmake/install_dependencies.sh build mola
	cmake/test_mola.sh "$(MOLA_SOURCES)" build/mola || [ $$? -eq 77 ]

test-mola-trixie:
	cmake/test_in_trixie.sh build/trixie "$(MOLA_SOURCES)"

clean:
	$(RM) -r build $(DEMO_DIR) $(SCENARIOS_DIR) $(EXPERIMENTS_DIR) $(GROWTH_DIR) $(TUNE_DIR)
