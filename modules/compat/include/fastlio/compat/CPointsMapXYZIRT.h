// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file CPointsMapXYZIRT.h The point map with intensity, ring and time of every point, on every
 * MRPT.
 *
 * MRPT has mrpt::maps::CPointsMapXYZIRT since 2.11.4. Older versions get a class of the same name
 * with the same stream format and the same accessors, so that recordings of newer versions can be
 * read, and written so that newer versions read them. */
#pragma once

#include <fastlio/compat/mrpt_compat.h>

#if FASTLIO_MRPT_HAS_XYZIRT
#include <mrpt/maps/CPointsMapXYZIRT.h>
#else

#include <mrpt/maps/CSimplePointsMap.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrpt::maps
{
/** Points [m] with intensity, ring and time [s, relative to the stamp of the observation that holds
 * the cloud; any sign]. Each of the three fields is either absent (empty) or as long as the map. */
class CPointsMapXYZIRT : public CSimplePointsMap
{
  DEFINE_SERIALIZABLE(CPointsMapXYZIRT, mrpt::maps)

 public:
  CPointsMapXYZIRT() = default;
  CPointsMapXYZIRT(const CPointsMapXYZIRT& other) = default;
  CPointsMapXYZIRT& operator=(const CPointsMapXYZIRT& other);
  ~CPointsMapXYZIRT() override = default;

  /** \name Buffers. reserve(), resize() and setSize() act on all six fields.
   * @{ */
  void reserve(size_t new_length) override;
  void resize(size_t new_length) override;
  void setSize(size_t new_length) override;
  void resize_XYZIRT(size_t new_length, bool has_intensity, bool has_ring, bool has_time);
  /** Appends a point; fields that are present grow by a zero. */
  void insertPointFast(float x, float y, float z = 0) override;
  /** x y z intensity ring time. */
  void getPointAllFieldsFast(size_t index, std::vector<float>& fields) const override;
  void setPointAllFieldsFast(size_t index, const std::vector<float>& fields) override;
  /** @} */

  /** \name Fields. Getters of an absent field return zero; setters of one throw std::out_of_range.
   * @{ */
  [[nodiscard]] bool hasIntensityField() const { return !m_intensity.empty(); }
  [[nodiscard]] bool hasRingField() const { return !m_ring.empty(); }
  [[nodiscard]] bool hasTimeField() const { return !m_time.empty(); }
  [[nodiscard]] float getPointIntensity(size_t index) const;
  [[nodiscard]] uint16_t getPointRing(size_t index) const;
  [[nodiscard]] float getPointTime(size_t index) const;
  void setPointIntensity(size_t index, float intensity) { m_intensity.at(index) = intensity; }
  void setPointRing(size_t index, uint16_t ring) { m_ring.at(index) = ring; }
  void setPointTime(size_t index, float time) { m_time.at(index) = time; }
  /** @} */

 protected:
  void impl_copyFrom(const CPointsMap& other) override;
  void addFrom_classSpecific(
      const CPointsMap& other, size_t previous_size, bool skip_points_at_zero) override;
  void internal_clear() override;
  void PLY_import_set_vertex_count(size_t count) override;

 private:
  mrpt::aligned_std_vector<float> m_intensity;
  mrpt::aligned_std_vector<uint16_t> m_ring;
  mrpt::aligned_std_vector<float> m_time;
};

}  // namespace mrpt::maps

#endif
