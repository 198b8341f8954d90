// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "parameter_rows.h"
#include <fastlio/odometry/parameter_table.h>

#include <algorithm>

namespace fastlio
{
namespace
{
ParameterRows allRows()
{
  ParameterRows all;
  for (const auto& rows :
       {inputRows(), initializationRows(), motionStartRows(), mapStartRows(), imuRows(),
        imuFaultRows(), lidarRows(), furtherLidarRows(), calibrationRows(), downsamplingRows(),
        featureRows(), measurementRows(), mapRows(), updateRows(), restRows(), healthRows(),
        recoveryRows(), outputRows(), generalRows()})
    all.insert(all.end(), rows.begin(), rows.end());
  return all;
}
}  // namespace

std::string_view ParameterRow::group() const
{
  const auto dot = key.find('.');
  return dot == std::string_view::npos ? std::string_view{} : key.substr(0, dot);
}

std::string_view ParameterRow::name() const
{
  const auto dot = key.find('.');
  return dot == std::string_view::npos ? key : key.substr(dot + 1);
}

const std::vector<ParameterRow>& parameterTable()
{
  static const ParameterRows table = allRows();
  return table;
}

const std::vector<ParameterRelation>& parameterRelations()
{
  static const std::vector<ParameterRelation> relations = {
      {"lidar.min_range", [](const Parameters& p) { return p.lidar.min_range < p.lidar.max_range; },
       "must be below lidar.max_range"},
  };
  return relations;
}

const ParameterRow* findParameter(std::string_view key)
{
  const auto& table = parameterTable();
  const auto row = std::find_if(
      table.begin(), table.end(), [key](const ParameterRow& r) { return r.key == key; });
  return row == table.end() ? nullptr : &*row;
}

}  // namespace fastlio
