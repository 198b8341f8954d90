// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/mrpt_bridge/output/standard_exporters.h>

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/io/zip.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/serialization/CArchive.h>

#include <stdexcept>

namespace fastlio
{
namespace
{
constexpr int kFastestCompression = 1;

/** A map of a class that every MRPT program knows, whatever the run's own map class. */
mrpt::maps::CSimplePointsMap plainCopyOf(const mrpt::maps::CPointsMap& map)
{
  const auto& x = map.getPointsBufferRef_x();
  const auto& y = map.getPointsBufferRef_y();
  const auto& z = map.getPointsBufferRef_z();
  mrpt::maps::CSimplePointsMap copy;
  copy.reserve(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    copy.insertPointFast(x[i], y[i], z[i]);
  return copy;
}

/** The serialised object, gzipped in memory: MRPT's gzip file stream does not tell a full disk. */
std::vector<std::uint8_t> serializedAndGzipped(const mrpt::maps::CSimplePointsMap& map)
{
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream) << map;
  const auto* first = static_cast<const std::uint8_t*>(stream.getRawBufferData());
  const std::vector<std::uint8_t> plain(first, first + stream.getTotalBytesCount());
  std::vector<std::uint8_t> gzipped;
  if (!mrpt::io::zip::compress_gz_data_block(plain, gzipped, kFastestCompression))
    throw std::runtime_error("the map could not be compressed; is there enough memory?");
  return gzipped;
}

class MetricMapExporter : public Exporter
{
 public:
  explicit MetricMapExporter(const std::string& path) : file_(path) {}

  void onScan(const ScanResult& /*result*/) override {}

  std::vector<OutputFile> finish(const RunEnd& end) override
  {
    const auto bytes = serializedAndGzipped(plainCopyOf(end.map));
    file_.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return {file_.commit()};
  }

 private:
  AtomicFile file_;
};
}  // namespace

std::unique_ptr<Exporter> makeMetricMapExporter(const std::string& path)
{
  return std::make_unique<MetricMapExporter>(path);
}

}  // namespace fastlio
