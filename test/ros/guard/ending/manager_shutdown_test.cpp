// A vehicle that a nodelet commanded drove on when its manager got a signal or was asked to end: roscpp closes the
// connections before the nodelet hears of it, and SIGTERM ends a manager at once. Here each manager is a child of the test.
#include "ros/guard/ending/manager_shutdown.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <ros/xmlrpc_manager.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <functional>
#include <future>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

namespace grid_path_planner::nodes {
namespace {

constexpr int kLongestEnd = 20000;  // ms

// As _exit(0), but that the thread sanitizer does not look for threads that nobody has joined: the watch's may have ended.
void endAtOnce() {
  ::syscall(SYS_exit_group, 0);
}

// Runs `main` in a child, which writes to the test by `say`.
class Manager {
 public:
  using Say = std::function<void(char)>;

  explicit Manager(const std::function<void(const Say&)>& main) {
    if (::pipe(pipe_) != 0) throw std::runtime_error("no pipe");
    pid_ = ::fork();
    if (pid_ != 0) return;
    ::alarm(kLongestEnd / 1000);
    main([this](char letter) { (void)!::write(pipe_[1], &letter, 1); });
    endAtOnce();
  }
  ~Manager() {
    ::kill(pid_, SIGKILL);
    if (!ended_) ::waitpid(pid_, nullptr, 0);
    ::close(pipe_[0]);
    ::close(pipe_[1]);
  }

  void signal(int number) const { ::kill(pid_, number); }
  // The next letter; 0 where none comes.
  char heard() const {
    pollfd readable{pipe_[0], POLLIN, 0};
    char letter = 0;
    if (::poll(&readable, 1, kLongestEnd) == 1) (void)!::read(pipe_[0], &letter, 1);
    return letter;
  }
  // The signal that ended it; 0: it exited.
  int endedBy() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    ended_ = true;
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }

