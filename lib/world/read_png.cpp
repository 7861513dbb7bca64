// SPDX-License-Identifier: BSD-3-Clause
#include "world/read_png.h"

#include <png.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

namespace comptonaut {
namespace {

constexpr double kPixelsMax = 1e8;

struct Source {
  std::string_view left;
  std::string error;
};

// libpng is C: its errors must leave by longjmp, nothing may be thrown through it.
extern "C" void take_bytes(png_structp png, png_bytep to, std::size_t n) {
  auto* source = static_cast<Source*>(png_get_io_ptr(png));
  if (source->left.size() < n) png_error(png, "it is cut short");
  std::memcpy(to, source->left.data(), n);
  source->left.remove_prefix(n);
}

extern "C" void keep_error(png_structp png, png_const_charp what) {
  static_cast<Source*>(png_get_error_ptr(png))->error = what;
  png_longjmp(png, 1);
}

extern "C" void ignore_warning(png_structp /*png*/, png_const_charp /*what*/) {}

/// A reading of libpng, and all that must be freed after it.
struct Reading {
  explicit Reading(Source& source)
      : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, keep_error, ignore_warning)),
        info(png != nullptr ? png_create_info_struct(png) : nullptr) {
    if (info == nullptr) throw std::runtime_error("libpng cannot be used");
    png_set_read_fn(png, &source, take_bytes);
  }
  ~Reading() { png_destroy_read_struct(&png, &info, nullptr); }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

  png_structp png;
  png_infop info;
};

/// Up to the pixels: every file is turned into 16 bits of red, green, blue and opacity. False: libpng failed.
bool begin(Reading& reading) {
  if (setjmp(png_jmpbuf(reading.png)) != 0) return false;
  png_read_info(reading.png, reading.info);
  png_set_expand_16(reading.png);
  png_set_gray_to_rgb(reading.png);
  png_set_add_alpha(reading.png, 0xFFFF, PNG_FILLER_AFTER);
  png_set_interlace_handling(reading.png);
  png_read_update_info(reading.png, reading.info);
  return true;
}

bool read_rows(Reading& reading, std::vector<png_bytep>& rows) {
  if (setjmp(png_jmpbuf(reading.png)) != 0) return false;
  png_read_image(reading.png, rows.data());
  return true;
}

}  // namespace

bool is_png(std::string_view bytes) {
  return bytes.size() >= 8 && png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, 8) == 0;
}

GreyPicture read_png(std::string_view bytes) {
  Source source{.left = bytes, .error = {}};
  Reading reading(source);
  if (!is_png(bytes)) throw std::runtime_error("it is no PNG");
  if (!begin(reading)) throw std::runtime_error(source.error);
  GreyPicture picture{.columns = static_cast<int>(png_get_image_width(reading.png, reading.info)),
                      .rows = static_cast<int>(png_get_image_height(reading.png, reading.info))};
  if (static_cast<double>(picture.columns) * picture.rows > kPixelsMax) throw std::runtime_error("it is too large");
  const std::size_t row_bytes = png_get_rowbytes(reading.png, reading.info);
  std::vector<std::uint8_t> pixels(row_bytes * static_cast<std::size_t>(picture.rows));
  std::vector<png_bytep> rows;
  for (int y = 0; y < picture.rows; ++y) rows.push_back(&pixels[row_bytes * static_cast<std::size_t>(y)]);
  if (!read_rows(reading, rows)) throw std::runtime_error(source.error);
  for (const std::uint8_t* row : rows) {
    for (int x = 0; x < picture.columns; ++x) {
      const auto part = [&](int i) { return 256 * row[8 * x + 2 * i] + row[8 * x + 2 * i + 1]; };
      const double grey = (part(0) + part(1) + part(2)) / (3.0 * 65535.0);
      picture.grey.push_back(part(3) > 32767 ? grey : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return picture;
}

}  // namespace comptonaut
