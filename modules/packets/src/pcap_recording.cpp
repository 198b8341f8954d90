// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "pcap_recording.h"

#include <fastlio/options/printable.h>

namespace fastlio
{
PcapRecording::PcapRecording(const std::string& path)
    : path_(path), capture_(path), streams_(PacketStreams::ofCapture(path))
{
}

NextRecorded PcapRecording::next()
{
  for (;;)
  {
    if (!problems_.empty())
    {
      std::string what = std::move(problems_.back());
      problems_.pop_back();
      return problem(ReadProblemKind::NotSupported, what);
    }
    if (!queue_.empty())
    {
      auto observation = std::move(queue_.front());
      queue_.pop_front();
      return observation;
    }
    if (finished_) return EndOfRecording{};
    const auto packet = capture_.next();
    if (!packet) return end();
    streams_.take(*packet, queue_);
    problems_ = streams_.takeProblems();
  }
}

NextRecorded PcapRecording::end()
{
  finished_ = true;
  streams_.flush(queue_);
  problems_ = streams_.takeProblems();
  if (!capture_.failure().empty())
    return problem(
        ReadProblemKind::Truncated, "the capture cannot be read on (" +
                                        printable(capture_.failure()) +
                                        "). It or a copy of it was cut off; everything before was "
                                        "read.");
  return next();
}

ReadProblem PcapRecording::problem(ReadProblemKind kind, const std::string& what) const
{
  return {path_, kind, "", path_ + ": " + what};
}

}  // namespace fastlio
