// Reads the messages of topics in a bag (format 2.0); a damaged bag is refused.
//
//   const BagReader bag("run.bag");
//   for (const BagConnection& connection : bag.connections())
//     use(connection.topic, connection.type);
//   bag.visit({1, 2}, [](const BagMessage& message) { return message.bytes.size() > 9; });
//
// rosbag_storage trusts the lengths in a file: one wrong byte of a bag's header makes it read beyond
// its buffer and can end the process. Here every length is checked against the bytes that are left.
// Only the decompression of chunks uses rosbag_storage.
//
// The order is that in the file, not by time; rosbag record writes messages as they arrive.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "grid_path_planner/base/files.h"
#include "grid_path_planner/base/read_limits.h"

namespace grid_path_planner::nodes {

struct BagConnection {
  std::uint32_t id = 0;
  std::string topic;
  std::string type;     // "nav_msgs/OccupancyGrid"
  std::string md5_sum;  // of the type's definition
};

struct BagMessage {
  std::uint32_t connection = 0;
  std::int64_t received = 0;  // ns, by the recorder's clock
  std::string_view bytes;
};

class BagReader {
 public:
  // Position of a chunk: messages that are compressed together.
  struct Chunk {
    std::uint64_t begin = 0;     // of its data in the file
    std::uint32_t packed = 0;    // bytes
    std::uint32_t unpacked = 0;  // bytes
    std::string compression;     // "none", "bz2" or "lz4"
    std::set<std::uint32_t> connections;
  };

  // Reads the records of the whole file, without decompression. Throws InputError naming the file
  // where it cannot be read, is no bag of format 2.0, is encrypted, was not closed, is cut short or
  // is damaged, or needs more than `limits`, which are kept.
  explicit BagReader(const std::string& file, const base::ReadLimits& limits = {});

  // By id.
  const std::vector<BagConnection>& connections() const { return connections_; }

  // Calls `visit` with each message of the `connections`, until it returns false. Throws InputError where
  // a chunk that should hold one is damaged.
  using Visit = std::function<bool(const BagMessage& message)>;
  void visit(const std::set<std::uint32_t>& connections, const Visit& visit) const;

 private:
  void walk();
  bool visitChunk(const Chunk& chunk, const std::set<std::uint32_t>& wanted,
                  const Visit& visit) const;
  std::string unpack(const Chunk& chunk) const;
  void take(std::size_t bytes) { limits_.take(file_, bytes); }

  std::string file_;
  base::ReadLimits limits_;
  std::shared_ptr<const base::RegularFile> bytes_;
  std::vector<BagConnection> connections_;
  std::vector<Chunk> chunks_;
};

}  // namespace grid_path_planner::nodes
