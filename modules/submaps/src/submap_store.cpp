// mrpt_fastlio: LiDAR-inertial odometry (FAST-LIO) for MRPT.
// SPDX-License-Identifier: BSD-3-Clause

#include <fastlio/files/failure_text.h>
#include <fastlio/submaps/submap_store.h>

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace fastlio
{
SubmapStore::SubmapStore(SubmapStoreOptions options)
    : options_(std::move(options)), folder_(ScratchContent::Submaps, options_.directory)
{
}

std::size_t SubmapStore::planesInMemory() const
{
  const std::lock_guard lock(mutex_);
  return in_memory_;
}

SubmapStoreTroubles SubmapStore::troubles() const
{
  const std::lock_guard lock(mutex_);
  return troubles_;
}

std::size_t SubmapStore::add(SubmapSurfaces surfaces)
{
  const std::lock_guard lock(mutex_);
  Piece& piece = pieces_[added_];
  piece.planes = surfaces.planes.size();
  piece.surfaces = std::make_shared<const SubmapSurfaces>(std::move(surfaces));
  piece.last_use = ++uses_;
  in_memory_ += piece.planes;
  keepWithinMemory();
  return added_++;
}

std::shared_ptr<const SubmapSurfaces> SubmapStore::get(std::size_t number)
{
  const std::lock_guard lock(mutex_);
  Piece& piece = pieces_.at(number);
  piece.last_use = ++uses_;
  if (!piece.surfaces) load(piece);
  std::shared_ptr<const SubmapSurfaces> surfaces = piece.surfaces;
  keepWithinMemory();
  return surfaces;
}

void SubmapStore::forget(std::size_t number)
{
  const std::lock_guard lock(mutex_);
  const auto piece = pieces_.find(number);
  if (piece->second.surfaces) in_memory_ -= piece->second.planes;
  if (piece->second.file) ScratchFolder::remove(*piece->second.file);
  pieces_.erase(piece);
}

/** Out of its file. What cannot be read is empty from here on. */
void SubmapStore::load(Piece& piece)
{
  SubmapSurfaces surfaces;
  surfaces.planes.resize(piece.planes);
  surfaces.spreads.resize(piece.planes);
  try
  {
    folder_.read(*piece.file, surfaces.planes, surfaces.spreads);
  }
  catch (const std::exception& e)
  {
    if (troubles_.not_read.empty()) troubles_.not_read = failureText(e);
    ++troubles_.lost;
    surfaces = {};
    piece.planes = 0;
  }
  piece.surfaces = std::make_shared<const SubmapSurfaces>(std::move(surfaces));
  in_memory_ += piece.planes;
}

void SubmapStore::keepWithinMemory()
{
  while (in_memory_ > options_.planes_in_memory)
  {
    Piece* piece = leastRecentlyUsed();
    if (piece == nullptr) return;
    if (!piece->file) write(*piece);
    if (!piece->file) continue;
    piece->surfaces.reset();
    in_memory_ -= piece->planes;
  }
}

/** Of those that may leave the memory; null: there is none. */
SubmapStore::Piece* SubmapStore::leastRecentlyUsed()
{
  // A disk that has refused one is not asked again: after every submap, it would cost time.
  const bool may_write = troubles_.not_written.empty();
  Piece* least = nullptr;
  for (auto& [number, piece] : pieces_)
  {
    const bool may_leave =
        piece.surfaces && piece.planes > 0 && piece.last_use != uses_ && (piece.file || may_write);
    if (may_leave && (least == nullptr || piece.last_use < least->last_use)) least = &piece;
  }
  return least;
}

void SubmapStore::write(Piece& piece)
{
  try
  {
    // No other piece has the number of this use.
    piece.file = folder_.write(
        std::to_string(piece.last_use), piece.surfaces->planes, piece.surfaces->spreads);
  }
  catch (const std::exception& e)
  {
    troubles_.not_written = failureText(e);
  }
}

/** Makes the store forget the surfaces. */
class StoredSurfaces::Entry
{
 public:
  Entry(std::shared_ptr<SubmapStore> store, SubmapSurfaces surfaces)
      : store_(std::move(store)), number_(store_->add(std::move(surfaces)))
  {
  }
  ~Entry() { store_->forget(number_); }
  Entry(const Entry&) = delete;
  Entry& operator=(const Entry&) = delete;

  [[nodiscard]] std::shared_ptr<const SubmapSurfaces> get() const { return store_->get(number_); }

 private:
  std::shared_ptr<SubmapStore> store_;
  std::size_t number_;
};

StoredSurfaces::StoredSurfaces(const std::shared_ptr<SubmapStore>& store, SubmapSurfaces surfaces)
    : planes_(surfaces.planes.size())
{
  if (surfaces.spreads.size() != planes_)
    throw std::invalid_argument(
        "StoredSurfaces: " + std::to_string(surfaces.spreads.size()) + " spreads of " +
        std::to_string(planes_) + " planes; there has to be one for each");
  entry_ = std::make_shared<const Entry>(store, std::move(surfaces));
}

std::shared_ptr<const SubmapSurfaces> StoredSurfaces::get() const
{
  return entry_ ? entry_->get() : std::make_shared<const SubmapSurfaces>();
}

}  // namespace fastlio
