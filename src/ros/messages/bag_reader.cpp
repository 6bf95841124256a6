#include "ros/messages/bag_reader.h"

#include <rosbag/chunked_file.h>
#include <rosbag/stream.h>

#include <algorithm>
#include <map>
#include <optional>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::nodes {

using base::InputError;

namespace {

constexpr std::string_view kSignature = "#ROSBAG V2.0\n";
constexpr std::string_view kAnySignature = "#ROSBAG";
constexpr std::uint32_t kLongestHeader = 1u << 16;      // bytes; those of rosbag take some hundred
constexpr std::uint32_t kLongestConnection = 1u << 24;  // bytes of its definition
constexpr std::uint32_t kLargestChunk = 1u << 30;       // bytes, unpacked

// What is kept of a record, and what reading a connection's fields takes for each byte of them.
constexpr std::size_t kBytesOfChunk = 256, kBytesOfIndex = 64, kBytesOfConnection = 256;
constexpr std::size_t kMostOfConnection = 32;
constexpr std::uint32_t kRecordsBetweenQuestions = 64;

enum Operation : unsigned char {
  MESSAGE = 0x02,
  BAG_HEADER = 0x03,
  INDEX = 0x04,
  CHUNK = 0x05,
  CHUNK_INFO = 0x06,
  CONNECTION = 0x07,
};

[[noreturn]] void throwDamaged(const std::string& what) {
  throw InputError("is damaged or cut short: " + what);
}

std::uint64_t littleEndian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;)
    value = (value << 8) | static_cast<unsigned char>(bytes[i]);
  return value;
}

// Reads from the front of some bytes, never more than there are.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}

  bool atEnd() const { return rest_.empty(); }
  std::string_view take(std::size_t count) {
    if (count > rest_.size()) throwDamaged("a length goes beyond the end of its record");
    const std::string_view piece = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return piece;
  }
  std::string_view takeBlock() { return take(littleEndian(take(4))); }

 private:
  std::string_view rest_;
};

// The fields "name=value" of a record's header.
class Fields {
 public:
  explicit Fields(std::string_view header) {
    for (Cursor cursor(header); !cursor.atEnd();) {
      const std::string_view field = cursor.takeBlock();
      const std::size_t equals = field.find('=');
      if (equals == std::string_view::npos) throwDamaged("a header field has no '='");
      fields_[std::string(field.substr(0, equals))] = std::string(field.substr(equals + 1));
    }
  }

  bool has(const std::string& name) const { return fields_.count(name) != 0; }
  const std::string& text(const std::string& name) const {
    const auto field = fields_.find(name);
    if (field == fields_.end()) throwDamaged("a header has no field '" + name + "'");
    return field->second;
  }
  // Of exactly `bytes` bytes.
  std::uint64_t number(const std::string& name, std::size_t bytes) const {
    const std::string& value = text(name);
    if (value.size() != bytes) throwDamaged("the header field '" + name + "' is no number");
    return littleEndian(value);
  }
  std::uint32_t id() const { return static_cast<std::uint32_t>(number("conn", 4)); }
  unsigned char operation() const { return static_cast<unsigned char>(number("op", 1)); }
  // Seconds, then nanoseconds.
  std::int64_t time() const {
    const std::uint64_t both = number("time", 8);
    return static_cast<std::int64_t>((both & 0xffffffffu) * 1'000'000'000u + (both >> 32));
  }

 private:
  std::map<std::string, std::string> fields_;
};

BagConnection connectionFrom(const Fields& header, std::string_view data) {
  const Fields fields(data);
  return {header.id(), header.text("topic"), fields.text("type"), fields.text("md5sum")};
}

// A bag's bytes, with its length known and checked.
class BagFile {
 public:
  explicit BagFile(const base::RegularFile& file) : file_(file) {}

  std::uint64_t size() const { return file_.size(); }
  std::string read(std::uint64_t begin, std::uint64_t count) const {
    if (begin > size() || count > size() - begin) throwDamaged("the file ends within a record");
    std::string bytes = file_.read(begin, count);
    if (bytes.size() != count) throwDamaged("reading ends early");
    return bytes;
  }

