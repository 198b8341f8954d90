// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "settings_rows.h"

namespace fastlio
{
namespace
{
using S = SimulationSettings;
}  // namespace

OptionTable<SimulationSettings> worldRows()
{
  return {
      {"session", "",
       [](S& s) -> OptionValue {
         return IntegerValue{&s.world.session, 0, 1000000};
       },
       "another day in the same world: parked cars, furniture and clutter stand elsewhere, are "
       "gone or are new; 0: the first day"},
      {"world.changes", "",
       [](S& s) -> OptionValue {
         return RealValue{&s.world.changes, 0.0, 1.0};
       },
       "fraction of the things that can be moved that another session changes"},
      {"world.length", "m",
       [](S& s) -> OptionValue {
         return RealValue{&s.world.length, 600.0, 1e5};
       },
       "town: length of the ride; the town grows with it"},
  };
}

}  // namespace fastlio
