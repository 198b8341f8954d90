// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/exporters/standard_exporters.h>
#include <fastlio/report/report_page.h>

namespace fastlio
{
namespace
{
class ReportExporter : public Exporter
{
 public:
  explicit ReportExporter(const ExportTarget& options)
      : file_(options.path("report.html")),
        series_(options.frame.T_imu_body),
        comparison_(options.reference, options.frame)
  {
  }

  void onScan(const ScanResult& result) override
  {
    series_.add(result);
    comparison_.add(result);
  }

  [[nodiscard]] bool usesMap() const override { return true; }

  std::vector<OutputFile> finish(const RunEnd& end) override
  {
    MapViews views = mapViewsOf(series_, end.summary.statistics.health().untrusted(), end.map);
    if (!end.map_problem.empty()) views.problem = end.map_problem;
    file_.write(reportPage({end.summary, series_, std::move(views), comparison_.findings()}));
    return {file_.commit()};
  }

 private:
  AtomicFile file_;
  ReportSeries series_;
  ReferenceComparison comparison_;
};
}  // namespace

std::unique_ptr<Exporter> makeReportExporter(const ExportTarget& options)
{
  return std::make_unique<ReportExporter>(options);
}

}  // namespace fastlio
