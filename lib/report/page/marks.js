// SPDX-License-Identifier: BSD-3-Clause
// What is drawn over the map: axes, colour bar, tracks, plans, true and found sources.

const TAIL_S = 15;      // this much of a track is drawn strong
const REACHED_M = 1.5;  // a waypoint that the track came so near counts as flown

/** The rectangle of the world that is shown, m, and where it lies on the screen, px. */
function makeView(mission, width, height_max) {
  const [x_min, x_max, y_min, y_max] = shownArea(mission);
  const left = 46, right = mission.map ? 92 : 12, top = 6, bottom = 34;
  const scale = Math.min((width - left - right) / (x_max - x_min), (height_max - top - bottom) / (y_max - y_min));
  const view = {x_min, x_max, y_min, y_max, left, top, scale,
                width: scale * (x_max - x_min), height: scale * (y_max - y_min)};
  view.full_width = Math.round(left + view.width + right);
  view.full_height = Math.round(top + view.height + bottom);
  view.x = x_m => left + scale * (x_m - x_min);
  view.y = y_m => top + scale * (y_max - y_m);
  view.x_m = px => x_min + (px - left) / scale;
  view.y_m = px => y_max - (px - top) / scale;
  return view;
}

/** The map, the area and the tracks, with a little room around them. */
function shownArea(mission) {
  const x = [], y = [];
  if (mission.map) {
    const {origin, size, cell_m} = mission.map;
    x.push(origin[0] * cell_m, (origin[0] + size[0]) * cell_m);
    y.push(origin[1] * cell_m, (origin[1] + size[1]) * cell_m);
  }
  if (mission.truth) {
    x.push(...mission.truth.area_m.slice(0, 2));
    y.push(...mission.truth.area_m.slice(2));
  }
  for (const drone of mission.drones) {
    for (const value of drone.track.x_m) x.push(value);
    for (const value of drone.track.y_m) y.push(value);
  }
  if (x.length === 0) return [0, 50, 0, 50];
  const low = list => list.reduce((a, b) => Math.min(a, b)), high = list => list.reduce((a, b) => Math.max(a, b));
  const room = 0.012 * Math.max(high(x) - low(x), high(y) - low(y), 1);
  return [low(x) - room, high(x) + room, low(y) - room, high(y) + room];
}

function drawFrame(root, view) {
  const bottom = view.top + view.height, steps = 5;
  for (const axis of ["x", "y"]) {
    const {steps: values, decimals} = niceSteps(view[`${axis}_min`], view[`${axis}_max`], steps);
    for (const value of values) {
      const text = value.toFixed(decimals).replace("-", "−");
      if (axis === "x") {
        root.append(svg("line", {x1: view.x(value), x2: view.x(value), y1: bottom, y2: bottom + 4, stroke: "#5b626b"}),
                    svg("text", {x: view.x(value), y: bottom + 16, "text-anchor": "middle", class: "axis"}, text));
      } else {
        root.append(svg("line", {x1: view.left - 4, x2: view.left, y1: view.y(value), y2: view.y(value), stroke: "#5b626b"}),
                    svg("text", {x: view.left - 7, y: view.y(value) + 4, "text-anchor": "end", class: "axis"}, text));
      }
    }
  }
  const title = {"text-anchor": "middle", class: "axis"};
  const {left: x, top: y, width, height} = view;
  root.append(svg("rect", {x, y, width, height, fill: "none", stroke: "#5b626b"}),
              svg("text", {x: x + width / 2, y: bottom + 30, ...title}, "east, m"),
              svg("text", {transform: `translate(11 ${y + height / 2}) rotate(-90)`, ...title}, "north, m"));
}

/** The colour bar, with a tick at each decade, and what the hatching means. */
function drawColourBar(root, view, map) {
  const x = view.left + view.width + 14, top = view.top + 30, height = Math.min(280, view.height - 90), width = 14;
  for (let i = 0; i < height; ++i) {
    const [r, g, b] = mapColour(1 - i / (height - 1));
    root.append(svg("rect", {x, y: top + i, width, height: 1.5, fill: `rgb(${r},${g},${b})`}));
  }
  root.append(svg("rect", {x, y: top, width, height, fill: "none", stroke: "#5b626b", "stroke-width": 0.8}),
              svg("text", {x, y: view.top + 9}, "λ, activity"), svg("text", {x, y: view.top + 22}, "of a cell"));
  for (let power = Math.ceil(Math.log10(map.bottom_Bq) - 0.05); 10 ** power <= map.top_Bq * 1.001; ++power) {
    const y = top + height * (1 - shareOf(10 ** power, map));
    root.append(svg("line", {x1: x + width, x2: x + width + 3, y1: y, y2: y, stroke: "#5b626b"}),
                svg("text", {x: x + width + 5, y: y + 4, class: "axis"}, activity(10 ** power).replace(/\.0+(?=\D)/, "")));
  }
  const y = top + height + 16;
  const hatching = [`M${x} ${y + 7}l7 -7`, `M${x} ${y + 14}l14 -14`, `M${x + 7} ${y + 14}l7 -7`].join("");
  root.append(svg("rect", {x, y, width: 14, height: 14, fill: "none", stroke: "#5b626b", "stroke-width": 0.8}),
              svg("path", {d: hatching, stroke: "#5b626b"}),
              svg("text", {x: x + 19, y: y + 7, class: "axis"}, "not yet"),
              svg("text", {x: x + 19, y: y + 19, class: "axis"}, "searched"));
}

/** Points of a track up to a time, px. */
function trackPoints(track, view, from_s, to_s) {
  const first = Math.max(0, lastNotAbove(track.t_s, from_s)), last = lastNotAbove(track.t_s, to_s);
  const points = [];
  for (let i = first; i <= last; ++i) points.push([view.x(track.x_m[i]), view.y(track.y_m[i])]);
  return points;
}

