// SPDX-License-Identifier: BSD-3-Clause
#include "picture/picture.h"

#include <cairo/cairo.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "picture/colour.h"
#include "scratch.h"

namespace comptonaut {
namespace {

std::string read_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A map of 2 x 2 cells: 1 and 10 below, 100 and nothing above.
HeatMap small_map() {
  return {.title = "map",
          .x = {.label = "x, px", .min = 0, .max = 2},
          .y = {.label = "y, px", .min = 0, .max = 2},
          .columns = 2,
          .rows = 2,
          .values = {1, 10, 100, 0},
          .scale = {.label = "hits", .min = 1, .max = 100, .logarithmic = true},
          .marks = {{.x = 1, .y = 1, .label = "here"}}};
}

Chart small_chart() {
  return {.title = "chart",
          .x = {.label = "energy, keV", .min = 0, .max = 100},
          .y = {.label = "clusters", .min = 1, .max = 1000, .logarithmic = true},
          .curves = {{.name = "all", .x = {0, 50, 100}, .y = {10, 0, 0}, .style = Curve::Style::kSteps}},
          .guides = {{.x = 59.5, .label = "Am-241 59.5"}, {.x = 60, .label = "another"}}};
}

/// 0xRRGGBB in the middle of a cell of small_map(), whose box is 512 px wide from (72, 44) on, two pixels per px.
std::uint32_t cell_pixel(const std::filesystem::path& file, int column, int row_from_top) {
  cairo_surface_t* image = cairo_image_surface_create_from_png(file.c_str());
  EXPECT_EQ(cairo_surface_status(image), CAIRO_STATUS_SUCCESS);
  const int x = 2 * (72 + 64 + 256 * column), y = 2 * (44 + 64 + 256 * row_from_top);
  const auto* bytes = cairo_image_surface_get_data(image) + y * cairo_image_surface_get_stride(image) + 4 * x;
  const std::uint32_t pixel = *reinterpret_cast<const std::uint32_t*>(bytes) & 0xffffffu;
  cairo_surface_destroy(image);
  return pixel;
}

std::uint32_t rgb(Colour c) {
  const auto byte = [](double value) { return static_cast<std::uint32_t>(std::lround(255 * value)); };
  return byte(c.red) << 16 | byte(c.green) << 8 | byte(c.blue);
}

TEST(Picture, AHeatMapHasItsFirstRowAtTheBottomInTheColoursOfItsScale) {
  const auto file = scratch_file("map.png");
  write_picture(file, {small_map()});
  EXPECT_EQ(cell_pixel(file, 0, 1), rgb(scale_colour(0.0)));
  EXPECT_EQ(cell_pixel(file, 1, 1), rgb(scale_colour(0.5)));
  EXPECT_EQ(cell_pixel(file, 0, 0), rgb(scale_colour(1.0)));
  EXPECT_EQ(cell_pixel(file, 1, 0), 0xffffffu) << "nothing there";
}

/// In a process of its own, as a command writes it: cairo counts images through a process.
std::string written(const std::filesystem::path& file) {
  const pid_t child = fork();
  if (child == 0) {
    write_picture(file, {small_chart(), small_map()});
    _exit(0);
  }
  EXPECT_EQ(waitpid(child, nullptr, 0), child);
  return read_file(file);
}

TEST(Picture, TheSameCommandGivesTheSameBytes) {
  const std::string png = written(scratch_file("a.png")), svg = written(scratch_file("a.svg"));
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_EQ(written(scratch_file("a.png")), png);
  EXPECT_EQ(written(scratch_file("a.svg")), svg);
}

TEST(Picture, LightnessFallsAllAlongTheScale) {
  const auto luminance = [](Colour c) { return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue; };
  for (int i = 1; i <= 50; ++i) {
    EXPECT_LT(luminance(scale_colour(i / 50.0)), luminance(scale_colour((i - 1) / 50.0))) << i;
  }
}

TEST(Picture, WhatCannotBeDrawnIsRefused) {
  EXPECT_NO_THROW(write_picture("", {small_chart()}));
  EXPECT_THROW(require_picture("picture.jpg"), std::runtime_error);
  EXPECT_THROW(write_picture("picture", {small_chart()}), std::runtime_error);
  EXPECT_THROW(write_picture("/nowhere/picture.png", {small_chart()}), std::runtime_error);
  const auto file = scratch_file("wrong.png");
  HeatMap map = small_map();
  map.values.pop_back();
  EXPECT_THROW(write_picture(file, {map}), std::invalid_argument);
  Chart chart = small_chart();
  chart.y.min = 0.0;
  EXPECT_THROW(write_picture(file, {chart}), std::invalid_argument) << "a logarithm of 0";
  chart = small_chart();
  chart.curves[0].x.pop_back();
  EXPECT_THROW(write_picture(file, {chart}), std::invalid_argument);
}

}  // namespace
}  // namespace comptonaut
