// SPDX-License-Identifier: BSD-3-Clause
#include "bus/codec.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bus/flatten.h"
#include "bus/samples.h"

namespace comptonaut {
namespace {

template <class T>
class Codec : public testing::Test {};
using MessageTypes =
    testing::Types<EventBatch, MeasurementBatch, RangePoints, TerrainTile, StampedPose, PoseQuality, VehicleState, Plan,
                   SourceReport, MapTile, ClearanceTile, PatchReport, CoordinatorState, DaemonStatus, Truth>;
TYPED_TEST_SUITE(Codec, MessageTypes);

constexpr double kFloatRounding = 1e-7;  // relative

TYPED_TEST(Codec, GivesBackEveryFieldToFloatPrecision) {
  const auto before = sample<TypeParam>();
  const auto after = decode<TypeParam>(encode(before));
  ASSERT_TRUE(after);
  const Flat expected = flatten(before), got = flatten(*after);
  EXPECT_EQ(expected.texts, got.texts);
  ASSERT_EQ(expected.numbers.size(), got.numbers.size());
  for (std::size_t i = 0; i < expected.numbers.size(); ++i) {
    const double want = expected.numbers[i];
    if (std::isnan(want)) {
      EXPECT_TRUE(std::isnan(got.numbers[i])) << "number " << i;
    } else {
      EXPECT_NEAR(got.numbers[i], want, kFloatRounding * std::abs(want)) << "number " << i;
    }
  }
}

TYPED_TEST(Codec, RoundsOnlyOnce) {
  const Bytes bytes = encode(sample<TypeParam>());
  EXPECT_EQ(encode(*decode<TypeParam>(bytes)), bytes);
}

TYPED_TEST(Codec, RefusesAMessageThatIsCutShortAnywhere) {
  const Bytes bytes = encode(sample<TypeParam>());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Bytes cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_FALSE(decode<TypeParam>(cut)) << "after " << size << " of " << bytes.size() << " bytes";
  }
}

TYPED_TEST(Codec, IgnoresWhatFollowsAMessage) {
  Bytes bytes = encode(sample<TypeParam>());
  bytes.insert(bytes.end(), 64, 0xff);
  EXPECT_TRUE(decode<TypeParam>(bytes));
}

TYPED_TEST(Codec, RefusesAnyOtherFingerprint) {
  const Bytes bytes = encode(sample<TypeParam>());
  for (std::size_t i = 0; i < 8; ++i) {
    Bytes other = bytes;
    other[i] ^= 1;
    EXPECT_FALSE(decode<TypeParam>(other)) << "byte " << i;
  }
}

TEST(Codec, WritesAnUnphysicalHypothesisAsTheDefaultOne) {
  auto batch = sample<EventBatch>();
  batch.pairs[1].b = {.axis_D = Eigen::Vector3d::Constant(NAN), .cos_beta = 3.0, .probability = 0.0};
  const auto decoded = decode<EventBatch>(encode(batch));
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->pairs[1].b.axis_D, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(decoded->pairs[1].b.cos_beta, 0.0);
}

TEST(Codec, CutsALongTextAndReplacesControlCharacters) {
  auto plan = sample<Plan>();
  plan.status = "a\nb" + std::string(1000, 'c');
  const auto decoded = decode<Plan>(encode(plan));
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->status.size(), 256u);
  EXPECT_EQ(decoded->status.substr(0, 4), "a?bc");
}

TEST(Codec, RefusesToEncodeATileWhoseCellsLieTooFarApart) {
  auto tile = sample<MapTile>();
  tile.cells[1].key.x = tile.cells[0].key.x + 128;
  EXPECT_THROW((void)encode(tile), std::invalid_argument);
}

}  // namespace
}  // namespace comptonaut
