// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "ply_file.h"
#include <fastlio/archives/archived_object.h>
#include <fastlio/archives/object_stream.h>
#include <fastlio/compat/mrpt_messages.h>
#include <fastlio/compat/register_classes.h>
#include <fastlio/files/input_file.h>
#include <fastlio/map/mrpt_voxel_planes_map.h>
#include <fastlio/options/printable.h>
#include <fastlio/recordings/byte_source.h>
#include <fastlio/recordings/pcd_reader.h>
#include <fastlio/savedmaps/saved_map_file.h>

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

namespace fastlio
{
namespace
{
[[noreturn]] void failMap(const std::string& path, const std::string& why)
{
  throw std::runtime_error("map '" + path + "' " + why);
}

// Of MRPT's own classes, which are read as a whole: 350 million points. What of ours is read piece
// by piece has no limit.
constexpr std::size_t kLargestMap = std::size_t{4} << 30U;  // [bytes]
constexpr std::size_t kMostMaps = 1000;                     // of a CMultiMetricMap

std::string beginningOf(const std::string& path)
{
  if (const auto problem = inputFileProblem(path))
    failMap(
        path, *problem + (std::filesystem::is_directory(path)
                              ? ": give a map to --map-in, such as map.planes of a run"
                              : ": check the path given to --map-in"));
  constexpr std::size_t kEnough = 256;
  return headOf(path, kEnough);
}

bool isPcd(const std::string& beginning)
{
  return beginning.rfind("# .PCD", 0) == 0 || beginning.rfind("VERSION", 0) == 0;
}

FilePoints readPcd(const std::string& path)
{
  constexpr std::size_t kPiece = 65536;  // points
  FilePoints points;
  try
  {
    PcdReader reader(path);
    for (PointGrid piece = reader.next(kPiece); piece.width > 0; piece = reader.next(kPiece))
    {
      const auto x = valuesOf(piece, reader.fields(), "x");
      const auto y = valuesOf(piece, reader.fields(), "y");
      const auto z = valuesOf(piece, reader.fields(), "z");
      for (std::size_t i = 0; i < piece.width; ++i)
        points.add({x[i], y[i], z[i]});
    }
  }
  catch (const std::runtime_error& e)
  {
    failMap(path, e.what());
  }
  return points;
}

void take(FilePoints&& read, SavedMap& saved)
{
  saved.points = std::move(read.points);
  saved.origin = read.origin;
  // Planes count from the origin of their file.
  if (!saved.origin.isZero()) saved.planes.reset();
}

FilePoints pointsOf(const mrpt::maps::CPointsMap& map)
{
  FilePoints points;
  for (std::size_t i = 0; i < map.size(); ++i)
  {
    mrpt::math::TPoint3Df p;
    map.getPoint(i, p.x, p.y, p.z);
    points.add({static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
  }
  return points;
}

SavedMap fromMap(const mrpt::serialization::CSerializable::Ptr& object)
{
  SavedMap saved;
  if (const auto planes = std::dynamic_pointer_cast<CVoxelPlanesMap>(object))
  {
    if (!planes->isEmpty()) saved.planes = {planes, &planes->planes()};
    take(pointsOf(planes->points()), saved);
  }
  else if (const auto points = std::dynamic_pointer_cast<mrpt::maps::CPointsMap>(object))
    take(pointsOf(*points), saved);
  return saved;
}

/** Forgets what it has given: for classes that read piece by piece. */
class OnceStream
{
 public:
  explicit OnceStream(ObjectStream& stream) : stream_(stream) {}

  std::size_t Read(void* data, std::size_t size)
  {
    stream_.beginObject();
    return stream_.Read(data, size);
  }
  std::size_t Write(const void* data, std::size_t size) { return stream_.Write(data, size); }
  [[nodiscard]] std::string getStreamDescription() const { return "map"; }

 private:
  ObjectStream& stream_;
};

bool hasUsablePoint(const WorldPoints& points)
{
  for (std::size_t i = 0; i < points.size(); ++i)
    if (FilePoints::usable(
            {static_cast<double>(points.x[i]), static_cast<double>(points.y[i]),
             static_cast<double>(points.z[i])}))
      return true;
  return false;
}

/** Without the copies of points that many others equal: a search for neighbours visits all of them.
 */
WorldPoints withoutPiles(const WorldPoints& points)
{
  constexpr std::size_t kMostCopies = 10;  // of one point, more than neighbours are looked for
  using Bits = std::array<std::uint32_t, 3>;
  std::vector<std::pair<Bits, std::size_t>> sorted(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::array<float, 3> p{points.x[i], points.y[i], points.z[i]};
    std::memcpy(sorted[i].first.data(), p.data(), sizeof(p));  // numbers or not, they have an order
    sorted[i].second = i;
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<bool> kept(points.size(), true);
  for (std::size_t i = kMostCopies; i < sorted.size(); ++i)
    kept[sorted[i].second] = sorted[i].first != sorted[i - kMostCopies].first;
  WorldPoints few;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (kept[i]) few.add(points.x[i], points.y[i], points.z[i]);
  return few;
}

bool isReadPieceByPiece(const std::string& class_name)
{
  return class_name == "fastlio::CVoxelPlanesMap" || class_name == "fastlio::CIncrementalPointsMap";
}

mrpt::serialization::CSerializable::Ptr readMap(ObjectStream& stream, const std::string& class_name)
{
  if (!isReadPieceByPiece(class_name)) return readObjectHere(stream);
  try
  {
    OnceStream once(stream);
    auto archive = mrpt::serialization::archiveFrom(once);
    return archive.ReadObject();
  }
  catch (const std::bad_alloc&)
  {
    throw std::runtime_error("asks for more memory than there is");
  }
  catch (const std::exception& e)
  {
    if (stream.ranOut()) throw std::runtime_error("is cut off: it ends inside its map");
    throw std::runtime_error("is damaged: " + printable(innermostMessage(e.what())));
  }
}

/** The first map that has points of several, each checked by itself before it is read.
 * \param header of the object that holds them */
SavedMap fromSeveral(ObjectStream& stream, const ObjectHeader& header)
{
  constexpr unsigned char kVersion = 12;  // of all versions of MRPT since 2.0
  const auto size = header.length + 1;
  if (!stream.holds(0, size + 4) || stream.byteAt(header.length) != kVersion)
    throw std::runtime_error("is cut off or of a version of CMultiMetricMap that is not known");
  const auto count = stream.numberAt<std::uint32_t>(size);
  stream.rewindTo(size + 4);
  if (count > kMostMaps)
    throw std::runtime_error("claims to hold " + std::to_string(count) + " maps");
  for (std::uint32_t i = 0; i < count; ++i)
  {
    stream.beginObject();
    const auto inner = stream.peekHeader();
    if (!inner) throw std::runtime_error("is cut off or damaged between its maps");
    SavedMap saved = fromMap(readMap(stream, inner->class_name));
    if (!saved.empty()) return saved;
  }
  return {};
}

SavedMap fromArchive(const std::string& path)
{
  registerBridgeClasses();
  try
  {
    ObjectStream stream(path, kLargestMap);
    const auto header = stream.peekHeader();
    if (!header) throw std::runtime_error("is neither PLY nor PCD nor an archive of MRPT");
    if (header->class_name == "mrpt::maps::CMultiMetricMap") return fromSeveral(stream, *header);
    const auto object = readMap(stream, header->class_name);
    if (std::dynamic_pointer_cast<mrpt::maps::CMetricMap>(object)) return fromMap(object);
    throw std::runtime_error(
        "holds a " + printable(header->class_name) +
        ", not a map; give a PLY, a PCD or an archive with a map");
  }
  catch (const std::exception& e)
  {
    failMap(path, e.what());
  }
}
}  // namespace

SavedMap loadSavedMap(const std::string& path)
{
  const std::string beginning = beginningOf(path);
  SavedMap saved;
  if (beginning.rfind("ply\n", 0) == 0 || beginning.rfind("ply\r", 0) == 0)
    take(readPly(path), saved);
  else if (isPcd(beginning))
    take(readPcd(path), saved);
  else
    saved = fromArchive(path);
  if (saved.empty()) failMap(path, "has no points");
  if (!saved.planes && !hasUsablePoint(saved.points))
    failMap(path, "has no point with coordinates that are numbers up to 10,000 km");
  saved.points = withoutPiles(saved.points);
  return saved;
}

}  // namespace fastlio
