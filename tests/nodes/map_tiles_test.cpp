// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/map_tiles.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>

namespace comptonaut {
namespace {

TEST(MapTiles, HoldEachCellOnceInTilesThatFitADatagram) {
  for (const double width_m : {3.0, 50.0, 400.0}) {  // the last: rows longer than a tile's reach
    const Cells cells = flat_cells({-10, width_m, 0, 7}, 0.5);
    std::vector<double> lambda(cells.size());
    std::iota(lambda.begin(), lambda.end(), 0.0);
    const auto tiles = map_tiles(cells, lambda, lambda);
    std::size_t j = 0;
    for (std::size_t t = 0; t < tiles.size(); ++t) {
      EXPECT_EQ(tiles[t].tile, static_cast<std::int32_t>(t));
      EXPECT_EQ(tiles[t].tiles, static_cast<std::int32_t>(tiles.size()));
      EXPECT_EQ(tiles[t].cell_m, 0.5);
      ASSERT_LE(tiles[t].cells.size(), kMaxCellsPerTile);
      const VoxelKey origin = tiles[t].cells.front().key;
      for (const MapCell& cell : tiles[t].cells) {
        ASSERT_EQ(cell, (MapCell{.key = cells.key(j), .lambda_Bq = lambda[j], .sensitivity_s = lambda[j]}));
        ASSERT_LE(std::abs(cell.key.x - origin.x), 127) << "width " << width_m;
        ASSERT_LE(std::abs(cell.key.y - origin.y), 127) << "width " << width_m;
        ++j;
      }
    }
    EXPECT_EQ(j, cells.size()) << "width " << width_m;
  }
}

}  // namespace
}  // namespace comptonaut
