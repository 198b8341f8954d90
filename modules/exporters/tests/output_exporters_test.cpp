// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "output_test_support.h"
#include <fastlio/exporters/standard_exporters.h>

#include <Eigen/Geometry>
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/opengl/PLY_import_export.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <cstring>
#include <map>

namespace fastlio
{
namespace
{
using testing::contentOf;
using testing::dataLinesOf;
using testing::madeUpResult;
using testing::smallMap;
using testing::smallMapPoints;
using testing::split;
using testing::TemporaryFolder;

constexpr std::int64_t kExporterStamp = 1'403'636'580'838'555'648;

/** Feeds the results and finishes; the files are complete then. */
void run(Exporter& exporter, const std::vector<ScanResult>& results)
{
  for (const auto& result : results)
    exporter.onScan(result);
  const RunSummary summary;
  const auto map = smallMap();
  for (const auto& file : exporter.finish({summary, *map}))
    EXPECT_EQ(file.bytes, std::filesystem::file_size(file.path)) << file.path;
}

/** Cells of row \a index of a CSV file by column name. */
std::map<std::string, std::string> rowOf(const std::string& path, std::size_t index)
{
  const auto lines = dataLinesOf(path);
  const auto names = split(lines.at(0), ',');
  const auto cells = split(lines.at(index + 1), ',');
  EXPECT_EQ(names.size(), cells.size()) << path;
  std::map<std::string, std::string> row;
  for (std::size_t i = 0; i < std::min(names.size(), cells.size()); ++i)
    row[names[i]] = cells[i];
  EXPECT_EQ(row.size(), names.size()) << "repeated column in " << path;
  return row;
}

Mat3 rotationOf(double x, double y, double z, double w)
{
  return Eigen::Quaterniond(w, x, y, z).toRotationMatrix();
}

TEST(TrajectoryTum, HoldsTheVehiclePoseAtTheExactStamp)
{
  const TemporaryFolder folder;
  OutputFrame frame{"vehicle", {expSO3({0.0, 0.4, -0.1}), {0.3, 0.2, -0.1}}};
  const auto exporter = makeTumExporter(folder.file("t.tum"), frame);
  const ScanResult result = madeUpResult(kExporterStamp);
  run(*exporter, {result});

  const auto cells = split(dataLinesOf(folder.file("t.tum")).at(0), ' ');
  ASSERT_EQ(cells.size(), 8U);
  EXPECT_EQ(cells[0], "1403636580.838555648");
  std::vector<double> v;
  v.reserve(cells.size());
  for (const auto& cell : cells)
    v.push_back(std::stod(cell));
  const Pose expected = result.filter.x.pose() * frame.T_imu_body;
  EXPECT_LT((Vec3(v[1], v[2], v[3]) - expected.p).norm(), 1e-6);
  EXPECT_LT(logSO3(rotationOf(v[4], v[5], v[6], v[7]).transpose() * expected.R).norm(), 1e-8);
  EXPECT_GE(v[7], 0.0);
}

TEST(TrajectoryTum, LeavesOutScansWithoutATrustedPose)
{
  const TemporaryFolder folder;
  const auto exporter = makeTumExporter(folder.file("t.tum"), {});
  std::vector<ScanResult> results;
  std::int64_t stamp = kExporterStamp;
  for (const auto status :
       {ScanStatus::Initializing, ScanStatus::FirstScan, ScanStatus::Tracking,
        ScanStatus::PredictionOnly, ScanStatus::Diverged})
    results.push_back(madeUpResult(++stamp, status));
  run(*exporter, results);
  const auto lines = dataLinesOf(folder.file("t.tum"));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(split(lines[0], ' ')[0], "1403636580.838555650");
  EXPECT_EQ(split(lines[2], ' ')[0], "1403636580.838555652");
}

TEST(StatesCsv, HoldsStateAndDeviationsByName)
{
  const TemporaryFolder folder;
  const auto exporter = makeStatesExporter(folder.file("s.csv"));
  const ScanResult result = madeUpResult(kExporterStamp);
  run(*exporter, {result});
  auto row = rowOf(folder.file("s.csv"), 0);
  EXPECT_EQ(row.size(), 1U + 7U + 12U + 18U);
  EXPECT_EQ(row["stamp_ns"], "1403636580838555648");
  const NavState& x = result.filter.x;
  EXPECT_EQ(std::stod(row["y"]), x.p.y());
  EXPECT_EQ(std::stod(row["vx"]), x.v.x());
  EXPECT_EQ(std::stod(row["bgy"]), x.gyro_bias.y());
  EXPECT_EQ(std::stod(row["baz"]), x.accel_bias.z());
  EXPECT_EQ(std::stod(row["gz"]), x.g.z());
  const std::array<const char*, 6> blocks = {"rot", "pos", "vel", "bg", "ba", "g"};
  for (int i = 0; i < kNavigationDim; ++i)
  {
    const std::string name =
        std::string("sigma_") + blocks.at(static_cast<std::size_t>(i / 3)) + "_" + "xyz"[i % 3];
    EXPECT_EQ(std::stod(row[name]), std::sqrt(result.filter.P(i, i))) << name;
  }
}

TEST(CovarianceCsv, HoldsTheUpperTriangleOfThePose)
{
  const TemporaryFolder folder;
  const auto exporter = makeCovarianceExporter(folder.file("c.csv"), {"imu", Pose{}});
  const ScanResult result = madeUpResult(kExporterStamp);
  run(*exporter, {result});
  auto row = rowOf(folder.file("c.csv"), 0);
  EXPECT_EQ(row.size(), 8U + 21U);
  const std::array<std::string, 6> axes = {"rx", "ry", "rz", "px", "py", "pz"};
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = i; j < 6; ++j)
      EXPECT_NEAR(
          std::stod(row["c_" + axes.at(i) + "_" + axes.at(j)]),
          result.filter.P(static_cast<int>(i), static_cast<int>(j)), 1e-15);
  const std::string text = contentOf(folder.file("c.csv"));
  EXPECT_NE(text.find("(rx,ry,rz,px,py,pz)"), std::string::npos);
  EXPECT_NE(text.find("imu frame"), std::string::npos);
}

/** The covariance of another body, against the spread of perturbed poses. */
TEST(PoseOutput, CovarianceMovesWithTheBody)
{
  const FilterState filter = madeUpResult(0).filter;
  const Pose T_imu_body{expSO3({0.5, -1.0, 0.3}), {0.4, -0.7, 1.1}};
  const PoseEstimate estimate = poseEstimateOf(filter, T_imu_body);
  Matrix6 J;
  for (int i = 0; i < 6; ++i)
  {
    StateVector dx = StateVector::Zero();
    constexpr double kStep = 1e-6;
    dx[i] = kStep;
    const Pose moved = boxplus(filter.x, dx).pose() * T_imu_body;
    J.block<3, 1>(0, i) = logSO3(estimate.T_world_body.R.transpose() * moved.R) / kStep;
    J.block<3, 1>(3, i) = (moved.p - estimate.T_world_body.p) / kStep;
  }
  const Matrix6 P_imu = filter.P.topLeftCorner<6, 6>();
  const Matrix6 expected = J * P_imu * J.transpose();
  EXPECT_LT((estimate.covariance - expected).norm(), 1e-5 * expected.norm());
  EXPECT_LT((poseEstimateOf(filter, Pose{}).covariance - P_imu).norm(), 1e-15);
}

TEST(TimingCsv, HoldsEveryScanWithItsStatus)
{
  const TemporaryFolder folder;
  const auto exporter = makeTimingExporter(folder.file("t.csv"));
  run(*exporter, {madeUpResult(kExporterStamp, ScanStatus::Initializing),
                  madeUpResult(kExporterStamp + 1, ScanStatus::PredictionOnly)});
  auto row = rowOf(folder.file("t.csv"), 1);
  EXPECT_EQ(row["status"], "prediction_only");
  EXPECT_EQ(row["points_in"], "20000");
  EXPECT_EQ(row["points_effective"], "900");
  EXPECT_EQ(row["converged"], "1");
  EXPECT_EQ(row["total_ms"], "4.5000");
  EXPECT_EQ(rowOf(folder.file("t.csv"), 0)["status"], "initializing");
}

TEST(MapPly, IsReadByMrpt)
{
  const TemporaryFolder folder;
  const auto exporter = makePlyMapExporter(folder.file("m.ply"));
  run(*exporter, {});
  EXPECT_EQ(contentOf(folder.file("m.ply")).rfind("ply\nformat binary_little_endian 1.0\n", 0), 0U);
  mrpt::maps::CSimplePointsMap read;
  ASSERT_TRUE(read.loadFromPlyFile(folder.file("m.ply")));
  const auto written = smallMapPoints();
  EXPECT_TRUE(std::equal(
      written.x.begin(), written.x.end(), read.getPointsBufferRef_x().begin(),
      read.getPointsBufferRef_x().end()));
  EXPECT_TRUE(std::equal(
      written.y.begin(), written.y.end(), read.getPointsBufferRef_y().begin(),
      read.getPointsBufferRef_y().end()));
  EXPECT_TRUE(std::equal(
      written.z.begin(), written.z.end(), read.getPointsBufferRef_z().begin(),
      read.getPointsBufferRef_z().end()));
}

/** Point i of a binary file, behind its header. */
std::pair<std::array<float, 4>, double> pointOf(const std::string& content, std::size_t i)
{
  constexpr std::size_t kBytes = 24;
  const std::size_t points = 5000;
  const char* at = content.data() + content.size() - (points - i) * kBytes;
  std::pair<std::array<float, 4>, double> point;
  std::memcpy(point.first.data(), at, sizeof point.first);
  std::memcpy(&point.second, at + sizeof point.first, sizeof point.second);
  return point;
}

TEST(MapFiles, HoldIntensityAndTime)
{
  const TemporaryFolder folder;
  run(*makePlyMapExporter(folder.file("m.ply")), {});
  run(*makePcdMapExporter(folder.file("m.pcd")), {});
  run(*makeTextMapExporter(folder.file("m.txt")), {});
  const std::string pcd = contentOf(folder.file("m.pcd"));
  EXPECT_NE(pcd.find("\nPOINTS 5000\nDATA binary\n"), std::string::npos);
  EXPECT_NE(pcd.find("\nSIZE 4 4 4 4 8\n"), std::string::npos);
  const std::array<float, 4> expected = {2000.0F, -1.25F, 4.0F, 160.0F};
  for (const auto& content : {contentOf(folder.file("m.ply")), pcd})
  {
    const auto [values, time] = pointOf(content, 4000);
    EXPECT_EQ(values, expected);
    EXPECT_NEAR(time, 1403636504.0, 1e-6);
  }
  const auto lines = dataLinesOf(folder.file("m.txt"));
  ASSERT_EQ(lines.size(), 5000U);
  EXPECT_EQ(lines[4000], "2000.0000 -1.2500 4.0000 160 1403636504.000000000");
}

TEST(TrajectoryKitti, HoldsMatricesRowByRow)
{
  const TemporaryFolder folder;
  const ScanResult result = madeUpResult(kExporterStamp);
  run(*makeKittiExporter(folder.file("k"), {"imu", {}}), {result});
  const auto cells = split(dataLinesOf(folder.file("k")).at(0), ' ');
  ASSERT_EQ(cells.size(), 12U);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      EXPECT_NEAR(
          std::stod(cells.at(static_cast<std::size_t>(4 * row + column))),
          column < 3 ? result.filter.x.R(row, column) : result.filter.x.p[row], 1e-9);
  EXPECT_EQ(dataLinesOf(folder.file("k_times")).at(0), "1403636580.838555648");
}

TEST(MetricMap, IsAGzippedObjectOfAStandardClass)
{
  const TemporaryFolder folder;
  const auto exporter = makeMetricMapExporter(folder.file("m.metricmap"));
  run(*exporter, {});
  EXPECT_EQ(contentOf(folder.file("m.metricmap")).substr(0, 2), "\x1f\x8b");
  mrpt::io::CFileGZInputStream stream(folder.file("m.metricmap"));
  auto archive = mrpt::serialization::archiveFrom(stream);
  const auto object = archive.ReadObject();
  const auto read = std::dynamic_pointer_cast<mrpt::maps::CSimplePointsMap>(object);
  ASSERT_TRUE(read);
  const auto written = smallMapPoints();
  EXPECT_TRUE(std::equal(
      written.x.begin(), written.x.end(), read->getPointsBufferRef_x().begin(),
      read->getPointsBufferRef_x().end()));
  EXPECT_TRUE(std::equal(
      written.z.begin(), written.z.end(), read->getPointsBufferRef_z().begin(),
      read->getPointsBufferRef_z().end()));
  EXPECT_EQ(read->insertionOptions.maxDistForInterpolatePoints, 2.0F);  // what comes after them
}

}  // namespace
}  // namespace fastlio
