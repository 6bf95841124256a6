#include "grid_path_planner/mapping/occupancy_bricks.h"

#include <algorithm>
#include <utility>

namespace grid_path_planner::mapping {
namespace {

constexpr Brick::Words kNone{};

Brick::Words allBits() {
  Brick::Words words;
  words.fill(~std::uint64_t{0});
  return words;
}

std::uint64_t bitOf(const octomap::OcTreeKey& key) {
  return std::uint64_t{1} << (8 * (key[0] & 7) + (key[2] & 7));
}

bool equal(const Brick& a, const Brick& b) {
  return a.known == b.known && a.occupied == b.occupied;
}

}  // namespace

Voxel OccupancyBricks::voxel(const octomap::OcTreeKey& key) const {
  const Brick& content = brick(handleOf(BrickKey::of(key)));
  const unsigned y = key[1] & 7;
  if (!(content.known[y] & bitOf(key))) return Voxel::UNKNOWN;
  return content.occupied[y] & bitOf(key) ? Voxel::OCCUPIED : Voxel::FREE;
}

void OccupancyBricks::setVoxel(const octomap::OcTreeKey& key, Voxel state) {
  Brick content = brick(handleOf(BrickKey::of(key)));
  const auto set = [&](std::uint64_t& word, bool value) {
    word = value ? word | bitOf(key) : word & ~bitOf(key);
  };
  set(content.known[key[1] & 7], state != Voxel::UNKNOWN);
  set(content.occupied[key[1] & 7], state == Voxel::OCCUPIED);
  setBrick(BrickKey::of(key), content);
}

void OccupancyBricks::setBrick(BrickKey key, const Brick& content) {
  const Handle uniform = uniformHandle(content);
  if (uniform != kFirstMixed) return replace(key, uniform);
  const Handle present = handleOf(key);
  if (equal(brick(present), content)) return;
  Column& column = changedColumn(key.column());
  if (present < kFirstMixed)
    handleSlot(column, key.z) = allocate(content);
  else
    mixed_[present - kFirstMixed] = content;
}

void OccupancyBricks::fillBrick(BrickKey key, Voxel state) {
  replace(key, state == Voxel::UNKNOWN ? kUnknown : state == Voxel::FREE ? kFree : kOccupied);
}

void OccupancyBricks::clear(double resolution) {
  resolution_ = resolution;
  for (auto& entry : columns_) {
    changedColumn({static_cast<std::uint16_t>(entry.first >> 16),
                   static_cast<std::uint16_t>(entry.first & 0xFFFF)});
    entry.second.handles = {};
  }
  mixed_ = {};
  released_ = {};
}

void OccupancyBricks::restart(double resolution) {
  *this = OccupancyBricks(resolution);
  restarted_ = true;
}

bool OccupancyBricks::drainRestart() {
  return std::exchange(restarted_, false);
}

std::vector<BrickColumn> OccupancyBricks::columns() const {
  std::vector<BrickColumn> present;
  for (const auto& entry : columns_)
    if (!entry.second.handles.empty())
      present.push_back({static_cast<std::uint16_t>(entry.first >> 16),
                         static_cast<std::uint16_t>(entry.first & 0xFFFF)});
  return present;
}

std::vector<BrickColumn> OccupancyBricks::drainChangedColumns() {
  for (const BrickColumn& column : changed_) {
    const auto entry = columns_.find(packed(column));
    entry->second.changed = false;
    if (entry->second.handles.empty()) columns_.erase(entry);
  }
  return std::exchange(changed_, {});
}

std::size_t OccupancyBricks::memoryUsage() const {
  std::size_t bytes =
      sizeof *this + mixed_.size() * sizeof(Brick) + released_.capacity() * sizeof(Handle) +
      changed_.capacity() * sizeof(BrickColumn) + columns_.bucket_count() * sizeof(void*);
  for (const auto& entry : columns_)
    bytes += sizeof entry + sizeof(void*) + entry.second.handles.capacity() * sizeof(Handle);
  return bytes;
}

OccupancyBricks::Handle OccupancyBricks::uniformHandle(const Brick& content) {
  for (const Handle handle : {kUnknown, kFree, kOccupied})
    if (equal(content, uniformBrick(handle))) return handle;
  return kFirstMixed;
}

const Brick& OccupancyBricks::uniformBrick(Handle handle) {
  static const Brick bricks[] = {{kNone, kNone}, {allBits(), kNone}, {allBits(), allBits()}};
  return bricks[handle];
}

OccupancyBricks::Handle OccupancyBricks::handleOf(BrickKey key) const {
  const auto found = columns_.find(packed(key.column()));
  if (found == columns_.end()) return kUnknown;
  const Column& column = found->second;
  const std::size_t index = static_cast<std::size_t>(key.z) - column.lowest;
  return index < column.handles.size() ? column.handles[index] : kUnknown;
}

OccupancyBricks::Handle& OccupancyBricks::handleSlot(Column& column, std::uint16_t z) {
  auto& handles = column.handles;
  if (handles.empty()) column.lowest = z;
  if (z < column.lowest) {
    handles.insert(handles.begin(), column.lowest - z, kUnknown);
    column.lowest = z;
  }
  const std::size_t index = z - column.lowest;
  if (index >= handles.size()) handles.resize(index + 1, kUnknown);
  return handles[index];
}

OccupancyBricks::Column& OccupancyBricks::changedColumn(BrickColumn column) {
  Column& entry = columns_[packed(column)];
  if (!entry.changed) changed_.push_back(column);
  entry.changed = true;
  return entry;
}

void OccupancyBricks::replace(BrickKey key, Handle uniform) {
  const Handle present = handleOf(key);
  if (present == uniform) return;
  Column& column = changedColumn(key.column());
  release(present);
  handleSlot(column, key.z) = uniform;
  auto& handles = column.handles;
  if (uniform == kUnknown &&
      std::all_of(handles.begin(), handles.end(), [](Handle h) { return h == kUnknown; }))
    handles = {};
}

OccupancyBricks::Handle OccupancyBricks::allocate(const Brick& content) {
  if (released_.empty()) {
    mixed_.push_back(content);
    return static_cast<Handle>(mixed_.size() - 1) + kFirstMixed;
  }
  const Handle handle = released_.back();
  released_.pop_back();
  mixed_[handle - kFirstMixed] = content;
  return handle;
}

void OccupancyBricks::release(Handle handle) {
  if (handle >= kFirstMixed) released_.push_back(handle);
}

}  // namespace grid_path_planner::mapping
