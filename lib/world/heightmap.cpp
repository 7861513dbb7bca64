// SPDX-License-Identifier: BSD-3-Clause
#include "world/heightmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "world/read_png.h"

namespace comptonaut {
namespace {

constexpr double kHole = std::numeric_limits<double>::quiet_NaN();
constexpr double kHeightMax_m = 1e4;
constexpr std::size_t kSquaresMax = 100'000'000;

/// The heights of one line, appended; how many there were.
int read_row(std::string_view line, std::vector<double>& z_m) {
  int n = 0;
  line = line.substr(0, line.find('#'));
  for (;;) {
    const std::size_t begin = line.find_first_not_of(" \t,\r");
    if (begin == std::string_view::npos) return n;
    const std::string_view word = line.substr(begin, line.find_first_of(" \t,\r", begin) - begin);
    line.remove_prefix(begin + word.size());
    double height_m = kHole;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), height_m);
    const bool number = error == std::errc() && end == word.data() + word.size();
    if (!number || std::isinf(height_m) || std::abs(height_m) > kHeightMax_m) {
      throw std::runtime_error(fmt::format("'{}' is no height, must be -10000 to 10000 m or nan", word));
    }
    z_m.push_back(height_m);
    ++n;
  }
}

Heightmap read_grid(std::string_view text, const HeightmapFrame& frame) {
  Heightmap map{.frame = frame};
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    int n = 0;
    try {
      n = read_row(text.substr(0, length), map.z_m);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("line {}: {}", line, error.what()));
    }
    text.remove_prefix(std::min(text.size(), length + 1));
    if (n == 0) continue;
    if (map.rows > 0 && n != map.columns) {
      throw std::runtime_error(fmt::format("line {}: {} heights, the first row has {}", line, n, map.columns));
    }
    map.columns = n;
    ++map.rows;
    if (map.z_m.size() > kSquaresMax) throw std::runtime_error(fmt::format("more than {} squares", kSquaresMax));
  }
  if (map.rows == 0) throw std::runtime_error("it holds no heights");
  return map;
}

Heightmap from_picture(const GreyPicture& picture, const HeightmapFrame& frame) {
  Heightmap map{.frame = frame, .columns = picture.columns, .rows = picture.rows};
  for (const double grey : picture.grey) map.z_m.push_back(frame.z_min_m + grey * (frame.z_max_m - frame.z_min_m));
  return map;
}

}  // namespace

std::optional<double> Heightmap::at(double x_m, double y_m) const {
  const double x = std::floor((x_m - frame.x_min_m) / frame.metres_per_pixel);
  const double y = std::floor((y_m - frame.y_min_m) / frame.metres_per_pixel);
  if (!(x >= 0.0 && x < columns && y >= 0.0 && y < rows)) return std::nullopt;
  const auto row = static_cast<std::size_t>(rows - 1 - static_cast<int>(y));
  const double height_m = z_m[row * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x)];
  return std::isnan(height_m) ? std::nullopt : std::optional(height_m);
}

Heightmap load_heightmap(const std::filesystem::path& file, const HeightmapFrame& frame) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    throw std::runtime_error(fmt::format("{}: cannot open the heightmap", file.string()));
  }
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  try {
    return is_png(bytes) ? from_picture(read_png(bytes), frame) : read_grid(bytes, frame);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: not a usable heightmap: {}", file.string(), error.what()));
  }
}

World world_of(const Heightmap& map, double voxel_m, double free_m) {
  constexpr double kGroundVoxels = 2.0;  // at least, below the lowest
  double lowest_m = std::numeric_limits<double>::infinity(), highest_m = -lowest_m;
  for (const double z_m : map.z_m) {
    if (std::isnan(z_m)) continue;
    lowest_m = std::min(lowest_m, z_m);
    highest_m = std::max(highest_m, z_m);
  }
  if (!(lowest_m <= highest_m)) throw std::invalid_argument("a heightmap of nothing but holes");
  const HeightmapFrame& frame = map.frame;
  const Box extent{.min_W = {frame.x_min_m, frame.y_min_m, lowest_m - kGroundVoxels * voxel_m},
                   .max_W = {frame.x_min_m + map.columns * frame.metres_per_pixel,
                             frame.y_min_m + map.rows * frame.metres_per_pixel, highest_m + free_m}};
  return World::of_voxels(extent, voxel_m, [&](const Eigen::Vector3d& p_W) {
    const auto height_m = map.at(p_W.x(), p_W.y());
    if (!height_m) return Occupancy::kUnknown;
    return p_W.z() < *height_m ? Occupancy::kOccupied : Occupancy::kFree;
  });
}

}  // namespace comptonaut
