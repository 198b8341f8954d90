// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "proj_objects.h"
#include "temporary_folder.h"
#include <fastlio/earth/reference_system.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

namespace fastlio
{
namespace
{
const GeodeticPoint kMunichCity{48.137, 11.575, 520.5};

std::string refusalOfSystem(const std::string& definition)
{
  try
  {
    const ReferenceSystem system(definition);
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  catch (const std::runtime_error& error)
  {
    return std::string("runtime_error: ") + error.what();
  }
  return "taken";
}

/** The meridian arc of WGS84 from the equator [m], by Simpson's rule: on the central meridian a
 * northing of UTM is this times 0.9996. */
double meridianArc(double latitude_deg)
{
  const double e2 = 0.0066943799901413165, a = 6378137.0;
  const auto radius = [&](double phi)
  { return a * (1 - e2) / std::pow(1 - e2 * std::sin(phi) * std::sin(phi), 1.5); };
  const int steps = 2000;
  const double h = latitude_deg * 0.017453292519943295 / steps;
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    sum += h / 6 * (radius(i * h) + 4 * radius((i + 0.5) * h) + radius((i + 1) * h));
  return sum;
}

/** The environment as it was, in the end. */
class SetVariable
{
 public:
  SetVariable(const char* name, const std::string& value) : name_(name)
  {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value.c_str(), 1);
  }
  ~SetVariable()
  {
    if (old_)
      setenv(name_, old_->c_str(), 1);
    else
      unsetenv(name_);
  }
  SetVariable(const SetVariable&) = delete;
  SetVariable& operator=(const SetVariable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

/** PROJ sees the files of one folder only. */
class ProjFolder
{
 public:
  explicit ProjFolder(const std::string& path)
      : lib_("PROJ_LIB", path),
        data_("PROJ_DATA", path),
        user_("PROJ_USER_WRITABLE_DIRECTORY", path)
  {
  }

 private:
  SetVariable lib_, data_, user_;
};

TEST(UtmZone, OfPlaces)
{
  EXPECT_EQ(utmCodeAt(kMunichCity), "EPSG:32632");
  EXPECT_EQ(utmCodeAt({-33.86, 151.21, 0}), "EPSG:32756");
  EXPECT_EQ(utmCodeAt({0, -180, 0}), "EPSG:32601");
  EXPECT_EQ(utmCodeAt({0, 180, 0}), "EPSG:32601");
  EXPECT_EQ(utmCodeAt({-0.1, 179.99, 0}), "EPSG:32760");
  EXPECT_EQ(utmCodeAt({60.39, 5.32, 0}), "EPSG:32632");   // Bergen
  EXPECT_EQ(utmCodeAt({55.9, 5.32, 0}), "EPSG:32631");    // south of Norway's exception
  EXPECT_EQ(utmCodeAt({78.22, 15.63, 0}), "EPSG:32633");  // Longyearbyen
  EXPECT_EQ(utmCodeAt({78.22, 8, 0}), "EPSG:32631");
  EXPECT_EQ(utmCodeAt({78.22, 41, 0}), "EPSG:32637");
  EXPECT_THROW((void)utmCodeAt({84.1, 0, 0}), std::invalid_argument);
  EXPECT_THROW((void)utmCodeAt({-80.1, 0, 0}), std::invalid_argument);
  EXPECT_THROW((void)utmCodeAt({48, 1000, 0}), std::invalid_argument);
}

TEST(ReferenceSystem, UtmOfTheCentralMeridianIsTheMeridianArc)
{
  const ReferenceSystem system("EPSG:32632");
  for (const double latitude : {0.5, 20.0, 48.0, 83.0})
  {
    const Vec3 there = system.projectedOf(GeodeticPoint{latitude, 9.0, 123.25});
    EXPECT_NEAR(there.x(), 500'000, 1e-6);
    EXPECT_NEAR(there.y(), 0.9996 * meridianArc(latitude), 1e-5);
    EXPECT_EQ(there.z(), 123.25);
  }
}

TEST(ReferenceSystem, OtherFormsOfTheSameSystemAgree)
{
  const ReferenceSystem code("EPSG:32632");
  for (const std::string& form :
       {code.wkt(), std::string("WGS 84 / UTM zone 32N"),
        std::string("+proj=utm +zone=32 +datum=WGS84"), std::string("urn:ogc:def:crs:EPSG::32632")})
    EXPECT_LT(
        (ReferenceSystem(form).projectedOf(kMunichCity) - code.projectedOf(kMunichCity)).norm(),
        1e-6)
        << form;
}

TEST(ReferenceSystem, RoundTripsAndKeepsDistances)
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> metres(-2e3, 2e3), up(-30, 100);
  const LocalFrame frame(kMunichCity);
  for (const char* definition : {"EPSG:32632", "EPSG:25832", "EPSG:31468"})
  {
    const ReferenceSystem system(definition);
    for (int i = 0; i < 200; ++i)
    {
      const Vec3 enu(metres(random), metres(random), up(random));
      const Vec3 there = system.projectedOf(frame, enu);
      EXPECT_LT((frame.enuOf(system.geodeticOf(there)) - enu).norm(), 1e-4) << definition;
    }
    // Conformal: lengths by one factor, here between 0.9996 and 1.
    const Vec3 origin = system.projectedOf(kMunichCity);
    for (const Vec3& step : {Vec3(100, 0, 0), Vec3(0, 100, 0)})
      EXPECT_NEAR((system.projectedOf(frame, step) - origin).norm(), 100, 0.05) << definition;
  }
}

TEST(ReferenceSystem, EastComesFirstWhateverTheAuthoritySays)
{
  // Its axes are northing, easting.
  const ReferenceSystem gauss_krueger("EPSG:31468");
  const Vec3 there = gauss_krueger.projectedOf(kMunichCity);
  EXPECT_NEAR(there.x(), 4'468'600, 500);
  EXPECT_NEAR(there.y(), 5'333'400, 500);
}

TEST(ReferenceSystem, HeightsOfACompoundSystemAreAboveItsGeoid)
{
  const std::string definition = "EPSG:32632+5773";
  if (refusalOfSystem(definition).find("needs the grid of its geoid") != std::string::npos)
    GTEST_SKIP() << "needs the grid of EGM96, which Debian's proj-data brings";
  const ReferenceSystem ellipsoidal("EPSG:32632"), egm96(definition);
  const Vec3 a = ellipsoidal.projectedOf(kMunichCity), b = egm96.projectedOf(kMunichCity);
  EXPECT_LT((a - b).head<2>().norm(), 1e-6);
  // The undulation of EGM96 at Munich.
  EXPECT_NEAR(a.z() - b.z(), 45.7, 0.5);
  EXPECT_NEAR(egm96.geodeticOf(b).height_m, kMunichCity.height_m, 1e-3);
}

TEST(ReferenceSystem, MissingGridsAreRefusedInsteadOfApproximated)
{
  const ProjContext context(proj_context_create());
  const char* database = proj_context_get_database_path(context.get());
  ASSERT_NE(database, nullptr);
  const testing::TemporaryFolder folder;
  std::filesystem::create_symlink(database, folder.file("proj.db"));
  const ProjFolder only(folder.path());
  EXPECT_EQ(refusalOfSystem("EPSG:32632"), "taken");
  for (const char* definition : {"EPSG:32632+5773", "EPSG:25832+7837"})
  {
    const std::string text = refusalOfSystem(definition);
    EXPECT_EQ(text.find("runtime_error: PROJ knows no way from WGS84 to"), 0U) << text;
    EXPECT_NE(text.find("needs the grid of its geoid"), std::string::npos) << text;
  }
}

TEST(ReferenceSystem, WktNamesTheSystem)
{
  const ReferenceSystem system("EPSG:32632");
  const std::string wkt1 = system.wkt();
  EXPECT_EQ(wkt1.find("PROJCS[\"WGS 84 / UTM zone 32N\","), 0U) << wkt1;
  EXPECT_NE(wkt1.find("AUTHORITY[\"EPSG\",\"32632\"]"), std::string::npos);
  EXPECT_EQ(wkt1.find('\n'), std::string::npos);
  EXPECT_EQ(ReferenceSystem("EPSG:32632+5773").wkt().find("COMPD_CS["), 0U);
}

TEST(ReferenceSystem, SaysWhatIsWrongAndWhatToDo)
{
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"EPSG:99999", "unknown coordinate reference system 'EPSG:99999' (PROJ says: "},
      {"", "a coordinate reference system of 0 characters; give 1 to 65536, like EPSG:32632"},
      {"nonsense\n\x1b[31m", "unknown coordinate reference system 'nonsense\\n\\x1b[31m'"},
      {"EPSG:4326", "'EPSG:4326' (WGS 84) is not projected"},
      {"EPSG:4978", "is not projected"},
      {"EPSG:5773", "is not projected"},
      {"EPSG:2263", "counts in 'US survey foot'; give a system in metres"},
      {"EPSG:5513", "points west; give a system with axes East, North and Up"},
      {"EPSG:32617+6360", "'Gravity-related height' of 'EPSG:32617+6360'"},
      {"EPSG:32617+6360", "counts in 'US survey foot'"},
      {"EPSG:32632+5831", "points down; give a system with axes East, North and Up"},
      {"+proj=utm +zone=99", "unknown coordinate reference system"},
      {"PROJCS[\"cut", "unknown coordinate reference system"}};
  for (const auto& [definition, words] : cases)
    EXPECT_NE(refusalOfSystem(definition).find(words), std::string::npos)
        << definition << ": " << refusalOfSystem(definition);
  EXPECT_NE(
      refusalOfSystem(std::string(70'000, 'x')).find("of 70000 characters"), std::string::npos);
}

TEST(ReferenceSystem, CoordinatesOfNowhereAreAnError)
{
  const ReferenceSystem system("EPSG:32632");
  EXPECT_THROW((void)system.geodeticOf({1e30, 1e30, 0}), std::runtime_error);
  EXPECT_THROW((void)system.geodeticOf({5e5, 5e6, 1e9}), std::runtime_error);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)system.projectedOf(GeodeticPoint{nan, 9, 0}), std::runtime_error);
}

TEST(ReferenceSystem, ThreadsHaveTheirOwn)
{
  const Vec3 expected = ReferenceSystem("EPSG:32632").projectedOf(kMunichCity);
  std::vector<Vec3> found(4, Vec3::Zero());
  std::vector<std::thread> threads;
  threads.reserve(found.size());
  for (Vec3& mine : found)
    threads.emplace_back([&mine]
                         { mine = ReferenceSystem("EPSG:32632").projectedOf(kMunichCity); });
  for (std::thread& thread : threads)
    thread.join();
  for (const Vec3& one : found)
    EXPECT_EQ(one, expected);
}

TEST(ReferenceSystem, AMissingDatabaseIsNamed)
{
  const testing::TemporaryFolder empty;
  const ProjFolder only(empty.path());
  const std::string text = refusalOfSystem("EPSG:32632");
  EXPECT_EQ(text.find("runtime_error: PROJ does not find its database proj.db"), 0U) << text;
  EXPECT_NE(text.find("install Debian's package proj-data"), std::string::npos) << text;
}
}  // namespace
}  // namespace fastlio
