#include "grid/formats/rectangle_lists.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <numeric>
#include <utility>

#include "grid/formats/byte_order.h"
#include "grid_path_planner/base/errors.h"

namespace grid_path_planner::grid {

using base::InputError;

namespace {

constexpr const char* kListNames[] = {"rows", "columns", "widths", "heights", "numbers"};

std::int64_t areaOf(const CellRect& rect) {
  return std::int64_t{rect.width} * rect.height;
}

bool takenEarlier(const CellRect& a, const CellRect& b) {
  if (areaOf(a) != areaOf(b)) return areaOf(a) > areaOf(b);
  if (a.column != b.column) return a.column < b.column;
  const int last_of_a = a.row + a.height, last_of_b = b.row + b.height;
  if (last_of_a != last_of_b) return last_of_a < last_of_b;
  return a.width > b.width;
}

bool liesEarlier(const CellRect& a, const CellRect& b) {
  return std::pair(a.row, a.column) < std::pair(b.row, b.column);
}

// Which columns the rectangles so far cover in the row of the next one.
class Skyline {
 public:
  explicit Skyline(int width) : open_from_(static_cast<std::size_t>(width), 0) {}

  // The next rectangle's first row; never less than before.
  void moveTo(int row) {
    if (row != row_) next_ = 0;
    row_ = row;
  }
  // How many open columns lie between the last rectangle of this row and `column`.
  int openColumnsBefore(int column) const {
    int count = 0;
    for (int i = next_; i < column; ++i) count += open(i) ? 1 : 0;
    return count;
  }
  // The open column with `before` open ones before it; the width where there is none.
  int columnAfter(std::uint32_t before) const {
    const int width = static_cast<int>(open_from_.size());
    for (int i = next_; i < width; ++i)
      if (open(i) && before-- == 0) return i;
    return width;
  }
  void add(const CellRect& rect) {
    const auto first = open_from_.begin() + rect.column;
    std::fill(first, first + rect.width, rect.row + rect.height);
    next_ = rect.column + rect.width;
  }

 private:
  bool open(int column) const { return open_from_[static_cast<std::size_t>(column)] <= row_; }

  std::vector<int> open_from_;  // row
  int row_ = 0;
  int next_ = 0;
};

// The numbers of rectangles ordered by position.
std::vector<std::uint32_t> numbersByPosition(const std::vector<CellRect>& rectangles) {
  std::vector<std::uint32_t> numbers(rectangles.size());
  std::iota(numbers.begin(), numbers.end(), 0U);
  std::sort(numbers.begin(), numbers.end(), [&rectangles](std::uint32_t a, std::uint32_t b) {
    return liesEarlier(rectangles[a], rectangles[b]);
  });
  return numbers;
}

class ListReader {
 public:
  ListReader(const std::string& bytes, const char* name) : bytes_(bytes), name_(name) {}

  std::vector<std::uint32_t> read(std::size_t count) {
    if (bytes_.size() < count) throwEndsEarly();
    std::vector<std::uint32_t> numbers(count);
    for (std::uint32_t& number : numbers) number = nextNumber();
    if (at_ != bytes_.size())
      throwAbout("goes on for " + std::to_string(bytes_.size() - at_) + " bytes after its end");
    return numbers;
  }

 private:
  std::uint32_t nextNumber() {
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < kLongestNumber; ++i) {
      if (at_ == bytes_.size()) throwEndsEarly();
      const auto byte = static_cast<unsigned char>(bytes_[at_++]);
      number |= std::uint64_t{byte & 0x7fU} << (7 * i);
      if (byte > 0x7f) continue;
      if (number > 0xffffffffU) break;
      return static_cast<std::uint32_t>(number);
    }
    throwAbout("has a number of more than 32 bits before its byte " + std::to_string(at_));
  }
  [[noreturn]] void throwEndsEarly() const {
    throwAbout("ends early, at its byte " + std::to_string(bytes_.size()));
  }
  [[noreturn]] void throwAbout(const std::string& what) const {
    throw InputError("its list of " + std::string(name_) + " " + what);
  }

