// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <array>
#include <deque>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "detector/t3pa.h"
#include "input.h"

namespace comptonaut {
namespace {

constexpr std::chrono::milliseconds kPeriod{10};
constexpr Utime kReadAhead_us = kSecond_us;

std::runtime_error no_utc(const std::string& path) {
  return std::runtime_error(
      fmt::format("--input file:{}: needs its side file {}.info with a \"Start time\" to tell UTC", path, path));
}

/// Plays a recording: each batch leaves when its end comes at the recording's pace. The loop stops after the last.
class Playback : public Input {
 public:
  Playback(const std::string& path, std::ifstream file, double speed, InputPorts ports)
      : path_(path), file_(std::move(file)), speed_(speed), ports_(std::move(ports)), start_s_(ports_.now_s()) {
    ports_.loop.every(kPeriod, [this] { play(); });
  }
  [[nodiscard]] std::string state() const override { return "plays a recording"; }
  void finish() override { play(); }

 private:
  void play() {
    read_ahead();
    std::vector<EventBatch> due;
    while (!waiting_.empty() && waiting_.front().utime + waiting_.front().duration_us <= now_utime()) {
      due.push_back(std::move(waiting_.front()));
      waiting_.pop_front();
    }
    ports_.publish(due);
    if (!waiting_.empty() || !ended_) return;
    if (!first_utime_) {
      if (ports_.reader.counts().hits > 0) throw no_utc(path_);
      throw std::runtime_error(
          fmt::format("--input file:{}: holds no hit; {}", path_, describe_row(hit_format_of(path_))));
    }
    ports_.loop.stop();
  }

  void read_ahead() {
    while (!ended_ && (waiting_.empty() || waiting_.back().utime < now_utime() + kReadAhead_us)) {
      file_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
      const auto count = static_cast<std::size_t>(file_.gcount());
      ended_ = count == 0;
      for (EventBatch& batch :
           ended_ ? ports_.reader.on_end() : ports_.reader.on_bytes(std::span(buffer_).first(count))) {
        if (!first_utime_) first_utime_ = batch.utime;
        waiting_.push_back(std::move(batch));
      }
    }
  }

  /// Of the recording: its first batch began when the daemon did.
  [[nodiscard]] Utime now_utime() const {
    return first_utime_.value_or(0) + static_cast<Utime>(1e6 * speed_ * (ports_.now_s() - start_s_));
  }

  std::string path_;
  std::ifstream file_;
  double speed_;
  InputPorts ports_;
  double start_s_;
  std::optional<Utime> first_utime_;
  std::deque<EventBatch> waiting_;
  bool ended_ = false;
  std::array<char, 1024> buffer_{};  ///< few rows: each may bring the batches of a long silence
};

}  // namespace

std::unique_ptr<Input> open_playback(const std::string& path, double speed, InputPorts ports) {
  std::ifstream file(path, std::ios::binary);
  if (!file || file.peek() == std::ifstream::traits_type::eof()) {
    throw std::runtime_error(fmt::format("--input file:{}: cannot be read, or is empty", path));
  }
  const auto info = read_t3pa_info(path);
  const auto start_utime = info ? info->start_utime : std::nullopt;
  const HitFormat format = hit_format_of(path);
  if (!start_utime && format != HitFormat::kClog) throw no_utc(path);  // frames of a shutter tell it themselves
  ports.reader.on_open({.recording = true, .start_utime = start_utime, .format = format});
  return std::make_unique<Playback>(path, std::move(file), speed, std::move(ports));
}

}  // namespace comptonaut