 private:
  const base::RegularFile& file_;
};

void checkSignature(const BagFile& in) {
  const std::string begin = in.read(0, std::min<std::uint64_t>(in.size(), kSignature.size()));
  if (begin == kSignature) return;
  if (begin.substr(0, kAnySignature.size()) == kAnySignature)
    throw InputError("is a bag of another format than 2.0, or cut short");
  throw InputError("is not a bag");
}

void checkBagHeader(const Fields& header) {
  if (header.has("encryptor") && !header.text("encryptor").empty())
    throw InputError("is encrypted by " + header.text("encryptor"));
  if (header.number("index_pos", 8) == 0)
    throw InputError("was not closed when it was recorded (`rosbag reindex` may mend it)");
}

struct Record {
  Fields header;
  std::uint64_t data;  // begin in the file
  std::uint64_t size;  // bytes of data
};

// The record that begins at `at`; its data need not be read, but is there.
Record recordAt(std::uint64_t at, const BagFile& in) {
  const std::uint64_t header_size = littleEndian(in.read(at, 4));
  if (header_size > kLongestHeader) throwDamaged("a record's header is too long");
  const std::uint64_t data = at + 4 + header_size + 4;
  const std::uint64_t size = littleEndian(in.read(data - 4, 4));
  if (size > in.size() - data) throwDamaged("the file ends within a record");
  return {Fields(in.read(at + 4, header_size)), data, size};
}

template <class Action>
auto inFile(const std::string& file, const Action& action) {
  try {
    return action();
  } catch (const InputError& error) {
    const std::string text = error.what();
    if (text.compare(0, file.size() + 1, file + ":") == 0) throw;  // of the limits
    throw InputError(file, text);
  }
}

BagReader::Chunk chunkFrom(const Record& record) {
  return {record.data,
          static_cast<std::uint32_t>(record.size),
          static_cast<std::uint32_t>(record.header.number("size", 4)),
          record.header.text("compression"),
          {}};
}

}  // namespace

BagReader::BagReader(const std::string& file, const base::ReadLimits& limits)
    : file_(file), limits_(limits), bytes_(std::make_shared<const base::RegularFile>(file)) {
  limits_.start();
  inFile(file, [this] { walk(); });
}

void BagReader::walk() {
  const BagFile in(*bytes_);
  checkSignature(in);
  std::optional<Fields> bag_header;
  std::size_t chunk_infos = 0;
  base::ReadPoll poll(limits_, file_, kRecordsBetweenQuestions);
  for (std::uint64_t at = kSignature.size(); at < in.size();) {
    poll();
    const Record record = recordAt(at, in);
    at = record.data + record.size;
    switch (record.header.operation()) {
      case BAG_HEADER:
        bag_header = record.header;
        break;
      case CHUNK:
        take(kBytesOfChunk);
        chunks_.push_back(chunkFrom(record));
        break;
      case INDEX:
        take(kBytesOfIndex);
        if (!chunks_.empty()) chunks_.back().connections.insert(record.header.id());
        break;
      case CONNECTION:
        if (record.size > kLongestConnection) throwDamaged("a connection's definition is too long");
        limits_.check(file_, kMostOfConnection * record.size);
        take(kBytesOfConnection + record.size);
        connections_.push_back(connectionFrom(record.header, in.read(record.data, record.size)));
        break;
      case CHUNK_INFO:
        ++chunk_infos;
        break;
      default:
        break;
    }
    if (!bag_header) throwDamaged("it does not begin with a bag header");
    checkBagHeader(*bag_header);
  }
  // The last records of a bag are one for each chunk.
  if (!bag_header || chunk_infos != bag_header->number("chunk_count", 4))
    throwDamaged("its index does not hold what its header says");
}

void BagReader::visit(const std::set<std::uint32_t>& wanted, const Visit& visit) const {
  inFile(file_, [&] {
    for (const Chunk& chunk : chunks_) {
      const bool has_any = std::any_of(chunk.connections.begin(), chunk.connections.end(),
                                       [&](std::uint32_t id) { return wanted.count(id) != 0; });
      if (has_any && !visitChunk(chunk, wanted, visit)) return;
    }
  });
}

// Whether `visit` wants more.
bool BagReader::visitChunk(const Chunk& chunk, const std::set<std::uint32_t>& wanted,
                           const Visit& visit) const {
  limits_.goOn(file_);
  const std::string content = unpack(chunk);
  base::ReadPoll poll(limits_, file_);
  for (Cursor cursor(content); !cursor.atEnd();) {
    poll();
    const Fields header(cursor.takeBlock());
    const std::string_view data = cursor.takeBlock();
    if (header.operation() != MESSAGE || wanted.count(header.id()) == 0) continue;
    limits_.check(file_, content.size() + data.size());
    if (!visit({header.id(), header.time(), data})) return false;
  }
  return true;
}

std::string BagReader::unpack(const Chunk& chunk) const {
  limits_.check(file_, std::size_t{chunk.packed} + chunk.unpacked);
  std::string packed = BagFile(*bytes_).read(chunk.begin, chunk.packed);
  if (chunk.compression == "none") return packed;
  if (chunk.compression != "bz2" && chunk.compression != "lz4")
    throwDamaged("no such compression: '" + chunk.compression + "'");
  if (chunk.unpacked > kLargestChunk) throwDamaged("a chunk is larger than 1 GB");
  std::string content(chunk.unpacked, '\0');
  rosbag::ChunkedFile none;
  const auto type =
      chunk.compression == "bz2" ? rosbag::compression::BZ2 : rosbag::compression::LZ4;
  try {
    rosbag::StreamFactory(&none).getStream(type)->decompress(
        reinterpret_cast<std::uint8_t*>(content.data()), chunk.unpacked,
        reinterpret_cast<std::uint8_t*>(packed.data()), chunk.packed);
  } catch (const std::exception& error) {
    throwDamaged(error.what());
  }
  return content;
}

}  // namespace grid_path_planner::nodes