  const std::string& bytes_;
  const char* name_;
  std::size_t at_ = 0;
};

// `less_one` + 1 cells from `first` on, inside `end`.
bool fits(std::uint32_t less_one, int first, int end) {
  return first < end && less_one < static_cast<std::uint32_t>(end - first);
}

using Numbers = std::vector<std::uint32_t>;

std::vector<CellRect> rectanglesByPosition(const Numbers& rows, const Numbers& columns,
                                           const Numbers& widths, const Numbers& heights,
                                           const GridGeometry& geometry) {
  const std::size_t count = rows.size();
  std::vector<CellRect> rectangles(count);
  Skyline skyline(geometry.width());
  std::int64_t row = 0;
  for (std::size_t i = 0; i < count; ++i) {
    row += rows[i];
    const bool row_inside = row < geometry.height();
    if (row_inside) skyline.moveTo(static_cast<int>(row));
    const int column = row_inside ? skyline.columnAfter(columns[i]) : geometry.width();
    if (!row_inside || !fits(widths[i], column, geometry.width()) ||
        !fits(heights[i], static_cast<int>(row), geometry.height()))
      throw InputError("has a rectangle, number " + std::to_string(i) +
                       " by position, that leaves the map of " + std::to_string(geometry.width()) +
                       "x" + std::to_string(geometry.height()) + " cells");
    rectangles[i] = {column, static_cast<int>(row), static_cast<int>(widths[i]) + 1,
                     static_cast<int>(heights[i]) + 1};
    skyline.add(rectangles[i]);
  }
  return rectangles;
}

std::vector<CellRect> inListedOrder(const std::vector<CellRect>& by_position,
                                    const Numbers& numbers) {
  std::vector<CellRect> rectangles(by_position.size());  // empty until they are placed
  for (std::size_t i = 0; i < by_position.size(); ++i) {
    if (numbers[i] >= rectangles.size() || !rectangles[numbers[i]].empty())
      throw InputError("numbers two rectangles " + std::to_string(numbers[i]) +
                       ", or has fewer rectangles than that");
    rectangles[numbers[i]] = by_position[i];
  }
  return rectangles;
}

}  // namespace

RectangleOrder orderOf(const std::vector<CellRect>& rectangles) {
  if (std::is_sorted(rectangles.begin(), rectangles.end(), takenEarlier))
    return RectangleOrder::LARGEST_FIRST;
  if (std::is_sorted(rectangles.begin(), rectangles.end(), liesEarlier))
    return RectangleOrder::BY_POSITION;
  return RectangleOrder::AS_LISTED;
}

std::size_t numberOfLists(RectangleOrder order) {
  return order == RectangleOrder::AS_LISTED ? 5 : 4;
}

std::vector<std::string> listsOf(const std::vector<CellRect>& rectangles,
                                 const GridGeometry& geometry, RectangleOrder order) {
  std::string rows, columns, widths, heights, numbers;
  Skyline skyline(geometry.width());
  int row = 0;
  for (const std::uint32_t number : numbersByPosition(rectangles)) {
    const CellRect& rect = rectangles[number];
    skyline.moveTo(rect.row);
    putVarying(rows, static_cast<std::uint32_t>(rect.row - row));
    putVarying(columns, static_cast<std::uint32_t>(skyline.openColumnsBefore(rect.column)));
    putVarying(widths, static_cast<std::uint32_t>(rect.width - 1));
    putVarying(heights, static_cast<std::uint32_t>(rect.height - 1));
    putVarying(numbers, number);
    skyline.add(rect);
    row = rect.row;
  }
  std::vector<std::string> lists{std::move(rows), std::move(columns), std::move(widths),
                                 std::move(heights), std::move(numbers)};
  lists.resize(numberOfLists(order));
  return lists;
}

std::vector<CellRect> rectanglesOf(const std::vector<std::string>& lists, std::size_t count,
                                   const GridGeometry& geometry, RectangleOrder order) {
  std::vector<Numbers> numbers;
  for (std::size_t i = 0; i < lists.size(); ++i)
    numbers.push_back(ListReader(lists[i], kListNames[i]).read(count));
  std::vector<CellRect> rectangles =
      rectanglesByPosition(numbers[0], numbers[1], numbers[2], numbers[3], geometry);
  if (order == RectangleOrder::AS_LISTED) return inListedOrder(rectangles, numbers[4]);
  if (order == RectangleOrder::LARGEST_FIRST)
    std::sort(rectangles.begin(), rectangles.end(), takenEarlier);
  return rectangles;
}

}  // namespace grid_path_planner::grid
