// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/compat/CPointsMapXYZIRT.h>

#if !FASTLIO_MRPT_HAS_XYZIRT

#include <fastlio/compat/point_map_stream.h>

#include <mrpt/serialization/CArchive.h>

#include <stdexcept>
#include <string>

IMPLEMENTS_SERIALIZABLE(CPointsMapXYZIRT, CSimplePointsMap, mrpt::maps)

namespace
{
using mrpt::serialization::CArchive;

constexpr const char* kXyzirtName = "CPointsMapXYZIRT";

template <typename T>
mrpt::aligned_std_vector<T> readColumn(CArchive& in, std::uint32_t length)
{
  return fastlio::readColumn<mrpt::aligned_std_vector<T>>(in, length, kXyzirtName);
}

template <typename T>
mrpt::aligned_std_vector<T> readOptionalColumn(
    CArchive& in, std::uint32_t map_length, const char* name)
{
  const auto length = in.ReadAs<std::uint32_t>();
  if (length != 0 && length != map_length)
    throw std::runtime_error(
        "CPointsMapXYZIRT: field '" + std::string(name) + "' has " + std::to_string(length) +
        " values for " + std::to_string(map_length) + " points; the stream is corrupt.");
  return readColumn<T>(in, length);
}

// A field whose length fell behind (points added by code that knows coordinates only) is not
// written.
template <typename T>
void writeOptionalColumn(
    CArchive& out, const mrpt::aligned_std_vector<T>& column, std::size_t map_length)
{
  const std::size_t length = column.size() == map_length ? map_length : 0;
  out << static_cast<std::uint32_t>(length);
  if (length != 0) out.WriteBufferFixEndianness(column.data(), length);
}

template <typename T>
void growIfPresent(mrpt::aligned_std_vector<T>& column)
{
  if (!column.empty()) column.push_back(T{});
}
}  // namespace

