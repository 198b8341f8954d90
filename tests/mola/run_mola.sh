#!/bin/bash
# mrpt_fastlio: mola-cli replays a recording through our module: the trajectory is that of fastlio-replay, to the bit.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: run_mola.sh MOLA_PREFIX PROGRAMS_DIR MODULE_DIR LISTENER_DIR WORK_DIR [NEWER_DIR]
# NEWER_DIR: module and listener with interfaces that this MOLA does not have yet.
set -euo pipefail

prefix=$(realpath "$1"); programs=$(realpath "$2"); modules=$(realpath "$3"):$(realpath "$4"); work=$5
newer=${6:+$(realpath "$6")}
rm -rf "$work" && mkdir -p "$work" && cd "$work"
fail() { echo "FAILED: $1"; tail -n 30 mola.log; exit 1; }

"$programs/fastlio-sim" office --duration 12 -o simulated --quiet
mv simulated/recording.rawlog walk.rawlog
"$programs/fastlio-replay" walk.rawlog -o replay --set map.voxel_size=0.3 --export trajectory,simplemap --quiet

# launch NAME STOP_AFTER [LOAD]
launch() {
  cat >"$1.yaml" <<END
modules:
  - name: dataset
    type: mola::RawlogDataset
    execution_rate: 100
    params:
      rawlog_filename: '$PWD/walk.rawlog'
      time_warp_scale: 4.0
      read_all_first: false
  - name: odometry
    type: fastlio::MolaLidarInertialOdometry
    raw_data_source: dataset
    execution_rate: 50
    params:
      reference_frame: map
      map_every_n_scans: 10
      output_tum_path: '$PWD/$1.tum'
      odometry:
        map:
          voxel_size: 0.3
  - name: listener
    type: fastlio_test::MolaListener
    execution_rate: 20
    params:
      output: '$PWD/$1.txt'
      stop_after: $2
      load: '${3:-}'
END
  MOLA_MODULES_LIB_PATH=$modules:$prefix/lib LD_LIBRARY_PATH=$prefix/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} \
    timeout --signal=INT 120 "$prefix/bin/mola-cli" "$1.yaml" >mola.log 2>&1 || fail "mola-cli ended with $?"
}

launch whole 0
cmp whole.tum replay/trajectory.tum || fail 'the trajectory is not that of fastlio-replay'
[ "$(grep -c '^pose .* map ' whole.txt)" -eq "$(wc -l <replay/trajectory.tum)" ] || fail 'not every pose was advertised'
paste -d ' ' <(grep '^pose' whole.txt) replay/trajectory.tum | awk '
  { for (i = 3; i <= 5; ++i) { d = $i - $(i + 6); if (d < 0) d = -d; if (d > worst) worst = d }
    if ($7 <= 0) worst = 1 }
  END { exit !(NR > 50 && worst < 2e-6) }' || fail 'advertised poses are others, or have no covariance'
[ "$(awk '$1 == "map" && $2 > 1000' whole.txt | wc -l)" -ge 5 ] || fail 'the map does not arrive'

# Ended in the middle: what was sent is used, up to its last scan.
launch part 30
lines=$(wc -l <part.tum)
[ "$lines" -ge 30 ] && [ "$lines" -lt "$(wc -l <replay/trajectory.tum)" ] || fail "an early end gives $lines poses"
[ "$lines" -eq "$(grep -c '^pose' part.txt)" ] || fail 'poses of the end were not advertised'
# The last scan may reach beyond the inertial data that had come.
cmp <(head -n $((lines - 1)) part.tum) <(head -n $((lines - 1)) replay/trajectory.tum) ||
  fail 'an early end changes what came before'

# Interfaces that are newer than the kernel: the module and the listener are built with them once more.
if [ -n "${newer:-}" ]; then
  modules=$newer
  launch newer 0
  cmp newer.tum replay/trajectory.tum || fail 'with the newer interfaces the trajectory is another one'
  # One scan each, which ends at the keyframe.
  awk '$1 == "keyframe" { ++n; if ($6 != 1 || $7 <= 0.5 || $8 < 0.09 || $8 > 0.11 || $9 != "lidar_inertial_keyframes") bad = 1 }
    END { exit bad || n < 5 }' newer.txt || fail 'keyframes do not arrive, or are others'
  grep -q '^diagnostic 0 6 tracking$' newer.txt || fail 'the health is not told'
  grep -q '^saved 1 0$' newer.txt || fail 'the map is not saved, or nonsense is not refused'
  "$programs/fastlio-replay" walk.rawlog -o again --set map.voxel_size=0.3 --map-in newer.txt.metricmap --export trajectory --quiet ||
    fail 'the saved map is not one to start in'

  # A map is loaded in the middle, and the vehicle is pointed at: another trajectory begins, at the same places.
  launch loaded 0 "$PWD/newer.txt"
  grep -q '^loaded 1 0$' loaded.txt || fail 'the map is not loaded, or nonsense is not refused'
  grep -q 'does not use GNSS' mola.log || fail 'that GNSS does not help is not logged'
  before=$(wc -l <loaded_1.tum)
  [ "$before" -ge 50 ] || fail 'the poses before the map are lost'
  cmp loaded_1.tum <(head -n "$before" replay/trajectory.tum) || fail 'a map that is loaded changes what came before'
  [ "$((before + $(wc -l <loaded.tum)))" -eq "$(grep -c '^pose' loaded.txt)" ] || fail 'poses in the map were not advertised'
  # The offset of the clocks, which is estimated anew, moves the stamps by some microseconds.
  [ "$(wc -l <loaded.tum)" -ge 15 ] || fail 'the vehicle is not found in the map'
  paste -d ' ' loaded.tum <(tail -n "$(wc -l <loaded.tum)" replay/trajectory.tum) | awk '
    { d = ($2 - $10) ^ 2 + ($3 - $11) ^ 2 + ($4 - $12) ^ 2; t = ($1 - $9) ^ 2; if (t > 0.001 ^ 2 || d > 0.05 ^ 2) bad = 1 }
    END { exit bad }' || fail 'the vehicle is found elsewhere in the map'
  grep -q '^keyframe .* lidar_inertial_keyframes_1$' loaded.txt || fail 'keyframes do not go on in the map'
  echo "newer interfaces: $(grep -c '^keyframe' newer.txt) keyframes, health, map saved and loaded, vehicle found in it"
fi

# The tools of mp2p_icp, where they are (MRPT 2.11.5 and newer).
if [ -x "$prefix/bin/sm-cli" ]; then
  export LD_LIBRARY_PATH=$prefix/lib
  "$prefix/bin/sm-cli" info replay/keyframes.simplemap >mola.log 2>&1 || fail 'sm-cli'
  grep -qiE 'keyframes|size' mola.log || fail 'sm-cli says nothing of keyframes'
  cat >pipeline.yaml <<'END'
generators:
  - class_name: mp2p_icp_filters::Generator
    params:
      target_layer: 'raw'
      throw_on_unhandled_observation_class: false
      process_class_names_regex: '.*'
      process_sensor_labels_regex: '.*'
filters: []
END
  "$prefix/bin/sm2mm" -i replay/keyframes.simplemap -o map.mm -p pipeline.yaml >mola.log 2>&1 || fail 'sm2mm'
  [ "$(stat -c %s map.mm)" -gt 100000 ] || fail 'sm2mm made no map'
  echo 'sm-cli and sm2mm read the simplemap'
else
  echo 'mp2p_icp is not installed: sm-cli and sm2mm were not run'
fi
echo "mola-cli: $(wc -l <whole.tum) poses, as fastlio-replay"
