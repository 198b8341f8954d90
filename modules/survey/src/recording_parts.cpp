// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/math/time.h>
#include <fastlio/options/printable.h>
#include <fastlio/survey/recording_parts.h>
#include <fastlio/survey/sensor_selection.h>

#include <mrpt/core/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace fastlio
{
namespace
{
constexpr double kOpening = 2.0;  // enough to meet every LiDAR and IMU [s]
// Nobody stops a recording and starts the next one within a second.
constexpr double kLongestPause = 1.0;
// A file is cut by bytes: the last sensors to be written overlap the next file by a scan or two.
constexpr double kLongestOverlap = 0.3;
// The opening's fraction of the bytes gives the duration to within this factor.
constexpr double kDurationMargin = 10.0;
constexpr double kLongestRecording = 1e8;  // [s]: three years

/** How a recording begins. */
struct Opening
{
  std::set<std::string> sensors;  //!< class and label of LiDARs and IMUs; empty: no candidate
  std::int64_t first_ns = 0;
  std::int64_t likely_end_ns = 0;  //!< it does not end later than this
};

/** The stamps that LiDARs and IMUs of a survey cover. */
std::optional<std::pair<std::int64_t, std::int64_t>> coveredBy(const SensorSurvey& survey)
{
  std::int64_t first_ns = std::numeric_limits<std::int64_t>::max(), last_ns = 0;
  for (const SensorSummary& sensor : survey.sensors)
  {
    if (sensor.kind == SensorKind::Other) continue;
    first_ns = std::min(first_ns, sensor.first_stamp_ns);
    last_ns = std::max(last_ns, sensor.last_stamp_ns);
  }
  if (last_ns == 0) return std::nullopt;
  return std::pair{first_ns, last_ns};
}

bool canBeReadTwice(const std::string& file)
{
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) ||
         std::filesystem::is_directory(file, ignored);
}

Opening openingOf(const std::string& file)
{
  Opening opening;
  if (!canBeReadTwice(file)) return opening;
  RawlogSource source({file});
  SensorSurvey survey;
  bool at_end = true;
  while (const auto observation = source.next())
  {
    noteObservation(survey, *observation);
    const auto covered = coveredBy(survey);
    if (!covered || toSeconds(covered->second - covered->first) < kOpening) continue;
    at_end = false;
    break;
  }
  const auto covered = coveredBy(survey);
  if (!covered) return opening;
  for (const SensorSummary& sensor : survey.sensors)
    if (sensor.kind != SensorKind::Other)
      opening.sensors.insert(sensor.class_name + " " + sensor.label);
  const double share = source.progress().share();
  const double seconds = toSeconds(covered->second - covered->first);
  opening.first_ns = covered->first;
  const double likely =
      std::min(kDurationMargin * seconds / std::max(share, 1e-6), kLongestRecording);
  opening.likely_end_ns = at_end ? covered->second : covered->first + toNanoseconds(likely);
  return opening;
}

/** The pause until \a next_ns; nothing if there is none, or one that is too long. */
std::optional<double> pauseUntil(std::int64_t next_ns, const std::string& file)
{
  RawlogSource source({file});
  SensorSurvey survey;
  while (const auto observation = source.next())
  {
    noteObservation(survey, *observation);
    const auto covered = coveredBy(survey);
    if (covered && toSeconds(covered->second - next_ns) > kLongestOverlap) return std::nullopt;
  }
  const auto covered = coveredBy(survey);
  if (!covered) return std::nullopt;
  const double pause = toSeconds(next_ns - covered->second);
  if (pause > kLongestPause) return std::nullopt;
  return pause;
}

/** The stamps that a whole file covers. */
std::optional<std::pair<std::int64_t, std::int64_t>> coverageOf(const std::string& file)
{
  RawlogSource source({file});
  SensorSurvey survey;
  while (const auto observation = source.next())
    noteObservation(survey, *observation);
  return coveredBy(survey);
}

/** The file that may continue this one: the first that begins after it. */
std::optional<std::size_t> successorOf(std::size_t file, const std::vector<Opening>& openings)
{
  const Opening& opening = openings[file];
  std::optional<std::size_t> next;
  for (std::size_t i = 0; i < openings.size(); ++i)
  {
    if (openings[i].sensors != opening.sensors || openings[i].first_ns <= opening.first_ns)
      continue;
    if (!next || openings[i].first_ns < openings[*next].first_ns) next = i;
  }
  if (!next || toSeconds(openings[*next].first_ns - opening.likely_end_ns) > kLongestPause)
    return std::nullopt;
  return next;
}

/** The file that continues another one, and the pause between them. */
struct Continuation
{
  std::size_t file = 0;
  double pause = 0.0;
};

std::vector<std::optional<Continuation>> continuationsOf(const std::vector<std::string>& files)
{
  std::vector<Opening> openings;
  openings.reserve(files.size());
  for (const std::string& file : files)
    openings.push_back(openingOf(file));
  std::vector<std::optional<Continuation>> continuations(files.size());
  std::vector<bool> taken(files.size(), false);
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    const auto next = openings[i].sensors.empty() ? std::nullopt : successorOf(i, openings);
    if (!next || taken[*next]) continue;
    const auto pause = pauseUntil(openings[*next].first_ns, files[i]);
    if (!pause) continue;
    taken[*next] = true;
    continuations[i] = Continuation{*next, *pause};
  }
  return continuations;
}

