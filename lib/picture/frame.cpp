// SPDX-License-Identifier: BSD-3-Clause
#include "picture/frame.h"

#include <algorithm>

#include "picture/ticks.h"

namespace comptonaut {
namespace {

constexpr double kFar = 10.0;         // lengths of an axis; cairo dislikes infinite places
constexpr double kTickEvery_px = 60;  // wanted
constexpr double kTick_px = 4.0;
constexpr TextStyle kTickText = {.size = 11.0};
constexpr TextStyle kLabelText = {.size = 12.5};

int wanted(double length_px) { return std::max(2, static_cast<int>(length_px / kTickEvery_px)); }

void draw_outline(Canvas& canvas, const Box& box) {
  canvas.line({box.left, box.top}, {box.right(), box.top}, kAxisPen);
  canvas.line({box.right(), box.top}, {box.right(), box.bottom()}, kAxisPen);
  canvas.line({box.left, box.bottom()}, {box.right(), box.bottom()}, kAxisPen);
  canvas.line({box.left, box.top}, {box.left, box.bottom()}, kAxisPen);
}

}  // namespace

Point Frame::at(double x_value, double y_value) const {
  return {box.left + box.width * std::clamp(share(x, x_value), -kFar, kFar),
          box.bottom() - box.height * std::clamp(share(y, y_value), -kFar, kFar)};
}

void draw_axes(Canvas& canvas, const Frame& frame, bool grid) {
  const Box& box = frame.box;
  for (const Tick& tick : ticks(frame.x, wanted(box.width))) {
    const double x = frame.at(tick.value, frame.y.min).x;
    if (grid) canvas.line({x, box.top}, {x, box.bottom()}, kGridPen);
    canvas.line({x, box.bottom()}, {x, box.bottom() + kTick_px}, kAxisPen);
    canvas.text({x, box.bottom() + 14.0}, tick.label, kTickText);
  }
  TextStyle ends = kTickText;
  ends.anchor = 1.0;
  for (const Tick& tick : ticks(frame.y, wanted(box.height))) {
    const double y = frame.at(frame.x.min, tick.value).y;
    if (grid) canvas.line({box.left, y}, {box.right(), y}, kGridPen);
    canvas.line({box.left - kTick_px, y}, {box.left, y}, kAxisPen);
    canvas.text({box.left - 8.0, y}, tick.label, ends);
  }
  draw_outline(canvas, box);
  canvas.text({box.left + 0.5 * box.width, box.bottom() + 38.0}, frame.x.label, kLabelText);
  TextStyle upwards = kLabelText;
  upwards.upwards = true;
  canvas.text({box.left - 54.0, box.top + 0.5 * box.height}, frame.y.label, upwards);
}

void draw_title(Canvas& canvas, const Box& box, double above, const std::string& title) {
  canvas.text({box.left + 0.5 * box.width, box.top - above}, title, {.size = 14.0, .bold = true});
}

}  // namespace comptonaut
