// SPDX-License-Identifier: BSD-3-Clause
#include "picture/canvas.h"

#include <cairo/cairo-svg.h>
#include <cairo/cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

namespace comptonaut {
namespace {

constexpr double kPngScale = 2.0;
constexpr int kImage_px = 1024;  // an image is enlarged to so much, so that no viewer smooths its cells

cairo_surface_t* open_surface(const std::filesystem::path& file, double width, double height) {
  if (file.extension() == ".svg") {
    cairo_surface_t* surface = cairo_svg_surface_create(file.c_str(), width, height);
    cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
    return surface;
  }
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(kPngScale * width)),
                                    static_cast<int>(std::ceil(kPngScale * height)));
}

}  // namespace

struct Canvas::Impl {
  std::filesystem::path file;
  cairo_surface_t* surface;
  cairo_t* cairo;

  void use(Colour c) const { cairo_set_source_rgb(cairo, c.red, c.green, c.blue); }

  void stroke(const Pen& pen) const {
    const double dash[] = {4.0, 3.0};
    use(pen.colour);
    cairo_set_line_width(cairo, pen.width);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_BEVEL);
    cairo_set_dash(cairo, dash, pen.dashed ? 2 : 0, 0.0);
    cairo_stroke(cairo);
  }

  void font(double size, bool bold) const {
    cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, size);
  }
};

Canvas::Canvas(const std::filesystem::path& file, double width, double height) : impl_(std::make_unique<Impl>()) {
  if (!std::ofstream(file)) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
  impl_->file = file;
  impl_->surface = open_surface(file, width, height);
  impl_->cairo = cairo_create(impl_->surface);
  if (file.extension() != ".svg") cairo_scale(impl_->cairo, kPngScale, kPngScale);
  fill({0, 0, width, height}, {1, 1, 1});
}

Canvas::~Canvas() {
  cairo_destroy(impl_->cairo);
  cairo_surface_destroy(impl_->surface);
}

void Canvas::fill(const Box& box, Colour colour) {
  impl_->use(colour);
  cairo_rectangle(impl_->cairo, box.left, box.top, box.width, box.height);
  cairo_fill(impl_->cairo);
}

void Canvas::line(Point from, Point to, const Pen& pen) {
  cairo_move_to(impl_->cairo, from.x, from.y);
  cairo_line_to(impl_->cairo, to.x, to.y);
  impl_->stroke(pen);
}

void Canvas::polyline(std::span<const Point> points, const Pen& pen, const Box& inside) {
  cairo_save(impl_->cairo);
  cairo_rectangle(impl_->cairo, inside.left, inside.top, inside.width, inside.height);
  cairo_clip(impl_->cairo);
  for (const Point& p : points) cairo_line_to(impl_->cairo, p.x, p.y);
  impl_->stroke(pen);
  cairo_restore(impl_->cairo);
}

void Canvas::disc(Point centre, double radius, Colour colour) {
  impl_->use(colour);
  cairo_arc(impl_->cairo, centre.x, centre.y, radius, 0.0, 2.0 * std::numbers::pi);
  cairo_fill(impl_->cairo);
}

void Canvas::text(Point at, const std::string& what, const TextStyle& style) {
  impl_->font(style.size, style.bold);
  cairo_text_extents_t extents;
  cairo_text_extents(impl_->cairo, what.c_str(), &extents);
  cairo_save(impl_->cairo);
  cairo_translate(impl_->cairo, at.x, at.y);
  if (style.upwards) cairo_rotate(impl_->cairo, -0.5 * std::numbers::pi);
  cairo_move_to(impl_->cairo, -style.anchor * extents.x_advance, 0.35 * style.size);
  if (style.haloed) {
    cairo_text_path(impl_->cairo, what.c_str());
    impl_->use({1, 1, 1});
    cairo_set_line_width(impl_->cairo, 3.0);
    cairo_set_line_join(impl_->cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(impl_->cairo);
    cairo_move_to(impl_->cairo, -style.anchor * extents.x_advance, 0.35 * style.size);
  }
  impl_->use(style.colour);
  cairo_show_text(impl_->cairo, what.c_str());
  cairo_restore(impl_->cairo);
}

double Canvas::text_width(const std::string& what, double size) {
  impl_->font(size, false);
  cairo_text_extents_t extents;
  cairo_text_extents(impl_->cairo, what.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::image(const Box& box, int columns, int rows, std::span<const std::uint32_t> argb) {
  const int times = std::max(1, kImage_px / std::max(columns, rows));
  const int width = times * columns, height = times * rows;
  cairo_surface_t* image = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
  unsigned char* const bytes = cairo_image_surface_get_data(image);
  const int stride = cairo_image_surface_get_stride(image);
  for (int y = 0; bytes != nullptr && y < height; ++y) {
    auto* const line = reinterpret_cast<std::uint32_t*>(bytes + static_cast<std::ptrdiff_t>(y) * stride);
    const auto row = argb.subspan(static_cast<std::size_t>(y / times) * static_cast<std::size_t>(columns));
    for (int x = 0; x < width; ++x) {
      const std::uint32_t cell = row[static_cast<std::size_t>(x / times)];
      line[x] = (cell >> 24) != 0 ? cell : 0;  // cairo wants colours times alpha
    }
  }
  cairo_surface_mark_dirty(image);
  cairo_save(impl_->cairo);
  cairo_translate(impl_->cairo, box.left, box.top);
  cairo_scale(impl_->cairo, box.width / width, box.height / height);
  cairo_set_source_surface(impl_->cairo, image, 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(impl_->cairo), CAIRO_FILTER_NEAREST);
  cairo_paint(impl_->cairo);
  cairo_restore(impl_->cairo);
  cairo_surface_destroy(image);
}

void Canvas::finish() {
  cairo_status_t status = cairo_status(impl_->cairo);
  if (status == CAIRO_STATUS_SUCCESS && impl_->file.extension() != ".svg") {
    status = cairo_surface_write_to_png(impl_->surface, impl_->file.c_str());
  }
  cairo_surface_finish(impl_->surface);
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(impl_->surface);
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(
        fmt::format("{}: could not be written: {}", impl_->file.string(), cairo_status_to_string(status)));
  }
}

}  // namespace comptonaut
