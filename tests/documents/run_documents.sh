#!/bin/bash
# mrpt_fastlio: runs every command of README.md and docs/, or holds it against the test that does.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: run_documents.sh SOURCE_DIR PROGRAMS_DIR EXAMPLE_RECORDINGS WORK_DIR
#
# Commands are the indented lines and the lines of ```sh blocks that begin with the name of a program. Those of make name a
# target of the Makefile; those of tests/documents/run_elsewhere.txt are run by the test that is named there, or not at all
# for the reason that is given; all others are run here, those of a page in a new folder with the files that they name.
# Simulations and searches are cut short.
set -euo pipefail

source_dir=$(realpath "$1"); programs=$(realpath "$2"); example_recordings=$(realpath "$3"); work=$4
here=$source_dir/tests/documents
rm -rf "$work" && mkdir -p "$work/shims" "$work/files" && cd "$work"
work=$PWD

# shim NAME: a program of that name, with the script of the standard input.
shim() { cat >"shims/$1"; chmod +x "shims/$1"; }
shim fastlio-sim <<END
#!/bin/bash
case " \$* " in *--list*|*--duration*) ;; *) set -- "\$@" --duration 3 ;; esac
exec "$programs/fastlio-sim" "\$@"
END
shim fastlio-tune <<END
#!/bin/bash
arguments=(); next=
for argument; do
  [ "\$next" = --budget ] && argument=4
  arguments+=("\$argument"); next=\$argument
done
case " \$* " in *--budget*|*--work*|*--status*) ;; *) arguments+=(--budget 4) ;; esac
"$programs/fastlio-tune" "\${arguments[@]}"
status=\$?
# 2 and 3: the parameters that were given are kept.
[ "\$status" -eq 2 ] || [ "\$status" -eq 3 ] && status=0
exit "\$status"
END
shim fastlio-calibrate <<END
#!/bin/bash
"$programs/fastlio-calibrate" "\$@" --passes 2
status=\$?
# 6: on data that it was not fitted to, the result is not better. The default rig is right.
[ "\$status" -eq 6 ] && status=0
exit "\$status"
END
shim sbatch <<'END'
#!/bin/bash
bash -n <(tee job.sh) && grep -q '^#SBATCH' job.sh
END
shim parallel <<'END'
#!/bin/bash
exec bash -e
END
export PATH=$work/shims:$programs:$PATH

make_files() {
  local seed=1 name
  for name in walk walk_1 walk_2 walk_3 a b c monday tuesday; do
    case $name in *day) set -- --duration 15 ;; *) set -- --duration 6 ;; esac
    fastlio-sim office --seed $seed "$@" --output-dir ../simulated --quiet
    cp ../simulated/recording.rawlog "$name.rawlog"
    cp ../simulated/ground_truth.tum "$name.gt.tum"
    seed=$((seed + 1))
  done
  # Parts of one recording follow each other.
  fastlio-import walk_1.rawlog -o part.rawlog --split-time 3 --quiet
  mv part_001.rawlog part1.rawlog
  mv part_002.rawlog part2.rawlog
  rm -f part_0*.rawlog
  cp walk.gt.tum ground_truth.tum
  mkdir -p params && cp "$source_dir"/params/*.yaml params/
  awk '/^       ( )*[a-z_]+:/ { print substr($0, 8) }' "$source_dir/docs/tuning.md" >space.yaml
  awk '/^    name,map_x/ { rows = 1 } rows && !NF { exit } rows { print substr($0, 5) }' "$source_dir/docs/georeferencing.md" >points.csv
  cp params/velodyne_vlp16.yaml my.yaml
  local run
  for run in run_a run_b walk-run; do
    fastlio-replay walk.rawlog -o $run --frame imu --quiet
  done
  cp run_a/trajectory.tum trajectory.tum
  cp run_a/trajectory.tum other.tum
  cp run_a/covariance.csv .
  "$example_recordings" walk.rawlog .
  fastlio-import part1.rawlog -o drive_0.mcap >log.txt
  fastlio-import part2.rawlog -o drive_1.mcap >log.txt
}

# Each command of a page.
commands_of() {
  awk '
    /^```/ { fence = !fence; shell = $0 == "```sh"; next }
    fence && shell { print; next }
    !fence && /^    [^ ]/ { print substr($0, 5) }' "$1" |
    grep -E '^(fastlio-[a-z]+|make|cmake|git|sudo|apt|apt-get|grep|build/[^ ]+|sbatch|parallel) ' || true
}

fail() { echo "FAILED: $page: $command: $1" >&2; failures=$((failures + 1)); }

check_make() {
  local word
  for word in $command; do
    case $word in
      '#'*) break ;;
      make|*=*) ;;
      *) grep -q "^$word:" "$source_dir/Makefile" || fail "the Makefile has no target $word" ;;
    esac
  done
}

# In the folder of the page.
run() {
  local begin=$SECONDS
  echo "+ $command"
  if ! (cd page && bash -o pipefail -c "${command//build\/release\/bin\//}") </dev/null >log.txt 2>&1; then
    tail -20 log.txt
    fail "see above"
  fi
  ran=$((ran + 1))
  [ $((SECONDS - begin)) -lt 5 ] || echo "  $((SECONDS - begin)) s"
}

(cd files && make_files)
(cd "$programs/.." && ctest -N) >tests.txt
failures=0; ran=0; elsewhere=0; targets=0
cd "$source_dir"; pages=(README.md CONTRIBUTING.md BENCHMARK.md docs/*.md); cd "$work"
for page in "${pages[@]}"; do
  # Pages with runners of their own, of all their commands.
  case $page in docs/quick_start.md|docs/integration.md) continue ;; esac
  rm -rf page && cp -r files page
  case $page in  # what the page itself makes
    docs/import.md) rm page/walk.rawlog ;;
    docs/fastlio-info.md) rm page/my.yaml ;;
    docs/tuning.md) find page -name "??*.rawlog" -delete ;;  # three are enough
  esac
  while IFS= read -r command; do
    if test_name=$(awk -F ' @ ' -v c="$command" '$1 == c { print $2; found = 1 } END { exit !found }' "$here/run_elsewhere.txt"); then
      elsewhere=$((elsewhere + 1))
      [ "${test_name#not run: }" != "$test_name" ] || grep -qF " $test_name" tests.txt || fail "there is no test $test_name"
    elif [ "${command%% *}" = make ]; then
      targets=$((targets + 1))
      check_make
    else
      run
    fi
  done < <(commands_of "$source_dir/$page")
done
while IFS= read -r line; do
  command=${line%% @ *}
  (cd "$source_dir" && grep -qF "    $command" "${pages[@]}") ||
    { page=run_elsewhere.txt; fail "no page has it any more"; }
done <"$here/run_elsewhere.txt"
echo "$ran commands run, $elsewhere by other tests, $targets targets of make"
[ "$failures" -eq 0 ] && [ "$ran" -ge 30 ]
