// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "cdr_messages.h"
#include "mcap_file.h"
#include "mcap_record.h"
#include "ros2_definitions.h"
#include <fastlio/recordings/mcap_writer.h>
#include <fastlio/sensors/conversions.h>

#include <mrpt/obs/CObservationPointCloud.h>

#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <vector>
#include <zlib.h>
#include <zstd.h>

namespace fastlio
{
namespace
{
const std::string kBase = "base_link", kOdom = "odom";
constexpr std::size_t kChunkBytes = std::size_t{4} << 20U;

std::string zstdOf(const std::string& bytes)
{
  constexpr int kFast = 1;
  std::string packed(ZSTD_compressBound(bytes.size()), '\0');
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kFast);
  if (ZSTD_isError(size) != 0) throw std::runtime_error("a chunk cannot be compressed");
  packed.resize(size);
  return packed;
}

/** Names of frames have no slash ahead. */
std::string frameOf(const std::string& label)
{
  if (label.empty()) return "sensor";
  return label.front() == '/' ? label.substr(1) : label;
}

std::string topicOf(const std::string& label)
{
  return "/" + frameOf(label);
}
}  // namespace

class McapWriter::Impl
{
 public:
  explicit Impl(const std::string& path) : file_(path)
  {
    put(mcapMagic() + McapRecord().text("ros2").text("mrpt_fastlio").finish(kHeaderOp));
  }

  bool write(const mrpt::obs::CObservation& observation);
  void writePose(const std::string& topic, std::int64_t stamp_ns, const Pose& T_odom_base);
  OutputFile commit();

 private:
  struct IndexEntry
  {
    std::uint64_t stamp = 0, offset = 0;
  };

  void put(const std::string& bytes)
  {
    file_.write(bytes);
    position_ += bytes.size();
  }
  std::uint16_t channelOf(const std::string& topic, const std::string& type);
  void message(
      const std::string& topic, const std::string& type, std::int64_t stamp_ns,
      const std::string& data);
  void mount(const mrpt::obs::CObservation& observation, std::int64_t stamp_ns);
  void closeChunk();
  [[nodiscard]] std::string statistics() const;

  AtomicFile file_;
  std::uint64_t position_ = 0;
  std::map<std::string, std::uint16_t> channels_;  // by topic
  std::string definitions_;                        // the records of all channels
  std::map<std::uint16_t, std::uint64_t> counts_;  // by channel
  std::set<std::string> mounted_;                  // frames whose transform is written
  std::string chunk_;
  std::map<std::uint16_t, std::vector<IndexEntry>> index_;                      // of the chunk
  std::uint64_t first_ = std::numeric_limits<std::uint64_t>::max(), last_ = 0;  // of the chunk
  std::uint64_t begin_ = std::numeric_limits<std::uint64_t>::max(), end_ = 0;   // of the file
  std::string chunk_indexes_;
  std::uint32_t chunks_ = 0;
};

std::uint16_t McapWriter::Impl::channelOf(const std::string& topic, const std::string& type)
{
  const auto [channel, is_new] =
      channels_.try_emplace(topic, static_cast<std::uint16_t>(channels_.size()));
  if (!is_new) return channel->second;
  const auto schema = static_cast<std::uint16_t>(channel->second + 1);
  const std::string records = McapRecord()
                                  .number(schema)
                                  .text(type)
                                  .text("ros2msg")
                                  .text(ros2DefinitionOf(type))
                                  .finish(kSchemaOp) +
                              McapRecord()
                                  .number(channel->second)
                                  .number(schema)
                                  .text(topic)
                                  .text("cdr")
                                  .number(std::uint32_t{0})
                                  .finish(kChannelOp);
  chunk_ += records;
  definitions_ += records;
  return channel->second;
}

void McapWriter::Impl::message(
    const std::string& topic, const std::string& type, std::int64_t stamp_ns,
    const std::string& data)
{
  const std::uint16_t channel = channelOf(topic, type);
  const auto stamp = static_cast<std::uint64_t>(std::max<std::int64_t>(stamp_ns, 0));
  index_[channel].push_back({stamp, chunk_.size()});
  ++counts_[channel];
  first_ = std::min(first_, stamp);
  last_ = std::max(last_, stamp);
  chunk_ += McapRecord()
                .number(channel)
                .number(std::uint32_t{0})
                .number(stamp)
                .number(stamp)
                .raw(data)
                .finish(kMessageOp);
  if (chunk_.size() >= kChunkBytes) closeChunk();
}

