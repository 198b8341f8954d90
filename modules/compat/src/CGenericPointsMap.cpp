// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/compat/CGenericPointsMap.h>

#if !FASTLIO_MRPT_HAS_GENERIC_MAP

#include <fastlio/compat/point_map_stream.h>

IMPLEMENTS_SERIALIZABLE(CGenericPointsMap, CSimplePointsMap, mrpt::maps)

namespace
{
using mrpt::maps::CGenericPointsMap;
using mrpt::serialization::CArchive;

constexpr const char* kGenericName = "CGenericPointsMap";
constexpr std::uint8_t kNewest = 4, kWithoutUint32 = 3;

template <typename T>
CGenericPointsMap::Fields<T> readFields(CArchive& in, std::uint32_t points)
{
  CGenericPointsMap::Fields<T> fields;
  const auto count = in.ReadAs<std::uint32_t>();
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const std::string name = fastlio::readText(in, kGenericName);
    const auto length = in.ReadAs<std::uint32_t>();
    if (length != points)
      throw std::runtime_error(
          std::string(kGenericName) + ": field '" + name + "' has " + std::to_string(length) +
          " values for " + std::to_string(points) + " points; the stream is corrupt.");
    fields[name] = fastlio::readColumn<std::vector<T>>(in, length, kGenericName);
  }
  return fields;
}

template <typename T>
void writeFields(CArchive& out, const CGenericPointsMap::Fields<T>& fields)
{
  out << static_cast<std::uint32_t>(fields.size());
  for (const auto& [name, values] : fields)
  {
    out << name << static_cast<std::uint32_t>(values.size());
    if (!values.empty()) out.WriteBufferFixEndianness(values.data(), values.size());
  }
}

/** Values of \a from for the points that \a to has got behind \a begin; zeros in fields that one of
 * them lacks. */
template <typename T>
void append(
    CGenericPointsMap::Fields<T>& to, const CGenericPointsMap::Fields<T>& from, std::size_t begin,
    const std::vector<std::size_t>& points, std::size_t length)
{
  for (const auto& [name, values] : from)
  {
    auto& column = to[name];
    column.resize(length);
    for (std::size_t i = 0; i < points.size() && begin + i < length; ++i)
      column[begin + i] = values[points[i]];
  }
}
}  // namespace

