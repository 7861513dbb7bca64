// SPDX-License-Identifier: BSD-3-Clause
// One run of each configuration as a row of small maps: where the drones had been, and what was reported.

const FOUND_M = 2, MAP_PX = 240, ROOM = 0.04, RECENT_S = 5;
const TRACK_COLOURS = ["#5a7184", "#8a7a5c", "#6f6490", "#4f7d6c", "#93655f", "#74777c"];

function mapScales(area_m) {
  const [x_min, x_max, y_min, y_max] = area_m, room_m = ROOM * Math.max(x_max - x_min, y_max - y_min);
  const scale = MAP_PX / (x_max - x_min + 2 * room_m);
  return {scale, height: Math.round(scale * (y_max - y_min + 2 * room_m)),
          x: x_m => scale * (x_m - x_min + room_m), y: y_m => scale * (y_max + room_m - y_m)};
}

function estimateMark(x, y, isFalse) {
  const cross = `M${x - 4} ${y - 4}l8 8M${x - 4} ${y + 4}l8 -8`;
  return [svg("path", {d: cross, stroke: "#fff", "stroke-width": 4.5, "stroke-linecap": "round"}),
          svg("path", {d: cross, stroke: isFalse ? "#d0021b" : "#111", "stroke-width": 2, "stroke-linecap": "round"})];
}

function truthMark(x, y, r) {
  return [svg("circle", {cx: x, cy: y, r, fill: "#ffd86b", "fill-opacity": 0.55, stroke: "#8a6a00", "stroke-width": 1.3})];
}

function droneMark(x, y, mav) {
  return [svg("circle", {cx: x, cy: y, r: 6.5, fill: TRACK_COLOURS[(mav - 1) % TRACK_COLOURS.length], stroke: "#fff"}),
          svg("text", {x, y: y + 3.5, "text-anchor": "middle", style: "fill:#fff;font-weight:700;font-size:9.5px"}, mav)];
}

function drawSmallMap(campaign, run, moment) {
  const {x, y, scale, height} = mapScales(campaign.area_m), [x_min, x_max, y_min, y_max] = campaign.area_m;
  const root = svg("svg", {viewBox: `0 0 ${MAP_PX} ${height}`, role: "img", "aria-label": `after ${moment.t_s} s`});
  root.append(svg("rect", {width: MAP_PX, height, fill: "#f4f5f7"}),
              svg("rect", {x: x(x_min), y: y(y_max), width: scale * (x_max - x_min), height: scale * (y_max - y_min),
                           fill: "#fff", stroke: "#aab1ba"}));
  if (campaign.buildings_m.length) root.append(buildingsMark(campaign.buildings_m, x, y));
  for (const [x_m, y_m] of run.sources_m) root.append(...truthMark(x(x_m), y(y_m), Math.max(4, FOUND_M * scale)));
  const last = Math.round(moment.t_s / run.track_period_s), recent = Math.max(0, last - Math.round(RECENT_S / run.track_period_s));
  run.tracks_m.forEach((track, i) => {
    const points = track.slice(0, last + 1).map(([x_m, y_m]) => [x(x_m), y(y_m)]);
    const stroke = {fill: "none", stroke: TRACK_COLOURS[i % TRACK_COLOURS.length], "stroke-linejoin": "round"};
    root.append(svg("path", {d: path(points), ...stroke, "stroke-width": 0.9, opacity: 0.6}),
                svg("path", {d: path(points.slice(recent)), ...stroke, "stroke-width": 2.2}));
  });
  run.tracks_m.forEach((track, i) => {
    const place = track[Math.min(last, track.length - 1)];
    if (place) root.append(...droneMark(x(place[0]), y(place[1]), i + 1));
  });
  for (const [x_m, y_m, isFalse] of moment.reported) root.append(...estimateMark(x(x_m), y(y_m), isFalse));
  return root;
}

function mapRow(campaign, team, index) {
  const figures = team.run.moments.map(moment => {
    const wrong = moment.reported.filter(([, , isFalse]) => isFalse).length;
    const text = ` · ${moment.found} of ${team.run.sources_m.length} found${wrong ? ` · ${wrong} false` : ""}` +
        ` · RMSE\u00a0${fixed(moment.rmse_m, moment.rmse_m < 10 ? 2 : 0)}\u00a0m`;
    return html("figure", {}, drawSmallMap(campaign, team.run, moment),
                html("figcaption", {}, html("b", {}, `${moment.t_s} s`), text));
  });
  return html("div", {class: "map-row"}, html("h3", {}, swatch(index), team.name), html("div", {}, ...figures));
}

/** What the marks mean. */
function showMarks(element, campaign) {
  const mark = (...parts) => svg("svg", {width: 18, height: 18, viewBox: "-9 -9 18 18"}, ...parts);
  const track = svg("path", {d: "M-8 4L0 -3L8 0", fill: "none", stroke: TRACK_COLOURS[0], "stroke-width": 2.2});
  element.replaceChildren(mark(...truthMark(0, 0, 6)), "true source, 2 m around it", mark(...estimateMark(0, 0, false)),
      "found", mark(...estimateMark(0, 0, true)), "false", mark(...droneMark(0, 0, 1)),
      "drone", mark(track), `its track, bold the last ${RECENT_S} s`);
  if (campaign.buildings_m.length) {
    element.append(mark(svg("rect", {x: -7, y: -6, width: 14, height: 12, ...BUILDING})), "building, wall");
  }
}