void McapWriter::Impl::closeChunk()
{
  if (chunk_.empty()) return;
  const std::string packed = zstdOf(chunk_);
  const auto checksum = static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(chunk_.data()), chunk_.size()));
  const std::uint64_t begin = position_;
  put(McapRecord()
          .number(first_)
          .number(last_)
          .number(std::uint64_t{chunk_.size()})
          .number(checksum)
          .text("zstd")
          .number(std::uint64_t{packed.size()})
          .raw(packed)
          .finish(kChunkOp));
  const std::uint64_t end = position_;
  McapRecord offsets;
  for (const auto& [channel, entries] : index_)
  {
    offsets.number(channel).number(position_);
    McapRecord list;
    for (const IndexEntry& entry : entries)
      list.number(entry.stamp).number(entry.offset);
    put(McapRecord().number(channel).text(list.bytes()).finish(kMessageIndexOp));
  }
  chunk_indexes_ += McapRecord()
                        .number(first_)
                        .number(last_)
                        .number(begin)
                        .number(end - begin)
                        .text(offsets.bytes())
                        .number(position_ - end)
                        .text("zstd")
                        .number(std::uint64_t{packed.size()})
                        .number(std::uint64_t{chunk_.size()})
                        .finish(kChunkIndexOp);
  ++chunks_;
  begin_ = std::min(begin_, first_);
  end_ = std::max(end_, last_);
  chunk_.clear();
  index_.clear();
  first_ = std::numeric_limits<std::uint64_t>::max();
  last_ = 0;
}

std::string McapWriter::Impl::statistics() const
{
  McapRecord counts;
  std::uint64_t messages = 0;
  for (const auto& [channel, count] : counts_)
  {
    counts.number(channel).number(count);
    messages += count;
  }
  return McapRecord()
      .number(messages)
      .number(static_cast<std::uint16_t>(channels_.size()))
      .number(static_cast<std::uint32_t>(channels_.size()))
      .number(std::uint32_t{0})
      .number(std::uint32_t{0})
      .number(chunks_)
      .number(messages == 0 ? std::uint64_t{0} : begin_)
      .number(end_)
      .text(counts.bytes())
      .finish(kStatisticsOp);
}

OutputFile McapWriter::Impl::commit()
{
  closeChunk();
  put(McapRecord().number(std::uint32_t{0}).finish(kDataEndOp));
  const std::uint64_t summary = position_;
  put(definitions_ + chunk_indexes_ + statistics());
  put(McapRecord()
          .number(summary)
          .number(std::uint64_t{0})
          .number(std::uint32_t{0})
          .finish(kFooterOp) +
      mcapMagic());
  return file_.commit();
}

void McapWriter::Impl::mount(const mrpt::obs::CObservation& observation, std::int64_t stamp_ns)
{
  const std::string frame = frameOf(observation.sensorLabel);
  if (!mounted_.insert(frame).second) return;
  mrpt::poses::CPose3D pose;
  observation.getSensorPose(pose);
  message(
      "/tf_static", "tf2_msgs/msg/TFMessage", stamp_ns,
      transformMessageOf(stamp_ns, {kBase, frame, toPose(pose)}));
}

bool McapWriter::Impl::write(const mrpt::obs::CObservation& observation)
{
  const std::int64_t stamp_ns = toNanoseconds(observation.timestamp);
  const std::string frame = frameOf(observation.sensorLabel);
  std::string type, data;
  if (const auto* imu = dynamic_cast<const mrpt::obs::CObservationIMU*>(&observation))
  {
    type = "sensor_msgs/msg/Imu";
    data = imuMessageOf(*imu, frame);
  }
  else if (const auto* raw = dynamic_cast<const mrpt::obs::CObservationVelodyneScan*>(&observation))
  {
    type = "velodyne_msgs/msg/VelodyneScan";
    data = velodyneMessageOf(*raw, frame);
  }
  else if (const auto* cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation);
           cloud != nullptr && cloud->pointcloud)
  {
    type = "sensor_msgs/msg/PointCloud2";
    data = cloudMessageOf(readColumns(*cloud->pointcloud), stamp_ns, frame);
  }
  else
    return false;
  mount(observation, stamp_ns);
  message(topicOf(observation.sensorLabel), type, stamp_ns, data);
  return true;
}

void McapWriter::Impl::writePose(
    const std::string& topic, std::int64_t stamp_ns, const Pose& T_odom_base)
{
  message(
      topic, "nav_msgs/msg/Odometry", stamp_ns,
      odometryMessageOf(stamp_ns, kOdom, kBase, T_odom_base));
  message(
      "/tf", "tf2_msgs/msg/TFMessage", stamp_ns,
      transformMessageOf(stamp_ns, {kOdom, kBase, T_odom_base}));
}

McapWriter::McapWriter(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}

McapWriter::~McapWriter() = default;

bool McapWriter::write(const mrpt::obs::CObservation& observation)
{
  return impl_->write(observation);
}

void McapWriter::writePose(const std::string& topic, std::int64_t stamp_ns, const Pose& T_odom_base)
{
  impl_->writePose(topic, stamp_ns, T_odom_base);
}

OutputFile McapWriter::commit()
{
  return impl_->commit();
}

}  // namespace fastlio
