// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "run_record.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace fastlio
{
namespace
{
using Json = nlohmann::json;

constexpr std::uintmax_t kLargestRecord = 100'000'000;  // [byte]: a longer one is none of ours

/** Takes "program" at the top, and "path" and "bytes" out of the objects in the array "outputs"
 * there. A whole document would ask for memory even while it is destroyed. */
class RecordReader : public nlohmann::json_sax<Json>
{
 public:
  explicit RecordReader(const std::string& key) : wanted_(key) {}

  [[nodiscard]] bool hasKey() const { return has_key_; }
  [[nodiscard]] const RunRecord& record() const { return record_; }

  bool null() override { return true; }
  bool boolean(bool /*value*/) override { return true; }
  bool number_integer(number_integer_t /*value*/) override { return true; }
  bool number_unsigned(number_unsigned_t value) override
  {
    if (inOutput() && key_ == "bytes") bytes_ = value;
    return true;
  }
  bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return true; }
  bool string(string_t& value) override
  {
    if (inOutput() && key_ == "path") path_ = value;
    if (depth_ == 1 && is_object_ && key_ == "program") record_.program = value;
    return true;
  }
  bool binary(binary_t& /*value*/) override { return true; }
  bool start_object(std::size_t /*elements*/) override
  {
    is_object_ = is_object_ || depth_ == 0;
    ++depth_;
    return true;
  }
  bool key(string_t& value) override
  {
    key_ = value;
    if (depth_ == 1 && is_object_)
    {
      top_key_ = value;
      has_key_ = has_key_ || value == wanted_;
    }
    return true;
  }
  bool end_object() override
  {
    if (inOutput() && path_ && bytes_) record_.outputs.push_back({*path_, *bytes_});
    path_.reset();
    bytes_.reset();
    --depth_;
    return true;
  }
  bool start_array(std::size_t /*elements*/) override
  {
    ++depth_;
    return true;
  }
  bool end_array() override
  {
    --depth_;
    return true;
  }
  bool parse_error(
      std::size_t /*position*/, const std::string& /*token*/,
      const Json::exception& /*error*/) override
  {
    return false;
  }

 private:
  /** In the top object, in its array "outputs", in an object of it. */
  [[nodiscard]] bool inOutput() const { return depth_ == 3 && top_key_ == "outputs"; }

  std::string wanted_, top_key_, key_;
  std::size_t depth_ = 0;
  bool is_object_ = false, has_key_ = false;
  std::optional<std::string> path_;
  std::optional<std::uintmax_t> bytes_;
  RunRecord record_;
};
}  // namespace

std::optional<RunRecord> readRunRecord(const std::string& path, const std::string& key)
{
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) > kLargestRecord)
    return std::nullopt;
  std::ifstream in(path, std::ios::binary);
  RecordReader reader(key);
  if (!Json::sax_parse(in, &reader) || !reader.hasKey()) return std::nullopt;
  return reader.record();
}

}  // namespace fastlio
