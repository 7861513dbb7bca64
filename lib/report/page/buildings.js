// SPDX-License-Identifier: BSD-3-Clause
// Buildings and walls below the flights of a map.

const BUILDING = {class: "building", fill: "#d3d8de"};

/** What stands in the area, as one path without seams. `x` and `y` make pixels of metres. */
function buildingsMark(buildings_m, x, y, style = BUILDING) {
  const px = value => value.toFixed(1);
  const d = buildings_m.map(([x_min, x_max, y_min, y_max]) => `M${px(x(x_min))} ${px(y(y_max))}H${px(x(x_max))}V${px(y(y_min))}H${px(x(x_min))}Z`);
  return svg("path", {d: d.join(""), ...style});
}
