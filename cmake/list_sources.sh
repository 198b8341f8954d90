#!/bin/sh
# mrpt_fastlio: prints the C++ files of the project.
# SPDX-License-Identifier: BSD-3-Clause
set -eu
cd "$(dirname "$0")/.."
find modules apps plugins tests benchmarks docs -type f \( -name '*.cpp' -o -name '*.h' \) | sort
