// SPDX-License-Identifier: BSD-3-Clause
// Bytes that nobody honest sends: they are refused or they are a message, and no memory is taken for what is not there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <new>

#include "bus/codec.h"
#include "bus/samples.h"
#include "core/random.h"

namespace {
std::size_t largest_allocation = 0;
}

[[gnu::noinline]] void* operator new(std::size_t size) {
  largest_allocation = std::max(largest_allocation, size);
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace comptonaut {
namespace {

/// A decoded element takes at most so many times its bytes on the wire; a small constant for what is always there.
constexpr std::size_t kMemoryPerByte = 32;
constexpr std::size_t kMemoryAlways = 1024;

template <class T>
void expect_bounded(const Bytes& bytes, const std::string& what) {
  largest_allocation = 0;
  EXPECT_NO_THROW((void)decode<T>(bytes)) << what;
  EXPECT_LE(largest_allocation, kMemoryAlways + kMemoryPerByte * bytes.size()) << what;
}

template <class T>
class CodecRobustness : public testing::Test {};
using MessageTypes =
    testing::Types<EventBatch, MeasurementBatch, RangePoints, TerrainTile, StampedPose, PoseQuality, VehicleState, Plan,
                   SourceReport, MapTile, ClearanceTile, PatchReport, CoordinatorState, DaemonStatus, Truth>;
TYPED_TEST_SUITE(CodecRobustness, MessageTypes);

TYPED_TEST(CodecRobustness, NoCountIsBelievedAtAnyPlace) {
  const Bytes bytes = encode(sample<TypeParam>());
  for (const std::uint32_t count : {0x7fffffffu, 0xffffffffu, 0x80000000u, 0x00ffffffu, 0x0000ffffu, 0u}) {
    for (std::size_t at = 8; at + 4 <= bytes.size(); ++at) {
      Bytes spoiled = bytes;
      for (std::size_t i = 0; i < 4; ++i) spoiled[at + i] = static_cast<std::uint8_t>(count >> (24 - 8 * i));
      expect_bounded<TypeParam>(spoiled, "count " + std::to_string(count) + " at byte " + std::to_string(at));
    }
  }
}

TYPED_TEST(CodecRobustness, SurvivesRandomBytesAnywhere) {
  Random random(20240601);
  const Bytes bytes = encode(sample<TypeParam>());
  for (int round = 0; round < 20'000; ++round) {
    Bytes spoiled = bytes;
    const int changes = 1 + static_cast<int>(8 * random.uniform());
    for (int i = 0; i < changes; ++i) {
      const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(spoiled.size()));
      spoiled[at] = static_cast<std::uint8_t>(256 * random.uniform());
    }
    if (random.uniform() < 0.2) spoiled.resize(static_cast<std::size_t>(random.uniform() * 2.0 * bytes.size()));
    expect_bounded<TypeParam>(spoiled, "round " + std::to_string(round));
  }
}

TYPED_TEST(CodecRobustness, WhatIsAcceptedSurvivesAnotherTrip) {
  Random random(7);
  const Bytes bytes = encode(sample<TypeParam>());
  int accepted = 0;
  for (int round = 0; round < 5'000; ++round) {
    Bytes spoiled = bytes;
    const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(spoiled.size()));
    spoiled[at] ^= static_cast<std::uint8_t>(1u << static_cast<int>(8 * random.uniform()));
    const auto message = decode<TypeParam>(spoiled);
    if (!message) continue;
    ++accepted;
    EXPECT_TRUE(decode<TypeParam>(encode(*message))) << "byte " << at << " in round " << round;
  }
  EXPECT_GT(accepted, 0);
}

}  // namespace
}  // namespace comptonaut
