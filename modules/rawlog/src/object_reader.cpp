// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "object_reader.h"

#include <fastlio/archives/rotating_scan_stream.h>
#include <fastlio/archives/size_check.h>
#include <fastlio/compat/mrpt_messages.h>
#include <fastlio/rawlog/recording_formats.h>

#include <mrpt/obs/CAction.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/rtti/CObject.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/system/os.h>

#include <new>
#include <stdexcept>

namespace
{
using fastlio::ReadProblemKind;

bool isRegistered(const std::string& class_name)
{
  return mrpt::rtti::findRegisteredClass(class_name) != nullptr;
}

/** A class that is not known fails where it is read. */
bool derivesFrom(const std::string& class_name, const mrpt::rtti::TRuntimeClassId* base)
{
  const auto* id = mrpt::rtti::findRegisteredClass(class_name);
  return id == nullptr || id->derivedFrom(base);
}

std::string hintFor(ReadProblemKind kind)
{
  switch (kind)
  {
    case ReadProblemKind::NotFound:
      return "Check the path.";
    case ReadProblemKind::NotARawlog:
      return "Give an MRPT rawlog (.rawlog), or a recording of a format that docs/import.md lists.";
    case ReadProblemKind::Truncated:
      return "The recording or a copy of it was cut off; everything before was read.";
    case ReadProblemKind::Corrupt:
      return "Copy the file anew, or check the medium it lies on.";
    case ReadProblemKind::UnknownClass:
      return "This program runs on " + mrpt::system::MRPT_getVersion() +
             "; the recording needs a newer one, or a plugin that knows the class.";
    case ReadProblemKind::ExternalFile:
      return "Keep the folder with the external files beside the rawlog.";
    case ReadProblemKind::NotSupported:
      return "Convert the file with a program that knows it.";
  }
  return {};
}

}  // namespace

namespace fastlio
{
ObjectReader::ObjectReader(std::string path) : path_(std::move(path)) {}

std::uint64_t ObjectReader::compressedPosition() const
{
  return stream_ ? stream_->file().compressedPosition() : 0;
}

ReadProblem ObjectReader::makeProblem(
    ReadProblemKind kind, const std::string& class_name, const std::string& what) const
{
  const bool has_place = kind != ReadProblemKind::NotFound && kind != ReadProblemKind::NotARawlog;
  std::string message = path_ + ": ";
  if (has_place)
    message += "object " + std::to_string(index_) +
               (class_name.empty() ? "" : " (" + class_name + ")") + " at byte " +
               std::to_string(object_offset_) + ": ";
  message += what + ". " + hintFor(kind);
  return {path_, kind, class_name, message};
}

NextObject ObjectReader::next()
{
  if (finished_) return EndOfRecording{};
  if (!stream_)
  {
    finished_ = true;  // unless the file can be opened
    if (const auto problem = recordingProblem(path_))
      return makeProblem(ReadProblemKind::NotFound, "", *problem);
    try
    {
      stream_ = std::make_unique<ObjectStream>(path_);
    }
    catch (const std::runtime_error& e)
    {
      return makeProblem(ReadProblemKind::NotFound, "", std::string("the file ") + e.what());
    }
    finished_ = false;
  }
  return readOne();
}

NextObject ObjectReader::readOne()
{
  for (;; ++index_)
  {
    if (recovered_) skipFrameEnds();
    stream_->beginObject();
    object_offset_ = stream_->position();
    if (stream_->atEnd()) return atEndOfFile();
    const auto header = stream_->peekHeader();
    if (!header && stream_->endsInsideHeader(0))
      return fail(makeProblem(ReadProblemKind::Truncated, "", "the file ends inside its header"));
    if (!header) return fail(diagnose("", "there is no object where one should start"));
    if (header->class_name != "nullptr" && !isRegistered(header->class_name))
      return fail(
          makeProblem(ReadProblemKind::UnknownClass, header->class_name, "its class is not known"));
    const SizeVerdict sizes = checkSizes(*stream_);
    if (sizes == SizeVerdict::RunsOut) return fail(diagnoseEnd(header->class_name));
    if (sizes == SizeVerdict::Misaligned)
      return fail(makeProblem(
          ReadProblemKind::Corrupt, header->class_name, "it does not end where its lengths say"));
    try
    {
      auto object = readObject(*header);
      if (!object) continue;
      ++index_;
      return object;
    }
    catch (const std::bad_alloc&)
    {
      return fail(makeProblem(
          ReadProblemKind::Corrupt, header->class_name, "it asks for more memory than there is"));
    }
    catch (const std::exception& e)
    {
      return fail(diagnose(header->class_name, innermostMessage(e.what())));
    }
  }
}

// MRPT reads rotating scans of its own layout only, and in frames and collections whatever stands
// there: frames in frames, of any length and depth, or what is no action, which ends the program.
mrpt::serialization::CSerializable::Ptr ObjectReader::readObject(const ObjectHeader& header)
{
  auto archive = mrpt::serialization::archiveFrom(*stream_);
  const auto* id = mrpt::rtti::findRegisteredClass(header.class_name);
  const bool is_frame = id == CLASS_ID(mrpt::obs::CSensoryFrame);
  const bool is_collection = id == CLASS_ID(mrpt::obs::CActionCollection);
  const bool is_scan = header.class_name == kRotatingScanClass;
  if (!is_frame && !is_collection && !is_scan) return archive.ReadObject();
  // And the version, which is the same in all layouts.
  std::vector<std::uint8_t> head(header.length + 1);
  archive.ReadBuffer(head.data(), head.size());
  mrpt::serialization::CSerializable::Ptr object;
  if (is_frame)
    object = readFrame(archive);
  else if (is_collection)
    object = readCollection(archive);
  else
    object = readRotatingScan(archive);
  if (archive.ReadAs<std::uint8_t>() != kEndFlag)
    throw std::runtime_error("the object does not end where it should");
  return object;
}

template <typename Take>
void ObjectReader::readParts(
    mrpt::serialization::CArchive& archive, const mrpt::rtti::TRuntimeClassId* base,
    const Take& take)
{
  const auto count = archive.ReadAs<std::uint32_t>();  // checkSizes() has bounded it
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const auto header = stream_->peekHeader();
    if (header && !derivesFrom(header->class_name, base))
      throw std::runtime_error("it holds an object of class " + header->class_name);
    take(header ? readObject(*header) : archive.ReadObject());
  }
}

