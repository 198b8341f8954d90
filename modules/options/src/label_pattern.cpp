// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/options/label_pattern.h>
#include <fastlio/options/printable.h>

#include <re2/re2.h>
#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr std::int64_t kPatternMemory = 1 << 20;  // [bytes]; "(lidar|imu)_[0-9]+" needs 3 kB

RE2::Options patternOptions()
{
  RE2::Options options;
  options.set_log_errors(false);  // they are reported by patternProblem()
  options.set_max_mem(kPatternMemory);
  options.set_encoding(RE2::Options::EncodingLatin1);  // a label may be any bytes
  return options;
}

std::optional<std::string> lengthProblem(const std::string& pattern)
{
  if (pattern.size() <= kLongestPattern) return std::nullopt;
  return "'" + printable(pattern) + "' has " + std::to_string(pattern.size()) +
         " characters, more than the " + std::to_string(kLongestPattern) +
         " that a pattern may have";
}

std::optional<std::string> syntaxProblem(const std::string& pattern, const RE2& compiled)
{
  if (compiled.ok()) return std::nullopt;
  return "'" + printable(pattern) + "' is not a regular expression (" +
         printable(compiled.error()) + ")";
}
}  // namespace

class LabelPattern::Matcher
{
 public:
  explicit Matcher(const std::string& pattern) : compiled_(pattern, patternOptions()) {}

  [[nodiscard]] const RE2& compiled() const { return compiled_; }

 private:
  RE2 compiled_;
};

std::optional<std::string> patternProblem(const std::string& pattern)
{
  if (auto problem = lengthProblem(pattern)) return problem;
  return syntaxProblem(pattern, RE2(pattern, patternOptions()));
}

LabelPattern::LabelPattern(const std::string& sensor, const std::string& pattern)
{
  if (pattern.empty()) return;
  auto problem = lengthProblem(pattern);
  if (!problem)
  {
    matcher_ = std::make_shared<const Matcher>(pattern);
    problem = syntaxProblem(pattern, matcher_->compiled());
  }
  if (problem)
    throw std::invalid_argument(
        "The " + sensor + " sensor label " + *problem +
        ". Escape special characters with a backslash, e.g. 'lidar\\(1\\)'.");
}

bool LabelPattern::matches(const std::string& label) const
{
  return matcher_ == nullptr || RE2::FullMatch(label, matcher_->compiled());
}

}  // namespace fastlio
