// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <span>
#include <vector>

#include "detector/events.h"
#include "detector/hit_stream.h"
#include "nodes/detector_reader_config.h"

namespace comptonaut {

/// A pixel that was masked for a while as hot.
struct HotPixelTotals {
  std::uint16_t pixel = 0;
  std::int64_t hits = 0;  ///< left out
};

/// What a recording held, and how long it was read.
struct RecordingTotals {
  HitStreamCounts counts;
  std::vector<HotPixelTotals> hot_pixels;  ///< the hottest first
  double duration_s = 0.0;
  double live_s = 0.0;
  double took_s = 0.0;
};

/// To be asked before any output is opened. Throws std::runtime_error where the recording cannot be read, or is to be
/// written over by an output; an empty path is no output.
void require_recording(const std::filesystem::path& file, std::initializer_list<std::filesystem::path> outputs);

/// The next stretch of hits, in order of time, and the events that `finder` has made of them, those of hot pixels left
/// out.
using TakeStretch = std::function<void(std::span<const Hit>, std::span<const DetectorEvent>)>;

/// Reads a recording (.t3pa, .t3p or .clog) to its end, with a bar on a terminal: its stream and hot pixels as in
/// `config`, its events by `finder`. Throws std::runtime_error that names the file where it cannot be read or holds no
/// hit though it holds something.
RecordingTotals read_recording(const std::filesystem::path& file, const DetectorReaderConfig& config,
                               EventFinder& finder, const TakeStretch& take);

/// Which rows were left out, by kind, with the line of the first.
void print_faults(const std::filesystem::path& file, const RowFaults& faults);

}  // namespace comptonaut