mrpt::serialization::CSerializable::Ptr ObjectReader::readFrame(
    mrpt::serialization::CArchive& archive)
{
  auto frame = mrpt::obs::CSensoryFrame::Create();
  readParts(
      archive, CLASS_ID(mrpt::obs::CObservation),
      [&](const mrpt::serialization::CSerializable::Ptr& object)
      {
        if (auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object))
          frame->insert(observation);
      });
  return frame;
}

/** Nobody asks for the actions in it. */
mrpt::serialization::CSerializable::Ptr ObjectReader::readCollection(
    mrpt::serialization::CArchive& archive)
{
  readParts(archive, CLASS_ID(mrpt::obs::CAction), [](const auto& /*action*/) {});
  return mrpt::obs::CActionCollection::Create();
}

NextObject ObjectReader::atEndOfFile()
{
  finished_ = true;
  switch (stream_->file().end())
  {
    case FileEnd::Truncated:
      return makeProblem(ReadProblemKind::Truncated, "", "the compressed data end too early");
    case FileEnd::Corrupt:
      return makeProblem(ReadProblemKind::Corrupt, "", "the compressed data are damaged");
    case FileEnd::NotYet:
    case FileEnd::Clean:
      break;
  }
  if (index_ == 0 && !recovered_)
    return makeProblem(ReadProblemKind::NotARawlog, "", "the file is empty");
  return EndOfRecording{};
}

ReadProblem ObjectReader::diagnoseEnd(const std::string& class_name) const
{
  if (stream_->file().end() == FileEnd::Corrupt)
    return makeProblem(
        ReadProblemKind::Corrupt, class_name, "the compressed data are damaged inside it");
  return makeProblem(ReadProblemKind::Truncated, class_name, "the file ends inside it");
}

ReadProblem ObjectReader::diagnose(const std::string& class_name, const std::string& error) const
{
  if (stream_->isTooDeep())
    return makeProblem(
        ReadProblemKind::Corrupt, class_name, "the objects in it are nested too deeply");
  if (stream_->ranOut()) return diagnoseEnd(class_name);
  const auto inner = stream_->lastHeaderRead();
  if (inner && inner->class_name != class_name && !isRegistered(inner->class_name))
    return makeProblem(
        ReadProblemKind::UnknownClass, inner->class_name,
        "the class of a part of " + (class_name.empty() ? "it" : class_name) + " is not known");
  return makeProblem(ReadProblemKind::Corrupt, class_name, error);
}

// Decides whether and where reading goes on, and with that what the problem really was: a file that
// ends inside an object and yet holds further ones is not truncated, its object lies about its
// size; and one that starts with no object and holds none is no rawlog.
NextObject ObjectReader::fail(ReadProblem problem)
{
  const bool at_start = index_ == 0 && object_offset_ == 0;
  // What was nested too deeply would be so from each of its parts on: the search begins behind.
  if (!stream_->isTooDeep())
  {
    stream_->rewindTo(0);
    stream_->rewindTo(problem.class_name.empty() ? 0 : 1);
  }
  const bool found = stream_->seekNextObservation();
  finished_ = !found;
  if (!found && !at_start && problem.class_name.empty() && stream_->skippedZerosOnly())
    problem = makeProblem(
        ReadProblemKind::Truncated, "",
        "from there to its end the file holds " +
            std::to_string(stream_->position() - object_offset_) +
            " zeros, as after a loss of power");
  if (found && problem.kind == ReadProblemKind::Truncated)
    problem = makeProblem(
        ReadProblemKind::Corrupt, problem.class_name, "it claims to be larger than it can be");
  else if (
      !found && at_start && problem.kind == ReadProblemKind::Corrupt && problem.class_name.empty())
    problem =
        makeProblem(ReadProblemKind::NotARawlog, "", "the content is not a stream of MRPT objects");
  recovered_ = found;
  ++index_;
  return problem;
}

// Behind the observations that were saved from a broken sensory frame comes its end flag.
void ObjectReader::skipFrameEnds()
{
  constexpr std::uint64_t kMostFrameEnds = 1000;  // MRPT does not nest frames; more is damage
  stream_->beginObject();
  const std::uint64_t begin = stream_->position();
  while (!stream_->atEnd() && !stream_->peekHeader())
  {
    unsigned char byte = 0;
    stream_->Read(&byte, 1);
    if (byte != kEndFlag)
    {
      stream_->rewindTo(0);
      return;
    }
    if (stream_->position() - begin > kMostFrameEnds) return;
  }
}

}  // namespace fastlio
