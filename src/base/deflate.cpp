#include "base/deflate.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::base {
namespace {

constexpr int kWithoutFrame = -MAX_WBITS;
constexpr int kMostMemory = 9;  // zlib's memLevel

// The next piece of `bytes`: zlib counts what it is given in 32 bits.
void offerMore(const std::string& bytes, std::size_t& offered, z_stream& stream) {
  const std::size_t count =
      std::min<std::size_t>(bytes.size() - offered, std::numeric_limits<uInt>::max());
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + offered));
  stream.avail_in = static_cast<uInt>(count);
  offered += count;
}

class Inflater {
 public:
  explicit Inflater(const std::string& packed) : packed_(packed) {
    if (::inflateInit2(&stream_, kWithoutFrame) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { ::inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  std::string run(std::size_t largest) {
    std::string bytes;
    char buffer[1 << 16];
    for (int state = Z_OK; state != Z_STREAM_END;) {
      if (stream_.avail_in == 0) offerMore(packed_, offered_, stream_);
      stream_.next_out = reinterpret_cast<Bytef*>(buffer);
      stream_.avail_out = sizeof buffer;
      state = ::inflate(&stream_, Z_NO_FLUSH);
      if (state == Z_MEM_ERROR) throw std::bad_alloc();
      if (state == Z_BUF_ERROR) throw InputError("ends early");
      if (state != Z_OK && state != Z_STREAM_END)
        throw InputError(stream_.msg ? std::string("is damaged: ") + stream_.msg : "is damaged");
      bytes.append(buffer, sizeof buffer - stream_.avail_out);
      if (bytes.size() > largest)
        throw InputError("unpacks to more than " + std::to_string(largest) + " bytes");
    }
    if (stream_.avail_in > 0 || offered_ < packed_.size())
      throw InputError("goes on after its end");
    return bytes;
  }

 private:
  const std::string& packed_;
  std::size_t offered_ = 0;
  z_stream stream_{};
};

std::string deflatedBy(int strategy, const std::string& bytes) {
  z_stream stream{};
  if (::deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kWithoutFrame, kMostMemory,
                     strategy) != Z_OK)
    throw std::bad_alloc();
  std::string packed;
  char buffer[1 << 16];
  std::size_t offered = 0;
  for (int state = Z_OK; state != Z_STREAM_END;) {
    if (stream.avail_in == 0) offerMore(bytes, offered, stream);
    stream.next_out = reinterpret_cast<Bytef*>(buffer);
    stream.avail_out = sizeof buffer;
    state = ::deflate(&stream, offered == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    packed.append(buffer, sizeof buffer - stream.avail_out);
  }
  ::deflateEnd(&stream);
  return packed;
}

}  // namespace

std::string deflated(const std::string& bytes) {
  std::string smallest = deflatedBy(Z_DEFAULT_STRATEGY, bytes);
  for (const int strategy : {Z_FILTERED, Z_HUFFMAN_ONLY, Z_RLE}) {
    std::string packed = deflatedBy(strategy, bytes);
    if (packed.size() < smallest.size()) smallest = std::move(packed);
  }
  return smallest;
}

std::string inflated(const std::string& packed, std::size_t largest) {
  return Inflater(packed).run(largest);
}

}  // namespace grid_path_planner::base
