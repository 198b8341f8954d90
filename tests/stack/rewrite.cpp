// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "rewrite.h"

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

namespace fastlio::testing
{
namespace
{
using mrpt::serialization::CSerializable;
const std::string kPlanar = "pseudo_2d_scan";
}  // namespace

void rewriteRawlog(
    const std::string& from, const std::string& to,
    const std::function<CSerializable::Ptr(const CSerializable::Ptr&)>& change)
{
  mrpt::io::CFileGZInputStream in(from);
  mrpt::io::CFileGZOutputStream out(to);
  auto reading = mrpt::serialization::archiveFrom(in);
  auto writing = mrpt::serialization::archiveFrom(out);
  try
  {
    while (true)
      if (const auto object = change(reading.ReadObject())) writing << *object;
  }
  catch (const mrpt::serialization::CExceptionEOF&)
  {
    // The end.
  }
}

void keepFewScans(const std::string& from, const std::string& to, std::size_t period)
{
  std::size_t scans = 0;
  rewriteRawlog(
      from, to,
      [&](const CSerializable::Ptr& object) -> CSerializable::Ptr
      {
        if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object))
        {
          auto kept = mrpt::obs::CSensoryFrame::Create();
          const auto scan = frame->getObservationBySensorLabel(kPlanar);
          if (!scan) return object;
          auto note = mrpt::obs::CObservationComment::Create();  // frames may not be empty
          note->timestamp = scan->timestamp;
          kept->insert(note);
          if (scans++ % period == 0) kept->insert(scan);
          return kept;
        }
        const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object);
        if (!observation) return object;
        const std::string& label = observation->sensorLabel;
        const bool wanted = label != kPlanar || scans++ % period == 0;
        return wanted && label != "lidar" && label != "imu" ? object : nullptr;
      });
}

}  // namespace fastlio::testing