std::vector<RecordingParts> joinedByStamps(const std::vector<std::string>& files)
{
  if (files.size() < 2) return {{files}};
  const auto continuations = continuationsOf(files);
  std::vector<bool> continues(files.size(), false);
  for (const auto& continuation : continuations)
    if (continuation) continues[continuation->file] = true;
  std::vector<RecordingParts> recordings;
  for (std::size_t first = 0; first < files.size(); ++first)
  {
    if (continues[first]) continue;
    RecordingParts parts{{files[first]}};
    for (auto next = continuations[first]; next; next = continuations[next->file])
    {
      parts.files.push_back(files[next->file]);
      parts.pauses.push_back(next->pause);
    }
    recordings.push_back(std::move(parts));
  }
  return recordings;
}
}  // namespace

void requireInOrder(const std::vector<std::string>& files)
{
  for (std::size_t i = 0; i + 1 < files.size(); ++i)
  {
    const std::string &file = files[i], &next = files[i + 1];
    const Opening first = openingOf(file), second = openingOf(next);
    if (first.sensors.empty() || second.sensors.empty()) continue;
    if (second.first_ns < first.first_ns)
      throw std::invalid_argument(mrpt::format(
          "'%s' begins %.3f s before '%s', which is given before it: give the parts of a recording "
          "in the order of time",
          printable(next).c_str(), toSeconds(first.first_ns - second.first_ns),
          printable(file).c_str()));
    const auto covered = coverageOf(file);
    const double overlap = covered ? toSeconds(covered->second - second.first_ns) : 0.0;
    if (overlap > kLongestOverlap)
      throw std::invalid_argument(mrpt::format(
          "'%s' and '%s' overlap by %.3f s, so that they are no parts of one recording: give each "
          "one by itself, or put what was recorded at the same time together with fastlio-import "
          "--merge",
          printable(file).c_str(), printable(next).c_str(), overlap));
  }
}

std::vector<RecordingParts> partsOf(const std::vector<std::string>& files, Joining joining)
{
  if (joining == Joining::ByStamps) return joinedByStamps(files);
  if (joining == Joining::Always)
  {
    requireInOrder(files);
    return {{files}};
  }
  std::vector<RecordingParts> recordings;
  recordings.reserve(files.size());
  for (const std::string& file : files)
    recordings.push_back({{file}});
  return recordings;
}

std::string describe(const RecordingParts& recording)
{
  if (recording.files.size() < 2) return {};
  std::string names = recording.files.front();
  for (std::size_t i = 0; i < recording.pauses.size(); ++i)
    names +=
        mrpt::format(", %s (%+.3f s later)", recording.files[i + 1].c_str(), recording.pauses[i]);
  return "parts of one recording, joined: " + names + "; --no-join keeps them apart";
}

}  // namespace fastlio
