// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "bag_fields.h"

namespace fastlio
{
namespace
{
constexpr std::size_t kMostBagFields = 100;
}  // namespace

std::optional<BagFields> BagFields::parse(const std::uint8_t* data, std::size_t size)
{
  BagFields fields;
  while (size > 0)
  {
    if (size < sizeof(std::uint32_t) || fields.fields_.size() == kMostBagFields)
      return std::nullopt;
    const std::size_t length = littleAt<std::uint32_t>(data);
    data += sizeof(std::uint32_t);
    size -= sizeof(std::uint32_t);
    if (length > size) return std::nullopt;
    const std::string_view field(reinterpret_cast<const char*>(data), length);
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) return std::nullopt;
    fields.fields_.push_back({field.substr(0, equals), field.substr(equals + 1)});
    data += length;
    size -= length;
  }
  return fields;
}

std::optional<std::string_view> BagFields::text(std::string_view name) const
{
  for (const Field& field : fields_)
    if (field.name == name) return field.value;
  return std::nullopt;
}

std::optional<std::uint32_t> BagFields::number(std::string_view name) const
{
  const auto value = text(name);
  if (!value || value->size() != sizeof(std::uint32_t)) return std::nullopt;
  return littleAt<std::uint32_t>(value->data());
}

std::optional<BagOp> BagFields::op() const
{
  const auto value = text("op");
  if (!value || value->size() != 1) return std::nullopt;
  return static_cast<BagOp>(value->front());
}

}  // namespace fastlio
