// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "one_file_exporter.h"

#include <utility>

namespace fastlio
{
namespace
{
class RowExporter : public Exporter
{
 public:
  RowExporter(
      const std::string& path, const std::string& header,
      std::function<std::string(const ScanResult&)> row)
      : file_(path), row_(std::move(row))
  {
    file_.write(header);
  }

  void onScan(const ScanResult& result) override { file_.write(row_(result)); }

  std::vector<OutputFile> finish(const RunEnd& /*end*/) override { return {file_.commit()}; }

 private:
  AtomicFile file_;
  std::function<std::string(const ScanResult&)> row_;
};

template <typename File>
class EndExporter : public Exporter
{
 public:
  EndExporter(
      const std::string& path, bool needs_map, std::function<void(const RunEnd&, File&)> write)
      : file_(path), needs_map_(needs_map), write_(std::move(write))
  {
  }

  [[nodiscard]] bool needsMap() const override { return needs_map_; }

  std::vector<OutputFile> finish(const RunEnd& end) override
  {
    write_(end, file_);
    return {file_.commit()};
  }

 private:
  File file_;
  bool needs_map_;
  std::function<void(const RunEnd&, File&)> write_;
};
}  // namespace

std::unique_ptr<Exporter> rowPerScan(
    const std::string& path, const std::string& header,
    std::function<std::string(const ScanResult&)> row)
{
  return std::make_unique<RowExporter>(path, header, std::move(row));
}

std::unique_ptr<Exporter> writtenAtEnd(
    const std::string& path, std::function<void(const RunEnd&, AtomicFile&)> write)
{
  return std::make_unique<EndExporter<AtomicFile>>(path, false, std::move(write));
}

std::unique_ptr<Exporter> archiveAtEnd(
    const std::string& path, bool needs_map, std::function<void(const RunEnd&, GzipFile&)> write)
{
  return std::make_unique<EndExporter<GzipFile>>(path, needs_map, std::move(write));
}

std::unique_ptr<Exporter> mapFile(
    const std::string& path, std::function<void(const OutputMap&, AtomicFile&)> write)
{
  return std::make_unique<EndExporter<AtomicFile>>(
      path, true,
      [write = std::move(write)](const RunEnd& end, AtomicFile& file) { write(end.map, file); });
}

}  // namespace fastlio
