// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "faults.h"

#include <algorithm>

namespace fastlio::testing
{
namespace
{
std::string withFlippedBits(std::string bytes, std::size_t flips, Random& random)
{
  for (std::size_t i = 0; i < flips; ++i)
    bytes[random() % bytes.size()] ^= static_cast<char>(1U << (random() % 8));
  return bytes;
}

/** Offsets within an object that are of different kinds: header, name, version, count, data, end.
 */
std::size_t placeInObject(const RawlogBytes& rawlog, std::size_t index, std::size_t object)
{
  const std::size_t begin = rawlog.begins[object];
  const std::size_t end =
      object + 1 < rawlog.begins.size() ? rawlog.begins[object + 1] : rawlog.bytes.size();
  const std::size_t places[] = {0, 1, 5, 31, 32, 33, 40, 60, 120, end - begin - 2, end - begin - 1};
  return std::min(begin + places[index % 11], end - 1);
}

std::size_t objectAt(const RawlogBytes& rawlog, std::size_t index, std::size_t count)
{
  return (index + 1) * (rawlog.begins.size() - 1) / (count + 1);
}
}  // namespace

std::vector<FileFault> fileFaults()
{
  return {
      {"one bit flipped, plain rawlog", 60,
       [](const RawlogBytes& rawlog, std::size_t, Random& random)
       { return withFlippedBits(rawlog.bytes, 1, random); },
       false},
      {"a hundred bits flipped, plain rawlog", 20,
       [](const RawlogBytes& rawlog, std::size_t, Random& random)
       { return withFlippedBits(rawlog.bytes, 100, random); },
       false},
      {"one bit flipped at a place of each kind in an object", 33,
       [](const RawlogBytes& rawlog, std::size_t index, Random& random)
       {
         std::string bytes = rawlog.bytes;
         bytes[placeInObject(rawlog, index, objectAt(rawlog, index, 33))] ^=
             static_cast<char>(1U << (random() % 8));
         return bytes;
       },
       false},
      {"one bit flipped, compressed rawlog", 30,
       [](const RawlogBytes& rawlog, std::size_t, Random& random)
       { return withFlippedBits(gzipped(rawlog.bytes), 1, random); },
       false},  // of the header, some say nothing about the data
      {"truncated at a place of each kind in an object", 33,
       [](const RawlogBytes& rawlog, std::size_t index, Random&) {
         return rawlog.bytes.substr(0, placeInObject(rawlog, index, objectAt(rawlog, index, 33)));
       },
       false},  // between two objects, a file may end
      {"truncated, compressed rawlog", 12,
       [](const RawlogBytes& rawlog, std::size_t index, Random&)
       {
         const std::string bytes = gzipped(rawlog.bytes);
         return bytes.substr(
             0, index < 4 ? bytes.size() - 1 - 3 * index : index * bytes.size() / 12);
       }},
      {"a stretch of bytes lost", 12,
       [](const RawlogBytes& rawlog, std::size_t, Random& random)
       {
         std::string bytes = rawlog.bytes;
         return bytes.erase(random() % bytes.size(), 1 + random() % 20000);
       }},
      {"a stretch of zeros", 12,
       [](const RawlogBytes& rawlog, std::size_t, Random& random)
       {
         std::string bytes = rawlog.bytes;
         const std::size_t begin = random() % (bytes.size() - 4096);
         return bytes.replace(begin, 4096, 4096, '\0');
       },
       false},
      {"another file in the middle", 4,
       [](const RawlogBytes& rawlog, std::size_t index, Random& random)
       {
         std::string junk(10000, ' ');
         for (char& c : junk)
           c = static_cast<char>(random());
         std::string bytes = rawlog.bytes;
         return bytes.insert((index + 1) * bytes.size() / 5, junk);
       }},
  };
}

}  // namespace fastlio::testing