namespace mrpt::maps
{
CGenericPointsMap& CGenericPointsMap::operator=(const CGenericPointsMap& other)
{
  if (this == &other) return *this;
  impl_copyFrom(other);
  copyFields(other);
  return *this;
}

template <typename Change>
void CGenericPointsMap::forEachField(Change change)
{
  const auto all = [&](auto& fields)
  {
    for (auto& [name, values] : fields)
      change(values);
  };
  all(float_fields);
  all(double_fields);
  all(uint16_fields);
  all(uint8_fields);
  all(uint32_fields);
}

void CGenericPointsMap::reserve(size_t new_length)
{
  CSimplePointsMap::reserve(new_length);
  forEachField([&](auto& values) { values.reserve(new_length); });
}

void CGenericPointsMap::resize(size_t new_length)
{
  CSimplePointsMap::resize(new_length);
  forEachField([&](auto& values) { values.resize(new_length); });
}

void CGenericPointsMap::setSize(size_t new_length)
{
  CSimplePointsMap::setSize(new_length);
  forEachField([&](auto& values) { values.assign(new_length, 0); });
}

void CGenericPointsMap::insertPointFast(float x, float y, float z)
{
  CSimplePointsMap::insertPointFast(x, y, z);
  forEachField([&](auto& values) { values.push_back(0); });
}

#if !FASTLIO_MRPT_COPIES_POINTS_ITSELF
void CGenericPointsMap::impl_copyFrom(const CPointsMap& other)
{
  CPointsMap::base_copyFrom(other);
  copyFields(other);
}
#endif

void CGenericPointsMap::copyFields(const CPointsMap& other)
{
  const auto* generic = dynamic_cast<const CGenericPointsMap*>(&other);
  const CGenericPointsMap none;
  const CGenericPointsMap& from = generic != nullptr ? *generic : none;
  float_fields = from.float_fields;
  double_fields = from.double_fields;
  uint16_fields = from.uint16_fields;
  uint8_fields = from.uint8_fields;
  uint32_fields = from.uint32_fields;
}

void CGenericPointsMap::addFrom_classSpecific(
    const CPointsMap& other, size_t previous_size, bool skip_points_at_zero)
{
  const std::size_t length = size();
  forEachField([&](auto& values) { values.resize(length); });
  const auto* from = dynamic_cast<const CGenericPointsMap*>(&other);
  if (from == nullptr) return;
  std::vector<std::size_t> taken;
  for (std::size_t i = 0; i < from->size(); ++i)
  {
    const bool at_zero = from->m_x[i] == 0 && from->m_y[i] == 0 && from->m_z[i] == 0;
    if (!skip_points_at_zero || !at_zero) taken.push_back(i);
  }
  append(float_fields, from->float_fields, previous_size, taken, length);
  append(double_fields, from->double_fields, previous_size, taken, length);
  append(uint16_fields, from->uint16_fields, previous_size, taken, length);
  append(uint8_fields, from->uint8_fields, previous_size, taken, length);
  append(uint32_fields, from->uint32_fields, previous_size, taken, length);
}

void CGenericPointsMap::internal_clear()
{
  CSimplePointsMap::internal_clear();
  float_fields.clear();
  double_fields.clear();
  uint16_fields.clear();
  uint8_fields.clear();
  uint32_fields.clear();
}

void CGenericPointsMap::PLY_import_set_vertex_count(size_t count)
{
  setSize(count);
}

// MRPT 2.15 knows versions up to 3.
uint8_t CGenericPointsMap::serializeGetVersion() const
{
  return uint32_fields.empty() ? kWithoutUint32 : kNewest;
}

void CGenericPointsMap::serializeTo(CArchive& out) const
{
  const std::size_t length = size();
  out << static_cast<std::uint32_t>(length);
  if (length != 0)
  {
    out.WriteBufferFixEndianness(m_x.data(), length);
    out.WriteBufferFixEndianness(m_y.data(), length);
    out.WriteBufferFixEndianness(m_z.data(), length);
  }
  writeFields(out, float_fields);
  writeFields(out, double_fields);
  writeFields(out, uint16_fields);
  writeFields(out, uint8_fields);
  if (serializeGetVersion() >= kNewest) writeFields(out, uint32_fields);
  insertionOptions.writeToStream(out);
  likelihoodOptions.writeToStream(out);
}

void CGenericPointsMap::serializeFrom(CArchive& in, uint8_t version)
{
  if (version > kNewest)
    throw std::runtime_error(
        std::string(kGenericName) + ": stream version " + std::to_string(version) +
        "; versions 0 to 4 are known.");
  internal_clear();
  mark_as_modified();
  const auto length = in.ReadAs<std::uint32_t>();
  using Coordinates = mrpt::aligned_std_vector<float>;
  m_x = fastlio::readColumn<Coordinates>(in, length, kGenericName);
  m_y = fastlio::readColumn<Coordinates>(in, length, kGenericName);
  m_z = fastlio::readColumn<Coordinates>(in, length, kGenericName);
  float_fields = readFields<float>(in, length);
  if (version >= 1) double_fields = readFields<double>(in, length);
  uint16_fields = readFields<std::uint16_t>(in, length);
  if (version >= 2) uint8_fields = readFields<std::uint8_t>(in, length);
  if (version >= 4) uint32_fields = readFields<std::uint32_t>(in, length);
  insertionOptions = fastlio::readInsertionOptions(in, kGenericName);
  likelihoodOptions.readFromStream(in);
}

}  // namespace mrpt::maps

#endif
