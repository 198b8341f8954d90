# mrpt_fastlio: one row of an experiment's table: means over runs, largest APE max and p99.
# SPDX-License-Identifier: BSD-3-Clause
$1 == "run" { ++runs; next }
$2 == "null" { next }
{
  sum[$1] += $2
  if (!($1 in most) || $2 + 0 > most[$1]) most[$1] = $2 + 0
  ++count[$1]
}
$1 == "status" && $2 != "\"ok\"" {
  gsub(/"/, "", $0)
  sub(/^status /, "", $0)
  outcome = outcome (outcome == "" ? "" : ", ") $0
}
function mean(path, digits) {
  return path in sum ? sprintf("%." digits "f", sum[path] / count[path]) : "-"
}
function largest(path, digits) { return path in most ? sprintf("%." digits "f", most[path]) : "-" }
END {
  scans = sum["scans.with_pose"]
  points = scans > 0 ? sprintf("%.0f", sum["points.effective"] / scans) : "-"
  if (sum["scans.prediction_only"] > 0)
    outcome = outcome (outcome == "" ? "" : ", ") \
      sprintf("%.1f %% of scans unmatched", 100 * sum["scans.prediction_only"] / scans)
  printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", label,
    mean("ape.translation_m.rmse", 4), largest("ape.translation_m.max", 4),
    mean("end_to_end_drift.translation_m", 4), mean("end_to_end_drift.percent", 3),
    mean("ape.rotation_deg.rmse", 3), mean("nees.pose.mean", 1), points,
    mean("time.ms_per_scan.median", 2), largest("time.ms_per_scan.p99", 2),
    outcome == "" ? "ok" : outcome
}
