// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/compat/mrpt_compat.h>
#include <fastlio/compat/newer_points_maps.h>
#include <fastlio/compat/point_map_stream.h>

#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/serialization/CArchive.h>

#include <iostream>
#include <memory>

#if !FASTLIO_MRPT_READS_NEWER_POINTS

namespace fastlio
{
namespace
{
using mrpt::serialization::CArchive;

constexpr std::uint8_t kSimpleVersion = 10;
constexpr std::uint8_t kIntensityVersion = 0;

/** CSimplePointsMap but for reading: not in its run-time class, so that it is saved as one. */
class SimplePointsReader : public mrpt::maps::CSimplePointsMap
{
 protected:
  void serializeFrom(CArchive& in, std::uint8_t version) override
  {
    if (version != kSimpleVersion)
    {
      CSimplePointsMap::serializeFrom(in, version);
      return;
    }
    constexpr const char* kName = "CSimplePointsMap";
    const auto length = in.ReadAs<std::uint32_t>();
    m_x = readColumn<mrpt::aligned_std_vector<float>>(in, length, kName);
    m_y = readColumn<mrpt::aligned_std_vector<float>>(in, length, kName);
    m_z = readColumn<mrpt::aligned_std_vector<float>>(in, length, kName);
    in >> genericMapParams;
    insertionOptions = readInsertionOptions(in, kName);
    likelihoodOptions.readFromStream(in);
    renderOptions.readFromStream(in);
    mark_as_modified();
  }
};

/** The same for CPointsMapXYZI. */
class IntensityPointsReader : public mrpt::maps::CPointsMapXYZI
{
 protected:
  void serializeFrom(CArchive& in, std::uint8_t version) override
  {
    if (version != kIntensityVersion)
    {
      CPointsMapXYZI::serializeFrom(in, version);
      return;
    }
    constexpr const char* kName = "CPointsMapXYZI";
    const auto length = in.ReadAs<std::uint32_t>();
    m_x = readColumn<mrpt::aligned_std_vector<float>>(in, length, kName);
    m_y = readColumn<mrpt::aligned_std_vector<float>>(in, length, kName);
    m_z = readColumn<mrpt::aligned_std_vector<float>>(in, length, kName);
    m_intensity = readColumn<mrpt::aligned_std_vector<float>>(in, length, kName);
    insertionOptions = readInsertionOptions(in, kName);
    likelihoodOptions.readFromStream(in);
    mark_as_modified();
  }
};

/** MRPT warns when a class gets another reader, which is done here on purpose. */
class WithoutWarnings
{
 public:
  WithoutWarnings() : errors_(std::cerr.rdbuf(nullptr)) {}
  ~WithoutWarnings()
  {
    std::cerr.rdbuf(errors_);
    std::cerr.clear();
  }
  WithoutWarnings(const WithoutWarnings&) = delete;
  WithoutWarnings& operator=(const WithoutWarnings&) = delete;

 private:
  std::streambuf* errors_;
};

template <typename Reader>
void readWith(const mrpt::rtti::TRuntimeClassId* native)
{
  static mrpt::rtti::TRuntimeClassId id = *native;
  // A function in some versions of MRPT, a pointer to one in others.
  id.ptrCreateObject = []() -> std::shared_ptr<mrpt::rtti::CObject>
  { return std::make_shared<Reader>(); };
  mrpt::rtti::registerClassCustomName(native->className, &id);
}
}  // namespace

void registerNewerPointsMaps()
{
  const WithoutWarnings quiet;
  readWith<SimplePointsReader>(CLASS_ID(mrpt::maps::CSimplePointsMap));
  readWith<IntensityPointsReader>(CLASS_ID(mrpt::maps::CPointsMapXYZI));
}

}  // namespace fastlio

#else

void fastlio::registerNewerPointsMaps() {}

#endif
