// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

/** \file CGenericPointsMap.h The point map with any named fields, on every MRPT.
 *
 * MRPT has mrpt::maps::CGenericPointsMap since 2.15.0. Older versions get a class of the same name
 * that reads every version of its stream format and writes what newer versions read. With
 * MRPT 2.13.2 to 2.14 points of another map are appended without their fields, which are zero then.
 */
#pragma once

#include <fastlio/compat/mrpt_compat.h>

#if FASTLIO_MRPT_HAS_GENERIC_MAP
#include <mrpt/maps/CGenericPointsMap.h>
#else

#include <mrpt/maps/CSimplePointsMap.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mrpt::maps
{
/** Points [m] with named fields of several types. Each field is as long as the map. */
class CGenericPointsMap : public CSimplePointsMap
{
  DEFINE_SERIALIZABLE(CGenericPointsMap, mrpt::maps)

 public:
  template <typename T>
  using Fields = std::map<std::string, std::vector<T>>;

  CGenericPointsMap() = default;
  CGenericPointsMap(const CGenericPointsMap& other) = default;
  CGenericPointsMap& operator=(const CGenericPointsMap& other);
  ~CGenericPointsMap() override = default;

  /** \name Buffers. They act on all fields; new values are zero.
   * @{ */
  void reserve(size_t new_length) override;
  void resize(size_t new_length) override;
  void setSize(size_t new_length) override;
  void insertPointFast(float x, float y, float z = 0) override;
  /** @} */

  /** \name Fields by type and name. Whoever changes a length keeps it equal to that of the map.
   * @{ */
  Fields<float> float_fields;
  Fields<double> double_fields;
  Fields<std::uint16_t> uint16_fields;
  Fields<std::uint8_t> uint8_fields;
  Fields<std::uint32_t> uint32_fields;
  /** @} */

 protected:
#if !FASTLIO_MRPT_COPIES_POINTS_ITSELF
  void impl_copyFrom(const CPointsMap& other) override;
#endif
  void addFrom_classSpecific(
      const CPointsMap& other, size_t previous_size, bool skip_points_at_zero) override;
  void internal_clear() override;
  void PLY_import_set_vertex_count(size_t count) override;

 private:
  void copyFields(const CPointsMap& other);
  template <typename Change>
  void forEachField(Change change);
};

}  // namespace mrpt::maps

#endif
