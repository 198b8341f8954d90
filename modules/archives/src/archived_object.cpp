// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/archives/archived_object.h>
#include <fastlio/archives/size_check.h>
#include <fastlio/compat/mrpt_messages.h>
#include <fastlio/options/printable.h>

#include <mrpt/rtti/CObject.h>
#include <mrpt/serialization/CArchive.h>

#include <new>
#include <stdexcept>

namespace fastlio
{
namespace
{
using mrpt::serialization::CSerializable;

[[noreturn]] void failObject(const std::string& why)
{
  throw std::runtime_error(why);
}

/** The reason why the reading stopped. */
[[noreturn]] void failReading(const ObjectStream& stream, const std::string& why)
{
  if (stream.file().end() == FileEnd::Corrupt) failObject("has damaged compressed data");
  if (stream.isTooDeep()) failObject("is damaged: the objects in it are nested too deeply");
  if (stream.ranOut()) failObject("is cut off: it ends inside its object");
  failObject("is damaged: " + printable(why));
}
}  // namespace

CSerializable::Ptr readObjectHere(ObjectStream& stream)
{
  const auto header = stream.peekHeader();
  if (!header) failObject("is no archive of MRPT");
  if (mrpt::rtti::findRegisteredClass(header->class_name) == nullptr)
    failObject("holds an object of class " + header->class_name + ", which is not known here");
  switch (checkSizes(stream))
  {
    case SizeVerdict::RunsOut:
      if (stream.file().end() == FileEnd::Corrupt) failObject("has damaged compressed data");
      failObject("is cut off: it ends inside its object, or the object claims to be too large");
    case SizeVerdict::Misaligned:
      failObject("is damaged: its object does not end where its lengths say");
    case SizeVerdict::Plausible:
      break;
  }
  try
  {
    auto archive = mrpt::serialization::archiveFrom(stream);
    return archive.ReadObject();
  }
  catch (const std::bad_alloc&)
  {
    failReading(stream, "it asks for more memory than there is");
  }
  catch (const std::exception& e)
  {
    failReading(stream, innermostMessage(e.what()));
  }
}

CSerializable::Ptr readArchivedObject(const std::string& path)
{
  ObjectStream stream(path);
  return readObjectHere(stream);
}

}  // namespace fastlio
