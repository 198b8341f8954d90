#!/bin/sh
# mrpt_fastlio: the paper's outdoor experiment: a hand-held loop of 140 m that ends where it started.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: benchmarks/experiments/outdoor_loop.sh BUILD_DIR OUTPUT_DIR
. "$(dirname "$0")/library.sh"

header "outdoor loop"
variant "direct" campus campus ""
variant "features" campus campus "" features.mode=planar_and_edge
variant "direct, exact neighbours" campus campus "" map.type=knn
