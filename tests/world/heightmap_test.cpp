// SPDX-License-Identifier: BSD-3-Clause
#include "world/heightmap.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <stdexcept>

#include "scratch.h"

namespace comptonaut {
namespace {

std::filesystem::path picture(const std::string& name, png_uint_32 format, int columns, int rows, const void* pixels) {
  const std::filesystem::path file = scratch_file(name);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(columns);
  image.height = static_cast<png_uint_32>(rows);
  image.format = format;
  EXPECT_TRUE(png_image_write_to_file(&image, file.c_str(), 0, pixels, 0, nullptr)) << image.message;
  return file;
}

std::string refusal(const std::string& text) {
  try {
    (void)load_heightmap(scratch_file("wrong.txt", text), {});
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Heightmap, OfTextHasItsFirstRowInTheNorth) {
  const auto file = scratch_file("grid.txt", "# heights\n1, 2 3\r\n\n4\t5 nan # hole\n");
  const Heightmap map = load_heightmap(file, {.metres_per_pixel = 2.0, .x_min_m = 10, .y_min_m = 20});
  EXPECT_EQ(map.at(10.1, 23.9), 1.0);
  EXPECT_EQ(map.at(15.9, 22.1), 3.0);
  EXPECT_EQ(map.at(10.1, 20.1), 4.0);
  EXPECT_EQ(map.at(12.1, 21.9), 5.0);
  EXPECT_EQ(map.at(15.9, 20.1), std::nullopt);
  for (const auto& [x_m, y_m] : {std::pair(9.9, 21.0), {16.1, 21.0}, {11.0, 19.9}, {11.0, 24.1}, {NAN, 21.0}}) {
    EXPECT_EQ(map.at(x_m, y_m), std::nullopt) << x_m << ' ' << y_m;
  }
}

TEST(Heightmap, OfAPictureGoesFromBlackToWhite) {
  const std::uint8_t grey[] = {0, 255, 51, 102};
  const HeightmapFrame frame{.metres_per_pixel = 1.0, .z_min_m = 5.0, .z_max_m = 15.0};
  const Heightmap map = load_heightmap(picture("grey.png", PNG_FORMAT_GRAY, 2, 2, grey), frame);
  EXPECT_EQ(map.at(0.5, 1.5), 5.0);
  EXPECT_EQ(map.at(1.5, 1.5), 15.0);
  EXPECT_NEAR(*map.at(0.5, 0.5), 7.0, 1e-9);
  EXPECT_NEAR(*map.at(1.5, 0.5), 9.0, 1e-9);
  const std::uint16_t fine[] = {0, 65535, 1, 32768};  // heights of a tenth of a millimetre apart are told apart
  const Heightmap sixteen = load_heightmap(picture("fine.png", PNG_FORMAT_LINEAR_Y, 2, 2, fine), frame);
  EXPECT_NEAR(*sixteen.at(0.5, 0.5), 5.0 + 10.0 / 65535, 1e-9);
  EXPECT_NEAR(*sixteen.at(1.5, 0.5), 10.0, 1e-3);
  const std::uint8_t colours[] = {30, 60, 90, 255, 30, 60, 90, 0};
  const Heightmap holes = load_heightmap(picture("holes.png", PNG_FORMAT_RGBA, 2, 1, colours), frame);
  EXPECT_NEAR(*holes.at(0.5, 0.5), 5.0 + 10.0 * 60 / 255, 1e-9);
  EXPECT_EQ(holes.at(1.5, 0.5), std::nullopt);
}

TEST(Heightmap, MakesAWorldWithItsGroundAndUnknownHoles) {
  const auto file = scratch_file("world.txt", "1 1 3 3\n1 nan 3 3\n");
  const World world = world_of(load_heightmap(file, {.metres_per_pixel = 2.0}), 0.5, 4.0);
  EXPECT_EQ(world.ground_height_m(1, 3), 1.0);
  EXPECT_EQ(world.ground_height_m(5, 1), 3.0);
  EXPECT_EQ(world.ground_height_m(3, 1), std::nullopt);
  EXPECT_EQ(world.at({3, 1, 2}), Occupancy::kUnknown);
  EXPECT_EQ(world.at({1, 1, 6.9}), Occupancy::kFree);
  EXPECT_EQ(world.at({1, 1, 7.1}), Occupancy::kUnknown);
  const Cells cells = world.surface_cells({0, 8, 0, 4}, 0.5);
  for (std::size_t j = 0; j < cells.size(); ++j) {
    const Eigen::Vector3d& p_W = cells.p_W(j);
    EXPECT_FALSE(p_W.x() > 2 && p_W.x() < 4 && p_W.y() < 2) << "a cell in the hole";
  }
  EXPECT_EQ(cells.size(), 8u * 16 - 16 + 4 * 4);  // columns less the hole's, and the wall of 2 m beside 4 of them
  const auto nothing = load_heightmap(scratch_file("nothing.txt", "nan nan\n"), {});
  EXPECT_THROW((void)world_of(nothing, 0.5, 4.0), std::invalid_argument);
}

TEST(Heightmap, SaysWhatIsWrongWithAFile) {
  EXPECT_NE(refusal("1 2\n1 x\n").find("line 2: 'x' is no height"), std::string::npos) << refusal("1 2\n1 x\n");
  EXPECT_NE(refusal("1 2\n1\n").find("line 2: 1 heights, the first row has 2"), std::string::npos);
  EXPECT_NE(refusal("1e9\n").find("line 1: '1e9' is no height"), std::string::npos);
  EXPECT_NE(refusal("# nothing\n").find("it holds no heights"), std::string::npos);
  EXPECT_THROW((void)load_heightmap("/nowhere.png", {}), std::runtime_error);
  const std::uint8_t grey[] = {0, 255, 51, 102};
  const auto file = picture("cut.png", PNG_FORMAT_GRAY, 2, 2, grey);
  const auto size = std::filesystem::file_size(file);
  for (std::uintmax_t length = 8; length + 20 < size; ++length) {
    std::filesystem::resize_file(file, size);
    std::filesystem::resize_file(file, length);
    EXPECT_THROW((void)load_heightmap(file, {}), std::runtime_error) << length;
    (void)picture("cut.png", PNG_FORMAT_GRAY, 2, 2, grey);
  }
}

}  // namespace
}  // namespace comptonaut
