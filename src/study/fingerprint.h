// A hash of all that decides the runs of a study, by which those of another one are told apart.
//
//   Fingerprint print;
//   print.addText("sources 3f2a");
//   print.addFile("mine.py");
//   const auto hash = print.value();
//
// Guaranteed: the same parts in the same order give the same hash, and no part runs into the next. Not
// guaranteed: that somebody who wants to cannot make two alike; it is FNV-1a of 64 bits (Fowler, Noll & Vo 1991).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>

namespace grid_path_planner::study {

class Fingerprint {
 public:
  void addText(const std::string& text);
  // Its bits.
  void addNumber(double number);
  void addNumber(std::int64_t number);
  // The bits of each entry of a matrix or vector.
  template <class Matrix>
  void addMatrix(const Eigen::DenseBase<Matrix>& matrix) {
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      for (Eigen::Index j = 0; j < matrix.cols(); ++j) addNumber(matrix(i, j));
  }
  // What it holds. Throws InputError naming the file where it is none or cannot be read.
  void addFile(const std::string& file);

  std::uint64_t value() const { return value_; }

 private:
  void addBytes(const void* data, std::size_t size);

  std::uint64_t value_ = 14695981039346656037u;
};

}  // namespace grid_path_planner::study