namespace mrpt::maps
{
CPointsMapXYZIRT& CPointsMapXYZIRT::operator=(const CPointsMapXYZIRT& other)
{
  if (this != &other) impl_copyFrom(other);
  return *this;
}

void CPointsMapXYZIRT::reserve(size_t new_length)
{
  CSimplePointsMap::reserve(new_length);
  m_intensity.reserve(new_length);
  m_ring.reserve(new_length);
  m_time.reserve(new_length);
}

void CPointsMapXYZIRT::resize(size_t new_length)
{
  resize_XYZIRT(new_length, true, true, true);
}

void CPointsMapXYZIRT::setSize(size_t new_length)
{
  CSimplePointsMap::setSize(new_length);
  m_intensity.assign(new_length, 0.0F);
  m_ring.assign(new_length, 0);
  m_time.assign(new_length, 0.0F);
}

void CPointsMapXYZIRT::resize_XYZIRT(
    size_t new_length, bool has_intensity, bool has_ring, bool has_time)
{
  CSimplePointsMap::resize(new_length);
  m_intensity.resize(has_intensity ? new_length : 0);
  m_ring.resize(has_ring ? new_length : 0);
  m_time.resize(has_time ? new_length : 0);
}

void CPointsMapXYZIRT::insertPointFast(float x, float y, float z)
{
  CSimplePointsMap::insertPointFast(x, y, z);
  growIfPresent(m_intensity);
  growIfPresent(m_ring);
  growIfPresent(m_time);
}

void CPointsMapXYZIRT::getPointAllFieldsFast(size_t index, std::vector<float>& fields) const
{
  fields = {
      m_x[index],
      m_y[index],
      m_z[index],
      getPointIntensity(index),
      static_cast<float>(getPointRing(index)),
      getPointTime(index)};
}

void CPointsMapXYZIRT::setPointAllFieldsFast(size_t index, const std::vector<float>& fields)
{
  setPointFast(index, fields.at(0), fields.at(1), fields.at(2));
  if (hasIntensityField()) setPointIntensity(index, fields.at(3));
  if (hasRingField()) setPointRing(index, static_cast<uint16_t>(fields.at(4)));
  if (hasTimeField()) setPointTime(index, fields.at(5));
}

float CPointsMapXYZIRT::getPointIntensity(size_t index) const
{
  return m_intensity.empty() ? 0.0F : m_intensity.at(index);
}

uint16_t CPointsMapXYZIRT::getPointRing(size_t index) const
{
  return m_ring.empty() ? uint16_t{0} : m_ring.at(index);
}

float CPointsMapXYZIRT::getPointTime(size_t index) const
{
  return m_time.empty() ? 0.0F : m_time.at(index);
}

void CPointsMapXYZIRT::impl_copyFrom(const CPointsMap& other)
{
  CPointsMap::base_copyFrom(other);
  const auto* timed = dynamic_cast<const CPointsMapXYZIRT*>(&other);
  m_intensity = timed != nullptr ? timed->m_intensity : decltype(m_intensity){};
  m_ring = timed != nullptr ? timed->m_ring : decltype(m_ring){};
  m_time = timed != nullptr ? timed->m_time : decltype(m_time){};
}

void CPointsMapXYZIRT::addFrom_classSpecific(
    const CPointsMap& other, size_t previous_size, bool skip_points_at_zero)
{
  const auto* timed = dynamic_cast<const CPointsMapXYZIRT*>(&other);
  if (timed == nullptr)
  {
    // Zeros for the new points in the fields that this map has.
    resize_XYZIRT(size(), hasIntensityField(), hasRingField(), hasTimeField());
    return;
  }
  resize_XYZIRT(
      size(), hasIntensityField() || timed->hasIntensityField(),
      hasRingField() || timed->hasRingField(), hasTimeField() || timed->hasTimeField());
  std::size_t to = previous_size;
  for (std::size_t from = 0; from < timed->size() && to < size(); ++from)
  {
    const bool at_zero = timed->m_x[from] == 0 && timed->m_y[from] == 0 && timed->m_z[from] == 0;
    if (skip_points_at_zero && at_zero) continue;
    if (hasIntensityField()) setPointIntensity(to, timed->getPointIntensity(from));
    if (hasRingField()) setPointRing(to, timed->getPointRing(from));
    if (hasTimeField()) setPointTime(to, timed->getPointTime(from));
    ++to;
  }
}

void CPointsMapXYZIRT::internal_clear()
{
  CSimplePointsMap::internal_clear();
  m_intensity = {};
  m_ring = {};
  m_time = {};
}

void CPointsMapXYZIRT::PLY_import_set_vertex_count(size_t count)
{
  setSize(count);
}

uint8_t CPointsMapXYZIRT::serializeGetVersion() const
{
  return 0;
}

void CPointsMapXYZIRT::serializeTo(CArchive& out) const
{
  const std::size_t length = size();
  out << static_cast<std::uint32_t>(length);
  if (length != 0)
  {
    out.WriteBufferFixEndianness(m_x.data(), length);
    out.WriteBufferFixEndianness(m_y.data(), length);
    out.WriteBufferFixEndianness(m_z.data(), length);
  }
  writeOptionalColumn(out, m_intensity, length);
  writeOptionalColumn(out, m_ring, length);
  writeOptionalColumn(out, m_time, length);
  insertionOptions.writeToStream(out);
  likelihoodOptions.writeToStream(out);
}

void CPointsMapXYZIRT::serializeFrom(CArchive& in, uint8_t version)
{
  if (version != 0)
    throw std::runtime_error(
        "CPointsMapXYZIRT: stream version " + std::to_string(version) + "; version 0 is known.");
  mark_as_modified();
  const auto length = in.ReadAs<std::uint32_t>();
  m_x = readColumn<float>(in, length);
  m_y = readColumn<float>(in, length);
  m_z = readColumn<float>(in, length);
  m_intensity = readOptionalColumn<float>(in, length, "intensity");
  m_ring = readOptionalColumn<std::uint16_t>(in, length, "ring");
  m_time = readOptionalColumn<float>(in, length, "time");
  insertionOptions = fastlio::readInsertionOptions(in, kXyzirtName);
  likelihoodOptions.readFromStream(in);
}

}  // namespace mrpt::maps

#endif
