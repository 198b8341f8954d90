# mrpt_fastlio: horizontal and vertical error (rms) of a georeferenced map's trajectory on the earth.
# SPDX-License-Identifier: BSD-3-Clause
#
# Usage: awk -f earth_error.awk scenario.json summary.json ground_truth.tum covariance.csv
# scenario.json and the truth are of fastlio-sim: the origin of the truth is the datum in scenario.json.
function radians(degrees) { return degrees * atan2(0, -1) / 180 }

# From the datum of the simulation to that of the map.
function moved(name) { return datum[ARGV[2], name] - datum[ARGV[1], name] }

BEGIN {
  a = 6378137; e2 = 0.00669437999014  # WGS84
}

FILENAME == ARGV[1] || FILENAME == ARGV[2] {
  if ($0 ~ /"(latitude_deg|longitude_deg|height_m)"/) {
    split($0, part, /[":, ]+/)
    datum[FILENAME, part[2]] = part[3]
  }
  if ($0 ~ /"T_enu_map"/) numbers = 1
  if (numbers > 0 && numbers <= 12 && $1 ~ /^-?[0-9]/) pose[numbers++] = $1 + 0  # xyz, then the rotation by rows
  next
}

FILENAME == ARGV[3] {
  if ($1 ~ /^[0-9]/) { stamp[++truths] = $1; for (i = 0; i < 3; ++i) truth[truths, i] = $(i + 2) }
  next
}

FNR == 1 {
  latitude = radians(datum[ARGV[1], "latitude_deg"])
  w = sqrt(1 - e2 * sin(latitude) ^ 2)
  offset[0] = radians(moved("longitude_deg")) * a / w * cos(latitude)
  offset[1] = radians(moved("latitude_deg")) * a * (1 - e2) / w ^ 3
  offset[2] = moved("height_m")
  k = 1
}

/^[0-9]/ {
  split($0, field, ",")
  t = field[1] * 1e-9
  while (k < truths - 1 && stamp[k + 1] < t) ++k
  part_of = (t - stamp[k]) / (stamp[k + 1] - stamp[k])
  if (part_of < 0 || part_of > 1) next
  for (i = 0; i < 3; ++i) {
    true_i = truth[k, i] + part_of * (truth[k + 1, i] - truth[k, i])
    e[i] = offset[i] + pose[1 + i] - true_i
    for (j = 0; j < 3; ++j) e[i] += pose[4 + 3 * i + j] * field[2 + j]
  }
  horizontal += e[0] ^ 2 + e[1] ^ 2
  vertical += e[2] ^ 2
  ++n
}

END {
  if (n == 0) { print "- | -"; exit }
  printf "%.2f | %.2f\n", sqrt(horizontal / n), sqrt(vertical / n)
}
