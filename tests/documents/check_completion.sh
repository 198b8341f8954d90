#!/bin/bash
# mrpt_fastlio: completes command lines as bash does, and checks what is offered.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: check_completion.sh COMPLETION_FILE PROGRAMS_DIR
set -u
export PATH="$2:$PATH"
# shellcheck disable=SC1090
source "$1"
failures=0

# offers WORD... -- EXPECTED...: the completion of the last word has all that are expected.
offers() {
  COMP_WORDS=()
  while [ "$1" != -- ]; do COMP_WORDS+=("$1"); shift; done
  shift
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _mrpt_fastlio
  for expected in "$@"; do
    printf '%s\n' "${COMPREPLY[@]}" | grep -qxF -- "$expected" || {
      echo "FAILED: '${COMP_WORDS[*]}' does not offer '$expected' but: ${COMPREPLY[*]:0:20}"
      failures=$((failures + 1))
    }
  done
}

cd "$(mktemp -d)" && touch walk.rawlog
offers fastlio-replay --outp -- --output-dir --output-tum-path
offers fastlio-replay --set map. -- map.voxel_size= map.radius=
offers fastlio-replay --set thr -- threads=
offers fastlio-info --set lidar.m -- lidar.min_range= lidar.max_range=
offers fastlio-replay --export p -- ply planes
offers fastlio-replay --frame '' -- vehicle imu
offers fastlio-replay -v I -- INFO
offers fastlio-replay wa -- walk.rawlog
offers fastlio-sim o -- office open_area
offers fastlio-sim --scenario tu -- tunnel
offers fastlio-sim --set lidar.k -- lidar.kind=
offers fastlio-tune --met -- --method
offers fastlio-tune --method c -- cmaes
[ "$failures" -eq 0 ]
