// Arrays that a query clears in constant time: an entry counts only if the present query wrote it.
//
//   StampedArray<std::int32_t> roots(10);
//   roots.clear();  // before every query
//   roots.set(3, 17);
//   if (const std::int32_t* root = roots.find(3)) use(*root);
//
// Where the stamp shares a word with the value, the array is the caller's, and QueryStamp is the
// number alone:
//
//   std::vector<std::uint32_t> words(10);
//   QueryStamp<std::uint32_t, 8> stamp;  // above 8 bits of value
//   stamp.next([&] { std::fill(words.begin(), words.end(), 0U); });
//   words[3] = stamp.word() | 17U;
//   if (stamp.wrote(words[3])) use(words[3] & 255U);
//
// Guaranteed: an entry of an earlier query never counts as one of the present query. All entries
// are cleared before a number comes again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace grid_path_planner::planners {

// The number of the present query, in the bits of a word from `kShift` on, `kBits` of them. It is
// never 0, which marks words that no query has written.
template <class Word, unsigned kShift = 0,
          unsigned kBits = std::numeric_limits<Word>::digits - kShift>
class QueryStamp {
  static_assert(kShift + kBits <= std::numeric_limits<Word>::digits, "a word has fewer bits");

 public:
  // The present query's number in its bits, all others 0.
  Word word() const { return word_; }

  // Precondition: 0, or written in this or an earlier query, and the stamp is the highest bits.
  bool wrote(Word word) const { return word >= word_; }

  // Begins the next query; clear() sets all words to 0, where the numbers begin again.
  template <class Clear>
  void next(const Clear& clear) {
    if (word_ == kLast) {
      clear();
      word_ = 0;
    }
    word_ = static_cast<Word>(word_ + kFirst);
  }

  // To be called when all words are 0.
  void restart() { word_ = kFirst; }

 private:
  static constexpr Word kFirst = static_cast<Word>(Word{1} << kShift);
  static constexpr Word kLast = static_cast<Word>(~std::uint64_t{0} >> (64 - kBits) << kShift);

  Word word_ = kFirst;
};

// `Stamp`: an unsigned integer; every 2^(its bits) queries clear() takes time in proportion to the
// size.
template <class Value, class Stamp = std::uint32_t>
class StampedArray {
 public:
  StampedArray() = default;
  explicit StampedArray(std::size_t size) : entries_(size) {}

  std::size_t size() const { return entries_.size(); }
  std::size_t bytes() const { return entries_.capacity() * sizeof(Entry); }

  // New entries are empty; the others stay.
  void resize(std::size_t size) { entries_.resize(size); }
  // Makes all entries empty.
  void clear() {
    stamp_.next([this] { entries_.assign(entries_.size(), Entry()); });
  }

  bool contains(std::size_t index) const { return entries_[index].stamp == stamp_.word(); }
  // Null where the entry is empty.
  const Value* find(std::size_t index) const {
    return contains(index) ? &entries_[index].value : nullptr;
  }
  Value* find(std::size_t index) { return contains(index) ? &entries_[index].value : nullptr; }
  // Precondition of both: the entry is not empty.
  const Value& operator[](std::size_t index) const { return entries_[index].value; }
  Value& operator[](std::size_t index) { return entries_[index].value; }

  void set(std::size_t index, const Value& value) { entries_[index] = {value, stamp_.word()}; }

 private:
  struct Entry {
    Value value{};
    Stamp stamp = 0;
  };

  std::vector<Entry> entries_;
  QueryStamp<Stamp> stamp_;
};

}  // namespace grid_path_planner::planners
