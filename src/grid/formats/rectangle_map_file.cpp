#include "grid/formats/rectangle_map_file.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/deflate.h"
#include "grid/formats/byte_order.h"
#include "grid/formats/rectangle_lists.h"
#include "grid_path_planner/base/errors.h"
#include "grid_path_planner/grid/map_file.h"

namespace grid_path_planner::grid {

using base::deflated, base::inflated, base::InputError, base::ReadLimits, base::readWithin;

namespace {

constexpr char kName[] = "RECTMAP";
constexpr std::size_t kNameSize = sizeof kName - 1;
constexpr int kFormat = 1;
constexpr std::size_t kHeaderSize = 61;
constexpr std::size_t kChecksumSize = 4;
constexpr std::size_t kListSize = 5;  // bytes of a list's length
constexpr std::int8_t kFree = 0, kOccupied = 100;
constexpr std::size_t kMostOfDeflatedByte = 1032;  // what one may unpack to, by zlib's manual

struct Header {
  GridGeometry geometry;
  std::size_t rectangles = 0;
  RectangleOrder order = RectangleOrder::AS_LISTED;
  std::size_t body = 0;  // bytes
};

std::uint64_t checksumOf(const std::string& bytes, std::size_t size) {
  return ::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), size);
}

std::string headerText(const Header& header) {
  std::string bytes(kName);
  putInteger(bytes, kFormat, 1);
  putInteger(bytes, static_cast<std::uint64_t>(header.geometry.width()), 4);
  putInteger(bytes, static_cast<std::uint64_t>(header.geometry.height()), 4);
  putDouble(bytes, header.geometry.resolution());
  putDouble(bytes, header.geometry.origin().x);
  putDouble(bytes, header.geometry.origin().y);
  putDouble(bytes, header.geometry.origin().yaw);
  putInteger(bytes, header.rectangles, 4);
  putInteger(bytes, static_cast<std::uint64_t>(header.order), 1);
  putInteger(bytes, header.body, 8);
  return bytes;
}

void checkFormat(const std::string& content) {
  const std::size_t size = std::min(content.size(), kNameSize);
  if (content.compare(0, size, kName, size) != 0)
    throw InputError("is not a rectangle file: it does not begin with " + std::string(kName));
  if (content.size() <= kNameSize) return;
  const std::uint64_t format = integerAt(content, kNameSize, 1);
  if (format != kFormat)
    throw InputError("has format number " + std::to_string(format) + ", expected " +
                     std::to_string(kFormat));
}

// Nothing in the file is believed before its size and its checksum are as they should be.
void checkWhole(const std::string& content) {
  const std::string ends = "ends early, at byte " + std::to_string(content.size());
  if (content.size() < kHeaderSize) throw InputError(ends + ", inside its header");
  const std::uint64_t body = integerAt(content, kHeaderSize - 8, 8);
  const std::size_t frame = kHeaderSize + kChecksumSize;
  if (body > kLargestMapFile)
    throw InputError("is damaged: its header speaks of a body of " + std::to_string(body) +
                     " bytes");
  if (content.size() < frame + body) throw InputError(ends + " of " + std::to_string(frame + body));
  if (content.size() > frame + body)
    throw InputError("goes on for " + std::to_string(content.size() - frame - body) +
                     " bytes after its end at byte " + std::to_string(frame + body));
  const std::size_t end = content.size() - kChecksumSize;
  if (integerAt(content, end, kChecksumSize) != checksumOf(content, end))
    throw InputError("is damaged: its checksum differs");
}

Header headerOf(const std::string& content) {
  const auto side = [&content](std::size_t at) {
    return static_cast<int>(std::min<std::uint64_t>(integerAt(content, at, 4), 0x7fffffffU));
  };
  const GridGeometry geometry(
      side(8), side(12), doubleAt(content, 16),
      {doubleAt(content, 24), doubleAt(content, 32), doubleAt(content, 40)});
  const std::uint64_t rectangles = integerAt(content, 48, 4), order = integerAt(content, 52, 1),
                      body = integerAt(content, 53, 8);
  if (rectangles > geometry.size() || rectangles > kMostOfDeflatedByte * body)
    throw InputError("speaks of " + std::to_string(rectangles) + " rectangles, more than " +
                     std::to_string(geometry.size()) + " cells and " + std::to_string(body) +
                     " bytes can hold");
  if (order > static_cast<std::uint64_t>(RectangleOrder::AS_LISTED))
    throw InputError("has an unknown order of rectangles, " + std::to_string(order));
  return {geometry, rectangles, static_cast<RectangleOrder>(order), body};
}

std::vector<CellRect> withoutEmpty(std::vector<CellRect> rectangles) {
  rectangles.erase(std::remove_if(rectangles.begin(), rectangles.end(),
                                  [](const CellRect& rect) { return rect.empty(); }),
                   rectangles.end());
  return rectangles;
}

