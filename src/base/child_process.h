// A file read by a program of this package in a process of its own: for libraries that cannot be asked
// what they are about to take, nor be stopped. Whatever they do, this process goes on and gets a
// sentence.
//
//   const std::string bytes = answerOfChild("read_world", file, limits);
//
// The program is started by posix_spawn, which shares nothing with the threads of this process, and is
// told what is left of the limits. It is killed where the time is over or the reading is cancelled, and
// always waited for, so that none is left, not even as a zombie; it dies with the thread that started
// it. It answers on its standard output: bytes, or the text of an InputError.
#pragma once

#include <functional>
#include <string>

#include "grid_path_planner/base/read_limits.h"

namespace grid_path_planner::base {

// What `program` answers about `file`; its bytes are taken of `limits`, and the program itself may take
// as many again. Throws InputError naming the file: the program's own, or how it ended.
std::string answerOfChild(const std::string& program, const std::string& file, ReadLimits& limits);

// The main function of such a program: sets the limits of its arguments, and answers what `read` makes
// of the file. Returns the exit code.
using ChildWork = std::function<std::string(const std::string& file)>;
int childMain(int argc, char** argv, const ChildWork& read);

}  // namespace grid_path_planner::base
