// SPDX-License-Identifier: BSD-3-Clause
#include "bus/daemon.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <stdexcept>

#include "bus/samples.h"
#include "bus/test_bus.h"

namespace comptonaut {
namespace {

using namespace std::chrono_literals;

TEST(EventLoop, EndsAtASignalAfterHandlingWhatHadArrived) {
  EventLoop loop;
  Bus sender(loopback_url());
  Bus& bus = sender;
  int handled = 0;
  bus.subscribe_raw("X", [&](const auto&, auto) {
    if (++handled == 1) kill(getpid(), SIGTERM);  // the other messages have been sent, and LCM reads its socket
  });
  loop.watch(bus);
  for (int i = 0; i < 500; ++i) bus.publish("X", sample<Plan>());
  loop.run();
  EXPECT_EQ(handled, 500);
}

TEST(EventLoop, DoesWhatIsToBeDoneOnceItHasHandledWhatCame) {
  EventLoop loop;
  Bus bus(loopback_url());
  int handled = 0, known = 0;
  bus.subscribe_raw("X", [&](const auto&, auto) { ++handled; });
  loop.watch(bus, [&] {
    known = handled;
    if (known == 50) loop.stop();
  });
  loop.every(20s, [&] { loop.stop(); });
  for (int i = 0; i < 50; ++i) bus.publish("X", sample<Plan>());
  loop.run();
  EXPECT_EQ(known, 50);
}

TEST(EventLoop, CallsTimersAndDescriptorsInTurn) {
  EventLoop loop;
  int pipe_fds[2];
  ASSERT_EQ(pipe(pipe_fds), 0);
  int ticks = 0;
  std::string text;
  loop.every(5ms, [&] {
    if (write(pipe_fds[1], "x", 1) == 1 && ++ticks == 3) loop.stop();
  });
  loop.watch(pipe_fds[0], [&] {
    char c;
    if (read(pipe_fds[0], &c, 1) == 1) text += c;
  });
  loop.run();
  EXPECT_EQ(text, "xxx");
}

TEST(EventLoop, LetsAHandlerUnwatchItself) {
  EventLoop loop;
  int pipe_fds[2];
  ASSERT_EQ(pipe(pipe_fds), 0);
  close(pipe_fds[1]);  // readable for ever: end of file
  int calls = 0;
  loop.watch(pipe_fds[0], [&, text = std::string(100, 'x')] {
    loop.unwatch(pipe_fds[0]);
    calls += static_cast<int>(text.size());
  });
  loop.every(5ms, [&] { loop.stop(); });
  loop.run();
  EXPECT_EQ(calls, 100);
}

struct Outcome {
  bool follow = false;
  int exit_code;
  std::string out;
  std::string error;
  DaemonArguments arguments;
};

Outcome run(std::vector<std::string> words, const std::function<void(const DaemonArguments&)>& body = {}) {
  Outcome outcome{};
  words.insert(words.begin(), "comptonaut-test");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  std::string input = "file:default";
  bool follow = false;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  outcome.exit_code =
      run_daemon(static_cast<int>(argv.size()), argv.data(), "comptonaut-test", "Tests.",
                 {{"--input", "where from", &input}, {.name = "--follow", .help = "lead or not", .flag = &follow}},
                 [&](const DaemonArguments& arguments) {
                   outcome.arguments = arguments;
                   if (body) body(arguments);
                 });
  outcome.follow = follow;
  outcome.out = testing::internal::GetCapturedStdout();
  outcome.error = testing::internal::GetCapturedStderr();
  return outcome;
}

TEST(RunDaemon, ReadsWhatEveryDaemonIsTold) {
  const Outcome outcome = run({"--config", "a.yaml", "--lcm-url", "udpm://1.2.3.4:5", "--mav", "3", "--time-scale",
                               "2.5", "--input", "tcp:4000", "--follow"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(outcome.arguments.config, "a.yaml");
  EXPECT_EQ(outcome.arguments.lcm_url, "udpm://1.2.3.4:5");
  EXPECT_EQ(outcome.arguments.mav, 3);
  EXPECT_EQ(outcome.arguments.time_scale, 2.5);
  EXPECT_TRUE(outcome.follow);
  EXPECT_FALSE(run({"--config", "a.yaml"}).follow);
}

TEST(RunDaemon, ShowsHelpAndVersion) {
  const Outcome help = run({"--help"}), version = run({"--version"});
  EXPECT_EQ(help.exit_code, 0);
  for (const std::string option :
       {"--config", "--lcm-url", "--mav", "--time-scale", "--version", "--input", "--follow"}) {
    EXPECT_NE(help.out.find(option), std::string::npos) << option << " in\n" << help.out;
  }
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_TRUE(version.out.starts_with("comptonaut-test ")) << version.out;
}

TEST(RunDaemon, SaysInOneLineWhatIsWrong) {
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"--config"},
      {"--config", "a.yaml", "--mav", "251"},
      {"--config", "a.yaml", "--mav", "x"},
      {"--config", "a.yaml", "--time-scale", "0"},
      {"--config", "a.yaml", "--unknown", "1"},
  };
  for (const auto& words : wrong) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
    EXPECT_TRUE(outcome.error.starts_with("<3>comptonaut-test: ")) << outcome.error;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
  }
}

TEST(RunDaemon, TurnsAnExceptionIntoOneLineAndExitCodeOne) {
  const Outcome outcome = run({"--config", "a.yaml"}, [](const auto&) { throw std::runtime_error("no such\nthing"); });
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.error, "<3>comptonaut-test: no such thing\n");
}

TEST(PublishStatus, SpreadsManyCountersOverDatagramsOfTheTeamBus) {
  EventLoop loop;
  Bus bus(loopback_url());
  std::vector<Counter> received;
  std::size_t largest = 0;
  bus.subscribe_raw("MAV2_STATUS", [&](const auto&, std::span<const std::uint8_t> bytes) {
    largest = std::max(largest, bytes.size());
    const auto status = decode<DaemonStatus>(bytes);
    ASSERT_TRUE(status);
    EXPECT_EQ(status->sender, 2);
    EXPECT_EQ(status->daemon, "mapper");
    EXPECT_EQ(status->state, "running");
    EXPECT_FALSE(status->version.empty());
    received.insert(received.end(), status->counters.begin(), status->counters.end());
    if (received.size() >= 204) loop.stop();
  });
  loop.watch(bus);
  DaemonStatus status{.utime = kSampleUtime, .state = "running"};
  for (int i = 0; i < 200; ++i) status.counters.push_back({"counter_" + std::to_string(i), i});
  publish_status(loop, bus, {.mav = 2, .time_scale = 20.0}, "mapper", [status] { return status; });
  loop.every(20s, [&] { loop.stop(); });
  loop.run();
  ASSERT_EQ(received.size(), 204u);  // and four of the bus
  for (int i = 0; i < 200; ++i)
    EXPECT_EQ(received[static_cast<std::size_t>(i)], status.counters[static_cast<std::size_t>(i)]);
  EXPECT_LE(largest, 1136u);
}

}  // namespace
}  // namespace comptonaut