 private:
  int pipe_[2] = {-1, -1};
  pid_t pid_ = -1;
  bool ended_ = false;
};

void waitForEver() {
  for (;;) ::pause();
}

TEST(ManagerShutdown, AllStopBeforeTheSignalEndsTheManager) {
  for (const int number : {SIGINT, SIGTERM}) {
    Manager manager([](const Manager::Say& say) {
      const ManagerShutdown one([&] { say('a'); });
      const ManagerShutdown throws([] { throw std::string("nobody catches this"); });
      const ManagerShutdown other([&] { say('b'); });
      say('.');
      waitForEver();
    });
    ASSERT_EQ(manager.heard(), '.');
    manager.signal(number);
    EXPECT_EQ(manager.heard(), 'a');
    EXPECT_EQ(manager.heard(), 'b');
    EXPECT_EQ(manager.endedBy(), number);
  }
}

Manager::Say says;

TEST(ManagerShutdown, WhoeverHandledTheSignalBeforeGetsIt) {
  Manager manager([](const Manager::Say& say) {
    says = say;
    ::signal(SIGINT, [](int) {
      says('h');
      endAtOnce();
    });
    const ManagerShutdown end([&] { say('s'); });
    say('.');
    waitForEver();
  });
  ASSERT_EQ(manager.heard(), '.');
  manager.signal(SIGINT);
  EXPECT_EQ(manager.heard(), 's');
  EXPECT_EQ(manager.heard(), 'h');
  EXPECT_EQ(manager.endedBy(), 0);
}

TEST(ManagerShutdown, TheSecondSignalIsNotHeldUp) {
  Manager manager([](const Manager::Say& say) {
    const ManagerShutdown end([&] {
      say('s');
      waitForEver();
    });
    say('.');
    waitForEver();
  });
  ASSERT_EQ(manager.heard(), '.');
  manager.signal(SIGINT);
  ASSERT_EQ(manager.heard(), 's');
  manager.signal(SIGTERM);
  EXPECT_EQ(manager.endedBy(), SIGTERM);
}

TEST(ManagerShutdown, OneThatIsIgnoredStaysSo) {
  Manager manager([](const Manager::Say& say) {
    ::signal(SIGINT, SIG_IGN);
    const ManagerShutdown end([&] { say('s'); });
    ::raise(SIGINT);
    say('.');
    waitForEver();
  });
  ASSERT_EQ(manager.heard(), '.');
  manager.signal(SIGTERM);
  EXPECT_EQ(manager.heard(), 's');
  EXPECT_EQ(manager.endedBy(), SIGTERM);
}

TEST(ManagerShutdown, SignalsAreGivenBackWithTheLast) {
  Manager manager([](const Manager::Say& say) {
    {
      const ManagerShutdown end([&] { say('s'); });
    }
    say('.');
    waitForEver();
  });
  ASSERT_EQ(manager.heard(), '.');
  manager.signal(SIGTERM);
  EXPECT_EQ(manager.endedBy(), SIGTERM);
}

// Two threads make and end them: one made while the last one ended took that one's handler for the process's own.
TEST(ManagerShutdown, SignalsAreGivenBackHoweverManyComeAndGo) {
  Manager manager([](const Manager::Say& say) {
    const auto comeAndGo = [] {
      for (int i = 0; i < 3000; ++i) const ManagerShutdown end([] {});
    };
    std::thread other(comeAndGo);
    comeAndGo();
    other.join();
    struct sigaction now = {};
    ::sigaction(SIGTERM, nullptr, &now);
    say(now.sa_handler == SIG_DFL ? 'd' : 'o');
  });
  EXPECT_EQ(manager.heard(), 'd');
}

// One of an earlier watch was passed on again when a later one ended.
TEST(ManagerShutdown, ASignalThatEndedNothingIsPassedOnOnce) {
  Manager manager([](const Manager::Say& say) {
    says = say;
    ::signal(SIGINT, [](int) { says('h'); });
    std::promise<void> stopped;
    {
      const ManagerShutdown end([&] {
        say('s');
        stopped.set_value();
      });
      ::raise(SIGINT);
      stopped.get_future().wait();
    }
    {
      const ManagerShutdown later([] {});
    }
    say('.');
  });
  EXPECT_EQ(manager.heard(), 's');
  EXPECT_EQ(manager.heard(), 'h');
  EXPECT_EQ(manager.heard(), '.');
}

// What roscpp does before its own `shutdown` is called, whose place `shutdown` takes.
void startXmlRpc(const ros::XMLRPCFunc& shutdown) {
  ros::XMLRPCManager::instance()->bind("shutdown", shutdown);
  ros::XMLRPCManager::instance()->start();
}

using Reason = std::optional<XmlRpc::XmlRpcValue>;

// As `rosnode kill` and the master do, from another process or not; whether it was answered well.
bool askToEnd(const Reason& reason = XmlRpc::XmlRpcValue("asked by the test")) {
  XmlRpc::XmlRpcClient client("localhost", int(ros::XMLRPCManager::instance()->getServerPort()),
                              "/");
  XmlRpc::XmlRpcValue request, response;
  request[0] = std::string("/test");
  if (reason) request[1] = *reason;
  return client.execute("shutdown", request, response) && !client.isFault() &&
         int(response[0]) == 1;
}

ros::XMLRPCFunc saying(const Manager::Say& say, char letter) {
  return [say, letter](XmlRpc::XmlRpcValue&, XmlRpc::XmlRpcValue& response) {
    say(letter);
    response = ros::xmlrpc::responseInt(1, "", 0);
  };
}

TEST(ManagerShutdown, AllStopBeforeARequestEndsTheManager) {
  Manager manager([](const Manager::Say& say) {
    startXmlRpc(saying(say, 'r'));
    const ManagerShutdown one([&] { say('a'); });
    const ManagerShutdown other([&] { say('b'); });
    say(askToEnd() ? '.' : '!');
    waitForEver();
  });
  std::string heard;  // the answer does not wait for the stops
  while (heard.size() < 4) heard += manager.heard();
  EXPECT_NE(heard.find('.'), std::string::npos) << heard;
  heard.erase(heard.find('.'), 1);
  EXPECT_EQ(heard, "abr");
}

TEST(ManagerShutdown, TheSecondRequestIsNotHeldUpNorASignalAfterTheFirst) {
  Manager manager([](const Manager::Say& say) {
    startXmlRpc(saying(say, 'r'));
    const ManagerShutdown end([&] {
      say('s');
      waitForEver();
    });
    askToEnd();
    askToEnd();
    waitForEver();
  });
  const std::string heard{manager.heard(), manager.heard()};
  EXPECT_TRUE(heard == "sr" || heard == "rs") << heard;
  manager.signal(SIGTERM);
  EXPECT_EQ(manager.endedBy(), SIGTERM);
}

TEST(ManagerShutdown, ARequestWithoutAReasonIsRoscppsToRefuse) {
  Manager manager([](const Manager::Say& say) {
    startXmlRpc(saying(say, 'r'));
    const ManagerShutdown end([&] { say('s'); });
    say(askToEnd(std::nullopt) ? '.' : '!');
    waitForEver();
  });
  EXPECT_EQ(manager.heard(), 'r');
  EXPECT_EQ(manager.heard(), '.');
}

// roscpp takes it for an empty one: it ended the manager before any nodelet had stopped its vehicle.
TEST(ManagerShutdown, AllStopBeforeARequestWithAReasonThatCannotBeRead) {
  Manager manager([](const Manager::Say& say) {
    startXmlRpc(saying(say, 'r'));
    const ManagerShutdown end([&] { say('s'); });
    askToEnd(XmlRpc::XmlRpcValue());
    waitForEver();
  });
  EXPECT_EQ(manager.heard(), 's');
  EXPECT_EQ(manager.heard(), 'r');
}

TEST(ManagerShutdown, TheMethodIsGivenBackWithTheLast) {
  Manager manager([](const Manager::Say& say) {
    startXmlRpc(saying(say, 'r'));
    for (int i = 0; i < 3; ++i) const ManagerShutdown end([&] { say('s'); });
    say(askToEnd() ? '.' : '!');
    waitForEver();
  });
  EXPECT_EQ(manager.heard(), 'r');
  EXPECT_EQ(manager.heard(), '.');
}

TEST(ManagerShutdown, ARequestWhileTheLastEndsIsNotLost) {
  for (int i = 0; i < 20; ++i) {
    Manager manager([](const Manager::Say& say) {
      startXmlRpc(saying(say, 'r'));
      std::thread asks;
      {
        const ManagerShutdown end([] {});
        asks = std::thread([&] {
          while (!askToEnd()) {
          }
        });
      }
      asks.join();
      waitForEver();
    });
    ASSERT_EQ(manager.heard(), 'r');
  }
}

}  // namespace
}  // namespace grid_path_planner::nodes
