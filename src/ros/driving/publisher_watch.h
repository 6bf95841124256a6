// Whether a node still answers: asked once a second by XML-RPC, in a thread of its own. roscpp's count of links does not see a
// publisher that was killed.
//
//   PublisherWatch watch({[&] { return name_of_publisher; }, [&](const std::string& node) { heard(node); }});
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace grid_path_planner::nodes {

class PublisherWatch {
 public:
  // Called in the thread of the watch.
  struct Callbacks {
    std::function<std::string()> whom;                     // to ask; "": nobody
    std::function<void(const std::string& node)> answers;  // now
  };

  explicit PublisherWatch(Callbacks callbacks);
  ~PublisherWatch();

 private:
  void run();
  void ask();
  bool answersNow();

  const Callbacks callbacks_;
  std::mutex mutex_;
  std::condition_variable ends_;
  bool done_ = false;
  std::string node_, uri_;  // the thread's: who was asked last, and where
  std::thread thread_;
};

}  // namespace grid_path_planner::nodes
