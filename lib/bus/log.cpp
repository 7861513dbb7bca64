// SPDX-License-Identifier: BSD-3-Clause
#include "bus/log.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "team/big_endian.h"

namespace comptonaut {
namespace {

// An event is, all big-endian: sync word, number (8), time (8), length of the channel (4), of the message (4), both.
constexpr std::uint32_t kSyncWord = 0xEDA1DA01;
constexpr std::size_t kHeaderBytes = 28;
constexpr std::uint64_t kMaxChannelBytes = 1000;
constexpr std::uint64_t kMaxMessageBytes = 64 << 20;

struct OwnedEvent {
  Utime logged_utime = 0;
  std::string channel;
  std::vector<std::uint8_t> bytes;
};

bool read_bytes(std::istream& in, std::span<std::uint8_t> bytes) {
  return static_cast<bool>(in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())));
}

/// The next event; nullopt at the end, also where the last one is cut short. Throws where the file is damaged.
std::optional<OwnedEvent> read_event(std::istream& in, const std::filesystem::path& file) {
  std::array<std::uint8_t, kHeaderBytes> header;
  const auto at = static_cast<std::int64_t>(in.tellg());
  if (!read_bytes(in, header)) return {};
  const std::span fields(header);
  const auto channel_bytes = read_big_endian<std::uint32_t>(fields.subspan(20));
  const auto message_bytes = read_big_endian<std::uint32_t>(fields.subspan(24));
  if (read_big_endian<std::uint32_t>(fields) != kSyncWord || channel_bytes > kMaxChannelBytes ||
      message_bytes > kMaxMessageBytes) {
    throw std::runtime_error(fmt::format("{}: byte {}: not an event of an LCM log", file.string(), at));
  }
  OwnedEvent event{.logged_utime = read_big_endian<Utime>(fields.subspan(12)),
                   .channel = std::string(channel_bytes, '\0'),
                   .bytes = std::vector<std::uint8_t>(message_bytes)};
  in.read(event.channel.data(), static_cast<std::streamsize>(channel_bytes));
  return read_bytes(in, event.bytes) ? std::optional(std::move(event)) : std::nullopt;
}

int open_to_append(const std::filesystem::path& file) {
  std::error_code ignored;  // open() says what is wrong
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), ignored);
  return open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
}

}  // namespace

void read_log(const std::filesystem::path& file, const std::function<void(const LogEvent&)>& handler) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot open the LCM log", file.string()));
  bool any = false;
  while (const auto event = read_event(in, file)) {
    any = true;
    handler({.logged_utime = event->logged_utime, .channel = event->channel, .bytes = event->bytes});
  }
  if (!any) throw std::runtime_error(fmt::format("{}: holds no event of an LCM log", file.string()));
}

LogWriter::LogWriter(const std::filesystem::path& file) : fd_(open_to_append(file)) {
  if (fd_ < 0) {
    throw std::runtime_error(fmt::format("{}: cannot write an LCM log: {}", file.string(), std::strerror(errno)));
  }
}

LogWriter::~LogWriter() {
  sync();
  close(fd_);
}

bool LogWriter::append(const LogEvent& event) {
  if (broken_) return false;
  std::vector<std::uint8_t> record;
  append_big_endian(record, kSyncWord);
  append_big_endian(record, std::int64_t{events_});
  append_big_endian(record, event.logged_utime);
  append_big_endian(record, static_cast<std::uint32_t>(event.channel.size()));
  append_big_endian(record, static_cast<std::uint32_t>(event.bytes.size()));
  record.insert(record.end(), event.channel.begin(), event.channel.end());
  record.insert(record.end(), event.bytes.begin(), event.bytes.end());

  const off_t before = lseek(fd_, 0, SEEK_END);
  if (write(fd_, record.data(), record.size()) != static_cast<ssize_t>(record.size())) {
    // Half an event would hide those after it.
    broken_ = broken_ || ftruncate(fd_, before) != 0;
    return false;
  }
  ++events_;
  return true;
}

bool LogWriter::sync() { return fdatasync(fd_) == 0; }

}  // namespace comptonaut
