// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include "external_storage.h"
#include "object_reader.h"
#include "time_sorter.h"
#include <fastlio/compat/register_classes.h>
#include <fastlio/math/time.h>
#include <fastlio/rawlog/rawlog_source.h>
#include <fastlio/rawlog/recording_formats.h>
#include <fastlio/recordings/recording_reader.h>

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/rtti/CObject.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace
{
using mrpt::obs::CObservation;

// An observation is itself, a frame is what it holds; actions and others are nothing.
std::vector<CObservation::Ptr> observationsOf(const mrpt::serialization::CSerializable::Ptr& object)
{
  if (auto single = std::dynamic_pointer_cast<CObservation>(object)) return {single};
  std::vector<CObservation::Ptr> observations;
  if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object))
    for (const auto& observation : *frame)
      if (observation) observations.push_back(observation);
  return observations;
}

bool belongsInARawlog(const mrpt::serialization::CSerializable& object)
{
  return dynamic_cast<const CObservation*>(&object) != nullptr ||
         dynamic_cast<const mrpt::obs::CSensoryFrame*>(&object) != nullptr ||
         dynamic_cast<const mrpt::obs::CActionCollection*>(&object) != nullptr;
}
}  // namespace

namespace fastlio
{
class RawlogSource::Impl
{
 public:
  Impl(std::vector<std::string> files, const RawlogSourceOptions& options)
      : files_(std::move(files)), sorter_(toNanoseconds(options.sorting_window))
  {
    for (const std::string& file : files_)
      bytes_total_ += recordingBytes(file);
  }

  CObservation::Ptr next()
  {
    while (!sorter_.ready() && readMore())
    {
    }
    return sorter_.empty() ? nullptr : sorter_.pop();
  }

  [[nodiscard]] const std::vector<ReadProblem>& problems() const { return problems_; }

  [[nodiscard]] ReadProgress progress() const
  {
    const std::uint64_t at_hand = reader_    ? reader_->compressedPosition()
                                  : foreign_ ? foreign_->position()
                                             : 0;
    return {bytes_of_files_read_ + at_hand, bytes_total_};
  }

 private:
  bool readMore();
  [[nodiscard]] bool open();
  void readForeign();
  void take(const mrpt::serialization::CSerializable::Ptr& object);
  void add(ReadProblem problem);
  void closeFile();

  std::vector<std::string> files_;
  TimeSorter sorter_;
  std::size_t file_ = 0;  // the one at hand
  std::optional<ObjectReader> reader_;
  std::unique_ptr<RecordingReader> foreign_;  // instead of it, for a recording of another format
  std::string foreign_class_;    // of the first object in this file that belongs into no rawlog
  bool rawlog_content_ = false;  // this file has held something that does
  std::uint64_t bytes_of_files_read_ = 0, bytes_total_ = 0;
  std::vector<ReadProblem> problems_;
};

// False when nothing is left to read.
bool RawlogSource::Impl::readMore()
{
  if (file_ == files_.size()) return false;
  if (!reader_ && !foreign_ && !open())
  {
    closeFile();
    return true;
  }
  if (foreign_)
  {
    readForeign();
    return true;
  }
  NextObject next = reader_->next();
  if (auto* object = std::get_if<mrpt::serialization::CSerializable::Ptr>(&next))
    take(*object);
  else if (auto* problem = std::get_if<ReadProblem>(&next))
    add(std::move(*problem));
  else
    closeFile();
  return true;
}

/** False: the file was recognised and cannot be opened. */
bool RawlogSource::Impl::open()
{
  const std::string& file = files_[file_];
  try
  {
    if (const RecordingFormat* format = recordingFormatOf(file)) foreign_ = format->open(file);
  }
  catch (const std::exception& e)
  {
    add({file, ReadProblemKind::NotSupported, "", file + ": the file " + e.what()});
    return false;
  }
  if (!foreign_) reader_.emplace(file);
  return true;
}

void RawlogSource::Impl::readForeign()
{
  NextRecorded next = foreign_->next();
  if (auto* observation = std::get_if<CObservation::Ptr>(&next))
    sorter_.push(std::move(*observation));
  else if (auto* problem = std::get_if<ReadProblem>(&next))
    add(std::move(*problem));
  else
    closeFile();
}

void RawlogSource::Impl::take(const mrpt::serialization::CSerializable::Ptr& object)
{
  if (belongsInARawlog(*object))
    rawlog_content_ = true;
  else if (foreign_class_.empty())
    foreign_class_ = object->GetRuntimeClass()->className;
  for (auto& observation : observationsOf(object))
  {
    if (auto error = loadExternal(*observation, files_[file_]))
      add(
          {files_[file_], ReadProblemKind::ExternalFile, observation->GetRuntimeClass()->className,
           *error});
    else
      sorter_.push(std::move(observation));
  }
}

void RawlogSource::Impl::add(ReadProblem problem)
{
  rawlog_content_ |= problem.kind != ReadProblemKind::NotFound;  // it speaks for itself
  const auto same = std::find_if(
      problems_.begin(), problems_.end(),
      [&](const ReadProblem& p) {
        return p.file == problem.file && p.kind == problem.kind &&
               p.class_name == problem.class_name;
      });
  if (same != problems_.end())
    ++same->occurrences;
  else
    problems_.push_back(std::move(problem));
}

void RawlogSource::Impl::closeFile()
{
  if (!rawlog_content_ && !foreign_class_.empty())
    add(
        {files_[file_], ReadProblemKind::NotARawlog, foreign_class_,
         files_[file_] + ": this is not a rawlog, it holds an object of class " + foreign_class_ +
             ". Give a file with observations."});
  bytes_of_files_read_ += recordingBytes(files_[file_]);
  reader_.reset();
  foreign_.reset();
  foreign_class_.clear();
  rawlog_content_ = false;
  ++file_;
}

RawlogSource::RawlogSource(std::vector<std::string> files, RawlogSourceOptions options)
{
  if (files.empty()) throw std::invalid_argument("No rawlog file was given; give at least one.");
  if (!(options.sorting_window >= 0.0))
    throw std::invalid_argument(
        "RawlogSourceOptions.sorting_window is " + std::to_string(options.sorting_window) +
        " s; give zero or more.");
  registerBridgeClasses();
  impl_ = std::make_unique<Impl>(std::move(files), options);
}

RawlogSource::~RawlogSource() = default;
RawlogSource::RawlogSource(RawlogSource&&) noexcept = default;
RawlogSource& RawlogSource::operator=(RawlogSource&&) noexcept = default;

CObservation::Ptr RawlogSource::next()
{
  return impl_->next();
}
const std::vector<ReadProblem>& RawlogSource::problems() const
{
  return impl_->problems();
}
ReadProgress RawlogSource::progress() const
{
  return impl_->progress();
}

}  // namespace fastlio