function drawTrack(root, drone, colour, view, t_s) {
  const all = trackPoints(drone.track, view, -1e9, t_s), tail = trackPoints(drone.track, view, t_s - TAIL_S, t_s);
  const stroke = {fill: "none", "stroke-linejoin": "round", "stroke-linecap": "round"};
  root.append(svg("path", {d: path(all), ...stroke, stroke: colour, "stroke-width": 1.1, opacity: 0.5}),
              svg("path", {d: path(tail), ...stroke, stroke: "#fff", "stroke-width": 4, opacity: 0.55}),
              svg("path", {d: path(tail), ...stroke, stroke: colour, "stroke-width": 2.4}));
}

/** The waypoints that are still ahead at a time. */
function waypointsAhead(drone, t_s) {
  const index = lastNotAbove(drone.plans.map(plan => plan.t_s), t_s);
  if (index < 0) return [];
  const {t_s: made_s, waypoints_m} = drone.plans[index], {track} = drone;
  let next = 0;
  for (let i = Math.max(0, lastNotAbove(track.t_s, made_s)); i < track.t_s.length && track.t_s[i] <= t_s; ++i) {
    const near = w => Math.hypot(track.x_m[i] - w[0], track.y_m[i] - w[1]) < REACHED_M;
    while (next < waypoints_m.length && near(waypoints_m[next])) ++next;
  }
  return waypoints_m.slice(next);
}

function drawPlan(root, drone, colour, view, t_s) {
  const here = lastNotAbove(drone.track.t_s, t_s), ahead = waypointsAhead(drone, t_s);
  if (here < 0 || ahead.length === 0) return;
  const points = [[drone.track.x_m[here], drone.track.y_m[here]], ...ahead].map(([x, y]) => [view.x(x), view.y(y)]);
  root.append(svg("path", {d: path(points), fill: "none", stroke: colour, "stroke-width": 1.4, "stroke-dasharray": "2 4"}));
  for (const [cx, cy] of points.slice(1)) {
    root.append(svg("circle", {cx, cy, r: 2.6, fill: "#fff", stroke: colour, "stroke-width": 1.4}));
  }
}

function drawDrone(root, drone, colour, view, t_s) {
  const here = lastNotAbove(drone.track.t_s, t_s);
  if (here < 0) return;
  const x = view.x(drone.track.x_m[here]), y = view.y(drone.track.y_m[here]);
  root.append(svg("circle", {cx: x, cy: y, r: 8.5, fill: colour, stroke: "#fff", "stroke-width": 1.5}),
              svg("text", {x, y: y + 4, "text-anchor": "middle", style: "fill:#fff;font-weight:700"}, drone.mav));
}

/** Rings of 2 m, within which an estimate counts as found, with number and distance of the nearest estimate. */
function drawTruth(root, mission, view, tick) {
  mission.truth.sources.forEach((source, i) => {
    const x = view.x(source.x_m), y = view.y(source.y_m), r = Math.max(6, 2 * view.scale);
    const distance_m = tick >= 0 ? mission.ticks.nearest_m[tick][i] : null;
    const toLeft = source.x_m > 0.8 * view.x_max + 0.2 * view.x_min;
    const text = {x: toLeft ? x - r - 4 : x + r + 4, y: y + 4, class: "halo", "text-anchor": toLeft ? "end" : "start"};
    root.append(svg("circle", {cx: x, cy: y, r, fill: "none", stroke: "#fff", "stroke-width": 4, opacity: 0.75}),
                svg("circle", {cx: x, cy: y, r, fill: "none", stroke: "#111", "stroke-width": 1.6}),
                svg("text", text, svg("tspan", {"font-weight": 700}, `S${i + 1}`),
                    distance_m === null ? "" : ` ${fixed(distance_m, 2)} m`));
  });
}

/** Dashed: where activity is spread, as told last. */
function drawPatches(root, mission, view) {
  for (const {x_m, y_m, radius_m} of mission.patches ?? []) {
    const circle = {cx: view.x(x_m), cy: view.y(y_m), r: radius_m * view.scale, fill: "none", "stroke-dasharray": "5 4"};
    root.append(svg("circle", {...circle, stroke: "#fff", "stroke-width": 4}), svg("circle", {...circle, stroke: "#111", "stroke-width": 2}));
  }
}

/** Blue where the ground is clear of other sources, as told last: full at 1 MBq and below, nothing at 1 GBq and above. */
function drawClearance(root, mission, view) {
  const {cell_m, cells} = mission.clearance, size = cell_m * view.scale;
  for (const [column, row, limit_kBq] of cells) {
    const share = Math.min(1, Math.max(0, (6 - Math.log10(limit_kBq)) / 3));
    if (share === 0) continue;
    root.append(svg("rect", {x: view.x(column * cell_m), y: view.y((row + 1) * cell_m), width: size, height: size,
                             fill: "#0072b2", "fill-opacity": (0.7 * share).toFixed(2)}));
  }
}

function drawEstimates(root, mission, view, tick) {
  if (tick < 0) return;
  for (const [x_m, y_m] of mission.ticks.estimates[tick]) {
    const x = view.x(x_m), y = view.y(y_m), cross = `M${x - 5} ${y - 5}l10 10M${x - 5} ${y + 5}l10 -10`;
    root.append(svg("path", {d: cross, stroke: "#fff", "stroke-width": 5, "stroke-linecap": "round"}),
                svg("path", {d: cross, stroke: "#111", "stroke-width": 2.2, "stroke-linecap": "round"}));
  }
}
