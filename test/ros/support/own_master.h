// A ROS master of the test's own, which it may kill and stop; its nodes are seen by what they print.
//
//   OwnMaster master;
//   const auto navigate = master.start("navigate_path", {"_check_map:=false"});
//   master.signal(SIGSTOP);                                    // takes connections and answers nobody
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <vector>

#include "ros/guard/master/xmlrpc_call.h"
#include "ros/support/process.h"
#include "ros/support/wait.h"

namespace grid_path_planner::test {

class OwnMaster {
 public:
  OwnMaster() : port_(freePort()), uri_("http://localhost:" + std::to_string(port_)) { run(); }
  ~OwnMaster() { process_->signal(SIGKILL); }

  const std::string& uri() const { return uri_; }

  void run() {
    process_ = std::make_unique<Process>(
        std::vector<std::string>{"rosmaster", "--core", "-p", std::to_string(port_)});
    ASSERT_TRUE(waitFor([&] { return nodes::answersXmlRpc(uri_, 1.0); }));
  }
  void signal(int number) const { process_->signal(number); }
  // For the nodes that are started from now on: while the file `lossy` exists, the first questions of each registration
  // and name do not reach the master.
  void stayBehind(const std::string& lossy) {
    const int port = freePort();
    between_ = std::make_unique<Process>(std::vector<std::string>{
        "/usr/bin/python3", GPP_TEST_DATA "/../ros/support/lossy_master.py", uri_,
        std::to_string(port), lossy});
    nodes_uri_ = "http://localhost:" + std::to_string(port);
    ASSERT_TRUE(waitFor([&] { return nodes::answersXmlRpc(nodes_uri_, 1.0); }));
  }
  void kill() {
    process_->signal(SIGKILL);
    ASSERT_TRUE(process_->waitForExit());
  }

  // A node of this package.
  std::unique_ptr<Process> start(const std::string& node,
                                 const std::vector<std::string>& arguments) const {
    std::vector<std::string> command{GPP_DEVEL "/lib/grid_path_planner/" + node};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return run(command);
  }
  std::unique_ptr<Process> run(const std::vector<std::string>& program) const {
    std::vector<std::string> command{"env", "ROS_MASTER_URI=" + nodes_uri_};
    command.insert(command.end(), program.begin(), program.end());
    return std::make_unique<Process>(command);
  }

 private:
  // Below those that the system gives to sockets that name none: nobody is given it while no master has it.
  static int freePort() {
    for (int port = 20000 + ::getpid() % 10000;; ++port) {
      const int descriptor = ::socket(AF_INET, SOCK_STREAM, 0);
      sockaddr_in address{};
      address.sin_family = AF_INET;
      address.sin_port = htons(static_cast<std::uint16_t>(port));
      const bool is_free =
          ::bind(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof(address)) == 0;
      ::close(descriptor);
      if (is_free) return port;
    }
  }

  const int port_;
  const std::string uri_;
  std::string nodes_uri_ = uri_;
  std::unique_ptr<Process> process_, between_;
};

}  // namespace grid_path_planner::test