std::string bodyOf(const std::vector<std::string>& lists) {
  std::string body;
  for (const std::string& list : lists) {
    const std::string packed = deflated(list);
    putInteger(body, packed.size(), kListSize);
    body += packed;
  }
  return body;
}

std::string unpackedList(const std::string& packed, std::size_t rectangles) {
  try {
    return inflated(packed, kLongestNumber * rectangles);
  } catch (const InputError& error) {
    throw InputError(std::string("has a packed list that ") + error.what());
  }
}

// The lists of a body that holds `count` of them, of `rectangles` numbers each.
std::vector<std::string> listsIn(const std::string& body, std::size_t count,
                                 std::size_t rectangles) {
  std::vector<std::string> lists;
  std::size_t at = 0;
  while (lists.size() < count) {
    if (body.size() - at < kListSize) throw InputError("its body ends early");
    const std::uint64_t size = integerAt(body, at, kListSize);
    at += kListSize;
    if (size > body.size() - at) throw InputError("its body ends early");
    lists.push_back(unpackedList(body.substr(at, size), rectangles));
    at += size;
  }
  if (at != body.size()) throw InputError("its body goes on after its lists");
  return lists;
}

RectangleMap rectanglesIn(const std::string& content, const Header& header) {
  const std::vector<std::string> lists = listsIn(content.substr(kHeaderSize, header.body),
                                                 numberOfLists(header.order), header.rectangles);
  return {header.geometry, rectanglesOf(lists, header.rectangles, header.geometry, header.order)};
}

// Of `count` rectangles: what unpacks their lists, the numbers in these, the rectangles themselves twice.
std::size_t bytesOfLists(std::size_t count) {
  return count * (5 * (2 * kLongestNumber + sizeof(std::uint32_t)) + 2 * sizeof(CellRect));
}

RectangleMap rectanglesWithin(const std::string& content, const std::string& file,
                              ReadLimits& limits) {
  Header header;
  try {
    checkFormat(content);
    checkWhole(content);
    header = headerOf(content);
  } catch (const InputError& error) {
    throw InputError(file, error.what());
  }
  limits.take(file, 2 * content.size() + bytesOfLists(header.rectangles) +
                        sizeof(int) * static_cast<std::size_t>(header.geometry.width()));
  limits.goOn(file);
  try {
    return rectanglesIn(content, header);
  } catch (const InputError& error) {
    throw InputError(file, error.what());
  }
}

[[noreturn]] void refuseOverlap(const std::string& file, std::size_t number, const CellRect& rect) {
  throw InputError(file, "rectangle " + std::to_string(number) + " [" +
                             std::to_string(rect.column) + ", " + std::to_string(rect.row) + ", " +
                             std::to_string(rect.width) + ", " + std::to_string(rect.height) +
                             "] overlaps another");
}

// False where one of its cells is free already.
bool makeFree(const CellRect& rect, OccupancyGrid& map) {
  for (int row = rect.row; row < rect.row + rect.height; ++row) {
    std::int8_t* first = map.row(row) + rect.column;
    if (std::find(first, first + rect.width, kFree) != first + rect.width) return false;
    std::fill_n(first, rect.width, kFree);
  }
  return true;
}

}  // namespace

std::string rectangleMapContent(const RectangleMap& map) {
  if (map.geometry.size() == 0) throw InputError("a rectangle map without cells has no file");
  const std::vector<CellRect> rectangles = withoutEmpty(map.rectangles);
  const RectangleOrder order = orderOf(rectangles);
  const std::string body = bodyOf(listsOf(rectangles, map.geometry, order));
  std::string content = headerText({map.geometry, rectangles.size(), order, body.size()});
  content += body;
  putInteger(content, checksumOf(content, content.size()), kChecksumSize);
  return content;
}

bool looksLikeRectangleMap(const std::string& content) {
  return content.compare(0, kNameSize, kName) == 0;
}

RectangleMap parseRectangles(const std::string& content, const std::string& file,
                             ReadLimits limits) {
  return readWithin(file, std::move(limits),
                    [&](ReadLimits& within) { return rectanglesWithin(content, file, within); });
}

OccupancyGrid parseRectangleMap(const std::string& content, const std::string& file,
                                const MapFileOptions& options) {
  ReadLimits limits = options.limits;
  const RectangleMap rectangles = rectanglesWithin(content, file, limits);
  const GridGeometry& own = rectangles.geometry;
  const GridGeometry geometry =
      mapGeometry(file, own.width(), own.height(), own.resolution(), own.origin(), options);
  limits.take(file, geometry.size());
  OccupancyGrid map(geometry);
  std::fill(map.values().begin(), map.values().end(), kOccupied);
  for (std::size_t i = 0; i < rectangles.rectangles.size(); ++i)
    if (!makeFree(rectangles.rectangles[i], map)) refuseOverlap(file, i, rectangles.rectangles[i]);
  return map;
}

}  // namespace grid_path_planner::grid
