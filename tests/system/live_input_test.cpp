// SPDX-License-Identifier: BSD-3-Clause
// The real detector-reader behind real sockets and pipes, in real time.
#include <fcntl.h>
#include <sys/stat.h>

#include "core/random.h"
#include "system/live_reader.h"

namespace comptonaut {
namespace {

double median_ms(std::vector<Utime> latencies_us) {
  const auto middle = latencies_us.begin() + std::ssize(latencies_us) / 2;
  std::nth_element(latencies_us.begin(), middle, latencies_us.end());
  return 1e-3 * static_cast<double>(*middle);
}

TEST(LiveInput, HitsLeaveWithin50MsWhileTheStreamGoesOn) {
  const int port = free_udp_port();
  LiveReader reader("tcp:" + std::to_string(port));
  const Client client(port);
  const Utime start = now_utime();
  client.send(kT3paHeader + "# start_utime_us " + std::to_string(start) + "\n");
  Random random(1);
  std::vector<Utime> sent_us;
  std::string waiting;
  const auto send_some = [&] {
    while (std::ssize(sent_us) < 2000 && (sent_us.empty() || sent_us.back() + 1000 < now_utime())) {
      sent_us.push_back(now_utime());
      waiting += live_row(std::ssize(sent_us), sent_us.back() - start);
    }
    const auto cut = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(waiting.size() + 1)));
    client.send(waiting.substr(0, cut));  // anywhere within a line
    waiting.erase(0, cut);
    return std::ssize(sent_us) == 2000 && waiting.empty() && reader.singles() == 2000;
  };
  ASSERT_TRUE(reader.wait(send_some)) << reader.singles();
  std::vector<Utime> latencies_us;
  for (std::size_t i = 0; i < reader.batches.size(); ++i) {
    if (reader.batches[i].channels[0].singles == 0) continue;
    const auto newest = std::lower_bound(sent_us.begin(), sent_us.end(), reader.batches[i].utime + kBatch_us) - 1;
    latencies_us.push_back(reader.arrivals[i] - *newest);
  }
  ASSERT_GT(latencies_us.size(), 20u);
  latencies_us.pop_back();  // after it the stream does not go on
  RecordProperty("median_ms", std::to_string(median_ms(latencies_us)));
  EXPECT_LT(median_ms(latencies_us), 50.0);
}

TEST(LiveInput, HitsLeaveWithin200MsWhenTheStreamPauses) {
  const int port = free_udp_port();
  LiveReader reader("tcp:" + std::to_string(port));
  const Client client(port);
  client.send(kT3paHeader);  // UTC by arrival
  const Utime start = now_utime();
  std::vector<Utime> latencies_us;
  for (std::int64_t i = 1; i <= 9; ++i) {
    const Utime sent = now_utime();
    client.send(live_row(i, sent - start + 1000));
    ASSERT_TRUE(reader.wait([&] { return reader.singles() == i; }));
    latencies_us.push_back(now_utime() - sent);
  }
  RecordProperty("median_ms", std::to_string(median_ms(latencies_us)));
  EXPECT_LT(median_ms(latencies_us), 200.0);
  for (const EventBatch& batch : reader.batches) EXPECT_NEAR(batch.utime, start, 20'000'000) << "UTC";
}

TEST(LiveInput, AClientThatComesAgainGoesOnWithTheNextNumberAndTheOutageIsDead) {
  const int port = free_udp_port();
  LiveReader reader("tcp:" + std::to_string(port));
  const auto send_second = [](const Client& client) {
    std::string text = kT3paHeader;  // chip time starts again
    for (int i = 0; i < 100; ++i) text += live_row(i, 10'000 * (i + 1));
    client.send(text);
  };
  send_second(Client(port));
  ASSERT_TRUE(reader.wait([&] { return reader.singles() == 100; })) << "what came leaves when the client goes";
  ASSERT_TRUE(reader.wait([&] { return reader.state == "waits for a connection"; }));
  const std::size_t first = reader.batches.size();
  const std::int64_t first_live_us = reader.live_us();
  EXPECT_NEAR(static_cast<double>(first_live_us), 1e6, 60e3);
  send_second(Client(port));
  ASSERT_TRUE(reader.wait([&] { return reader.singles() == 200; }));
  EXPECT_EQ(reader.batches[first].key.number, reader.batches[first - 1].key.number + 1);
  EXPECT_NEAR(static_cast<double>(reader.live_us() - first_live_us), 1e6, 60e3) << "nothing for the time between";
}

TEST(LiveInput, ANamedPipeTakesOneWriterAfterTheOther) {
  const std::string path = scratch_file("pipe").string();
  std::filesystem::remove(path);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  LiveReader reader("pipe:" + path);
  for (int writer = 1; writer <= 5; ++writer) {
    const int fd = open(path.c_str(), O_WRONLY | O_CLOEXEC);  // waits for the reader
    std::string text = kT3paHeader;
    for (int i = 0; i < 50; ++i) text += live_row(i, 10'000 * (i + 1));
    EXPECT_EQ(write(fd, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    close(fd);
    if (writer == 2) continue;  // the next one comes at once
    ASSERT_TRUE(reader.wait([&] { return reader.singles() == 50 * writer; })) << writer << ": " << reader.singles();
  }
  ASSERT_TRUE(reader.wait([&] { return reader.state == "waits for a writer"; })) << reader.state;
  EXPECT_EQ(reader.counters["epochs"], 5);
  reader.child().signal(SIGTERM);
  EXPECT_EQ(reader.child().wait(), 0);
}

TEST(LiveInput, AReaderThatDiesLeavesDeadTimeAndTheNextHasItsOwnBootEpoch) {
  const int port = free_udp_port();
  LiveReader reader("tcp:" + std::to_string(port));
  std::string text;
  for (int i = 0; i < 100; ++i) text += live_row(i, 10'000 * (i + 1));
  {
    const Client client(port);
    client.send(text);
    ASSERT_TRUE(reader.wait([&] { return reader.singles() > 50; }));
    reader.child().signal(SIGKILL);
    EXPECT_EQ(reader.child().wait(), 128 + SIGKILL);
    reader.take_all();
  }
  const std::size_t first = reader.batches.size();
  reader.start();
  Client(port).send(text);
  ASSERT_TRUE(reader.wait([&] { return reader.batches.size() > first && reader.singles() >= 150; }));
  EXPECT_GT(reader.batches.back().key.boot_epoch, reader.batches.front().key.boot_epoch);
  EXPECT_EQ(reader.batches[first].key.number, 0);
  EXPECT_LE(reader.live_us(), 2'060'000) << "what died in memory, and the time without a reader, are no live time";
}

}  // namespace
}  // namespace comptonaut
