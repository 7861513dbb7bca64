// SPDX-License-Identifier: BSD-3-Clause
// Puts the page together. The time that it shows is in the address: #t=120.

const mission = JSON.parse(document.getElementById("mission").textContent);
const maps = [mission.map, ...mission.more_maps].filter(map => map);  // mission.map is the one that is shown
const layers = {buildings: true, tracks: true, plans: true, unsearched: true, truth: true, estimates: true,
                clearance: false};
const SHINES_THROUGH = {fill: "#5b626b", "fill-opacity": 0.35};  // of buildings: the activity of walls and roofs
const REPLAY_S = 20;  // a whole mission takes so long to replay
let time_s = mission.duration_s;
let view = null;

/** Length of the time axes, s. */
function spanS() {
  return Math.max(1, mission.duration_s);
}

function lastTick() {
  return lastNotAbove(mission.ticks.t_s, time_s);
}

function showHead() {
  document.title = `${mission.headline} - Comptonaut`;
  document.getElementById("headline").textContent = mission.headline;
  const date = new Date(mission.start_utime_us / 1000).toISOString().slice(0, 16).replace("T", " ");
  const versions = [...new Set(mission.daemons.map(daemon => daemon.version).filter(version => version))];
  const {truth} = mission;
  const facts = [truth ? `${truth.scenario} (simulated)` : "truth not known",
                 plural(mission.drones.length, "drone"),
                 `${mission.duration_s.toFixed(0)} s from ${date} UTC`,
                 mission.estimator ? `estimator ${mission.estimator}` : "",
                 maps.map(map => map.nuclide).join(", "),
                 truth && truth.time_scale !== 1 ? `run at ${digits(truth.time_scale, 2)} × real time` : "",
                 versions.length ? `version ${versions.join(", ")}` : ""];
  document.getElementById("facts").textContent = facts.filter(fact => fact).join("  ·  ");
  document.getElementById("remarks").replaceChildren(...mission.remarks.map(remark => html("li", {}, remark)));
}

function showLayerBoxes() {
  const names = {tracks: "tracks", plans: "plans", unsearched: "not searched"};
  if (mission.buildings_m.length) names.buildings = "buildings";
  if (mission.truth) names.truth = "true sources";
  names.estimates = "estimates";
  if (mission.clearance) names.clearance = "clear ground";
  document.getElementById("layers").replaceChildren(...Object.entries(names).map(([layer, name]) => {
    const box = html("input", {type: "checkbox"});
    box.checked = layers[layer];
    box.addEventListener("change", () => { layers[layer] = box.checked; showMap(); });
    return html("label", {}, box, name);
  }));
  if (maps.length > 1) document.getElementById("layers").append(html("label", {}, "map of", mapChoice()));
}

function mapChoice() {
  const choice = html("select", {id: "nuclide"}, ...maps.map((map, i) => html("option", {value: i}, map.nuclide)));
  choice.addEventListener("change", () => { mission.map = maps[choice.value]; showMap(); });
  return choice;
}

function showMap() {
  const panel = document.getElementById("map"), tick = lastTick();
  paintMap(panel.querySelector("canvas"), mission.map, frameAt(mission.map, time_s), view, layers.unsearched);
  const size = {width: view.full_width, height: view.full_height, viewBox: `0 0 ${view.full_width} ${view.full_height}`};
  const root = svg("svg", {...size, role: "img", "aria-label": "Radiation map"});
  const inside = {x: view.left, y: view.top, width: view.width, height: view.height};
  const clip = svg("clipPath", {id: "map-clip"}, svg("rect", inside));
  const marks = svg("g", {"clip-path": "url(#map-clip)"});
  const each = draw => mission.drones.forEach((drone, i) => draw(marks, drone, categoryColour(i), view, time_s));
  if (layers.buildings && mission.buildings_m.length) {
    marks.append(buildingsMark(mission.buildings_m, view.x, view.y, {...BUILDING, ...SHINES_THROUGH}));
  }
  if (layers.clearance) drawClearance(marks, mission, view);
  if (layers.tracks) each(drawTrack);
  if (layers.plans) each(drawPlan);
  if (layers.truth && mission.truth) drawTruth(marks, mission, view, tick);
  if (layers.estimates) drawEstimates(marks, mission, view, tick);
  if (layers.estimates) drawPatches(marks, mission, view);
  if (layers.tracks) each(drawDrone);
  root.append(clip, marks);
  drawFrame(root, view);
  if (mission.map) drawColourBar(root, view, mission.map);
  root.addEventListener("pointermove", event => tip.show(event, placeTip(event, root)));
  root.addEventListener("pointerleave", tip.hide);
  panel.querySelector("svg")?.remove();
  panel.append(root);
}

/** What is under the pointer, exactly. */
function placeTip(event, root) {
  const box = root.getBoundingClientRect();
  const x_m = view.x_m(event.clientX - box.left), y_m = view.y_m(event.clientY - box.top);
  const lines = [`east ${x_m.toFixed(1)} m, north ${y_m.toFixed(1)} m`, cellTip(x_m, y_m)];
  const near = (x, y) => Math.hypot(x - x_m, y - y_m) < Math.max(2, 8 / view.scale);
  (mission.truth ? mission.truth.sources : []).forEach((source, i) => {
    const place = placeText(source.x_m, source.y_m);
    if (near(source.x_m, source.y_m)) lines.push(`S${i + 1}: ${source.nuclide}, ${activity(source.activity_Bq)} at ${place} m`);
  });
  for (const row of estimateRows(mission, lastTick())) {
    const place = placeText(row.x_m, row.y_m);
    if (near(row.x_m, row.y_m)) lines.push(`estimate: ${activity(row.activity_Bq)} at ${place} m`, sigmaText(row));
  }
  for (const {x_m: x, y_m: y, radius_m, activity_Bq} of mission.patches ?? []) {
    if (Math.hypot(x - x_m, y - y_m) > radius_m) continue;
    lines.push(`spread: ${activity(activity_Bq)} on ${(Math.PI * radius_m ** 2).toFixed(0)} m²`);
  }
  return lines.filter(line => line).join("\n");
}

function cellTip(x_m, y_m) {
  const {map} = mission, frame = frameAt(map, time_s);
  if (!frame) return "";
  const column = Math.floor(x_m / map.cell_m) - map.origin[0], row = Math.floor(y_m / map.cell_m) - map.origin[1];
  const j = row * map.size[0] + column, share = frame.values[j];
  if (column < 0 || row < 0 || column >= map.size[0] || row >= map.size[1] || isNaN(share)) return "no cell";
  const searched = frame.searchedCells[j] ? "searched" : "not yet searched";
  if (!frame.exact) return `λ ${share > 0 ? "about" : "at most"} ${activity(lambdaAt(share, map))}, ${searched}`;
  map.sensitivityCells ??= decodeFloats(map.sensitivity_s);
  return `λ ${activity(frame.exact[j])}, ${searched}\nsensitivity ${map.sensitivityCells[j].toExponential(2)} events per Bq${clearTip(x_m, y_m)}`;
}

/** Above which activity the place is clear of another source, where that was told. */
function clearTip(x_m, y_m) {
  if (!mission.clearance) return "";
  const {cell_m, cells} = mission.clearance, at = [x_m, y_m].map(p_m => Math.floor(p_m / cell_m));
  const cell = cells.find(([column, row]) => column === at[0] && row === at[1]);
  return cell ? `\nclear above ${activity(1000 * cell[2])} (95 %)` : "\nnot known to be clear";
}

/** The error under one-to-one assignment, where it is another one. */
function oneToOne(rmse_nearest_m, rmse_m) {
  return rmse_m < 1.01 * rmse_nearest_m ? "" : ` (one to one ${fixed(rmse_m, 2)} m)`;
}

function showNow() {
  const tick = lastTick(), {ticks} = mission, parts = [];
  if (tick >= 0 && mission.truth) {
    parts.push(`${ticks.found_2m[tick]} of ${mission.truth.sources.length} found within 2 m`, `${ticks.false[tick]} false`,
               `RMSE ${fixed(ticks.rmse_nearest_m[tick], 2)} m${oneToOne(ticks.rmse_nearest_m[tick], ticks.rmse_m[tick])}`);
    if (ticks.activity_error_rel[tick] !== null) parts.push(`activity off by ${percent(ticks.activity_error_rel[tick], 0)}`);
  } else if (tick >= 0) {
    parts.push(`${ticks.estimates[tick].length} reported`);
  }
  if (tick >= 0) parts.push(`${percent(ticks.coverage[tick], 0)} searched`);
  if (ticks.t_s.length === 0) parts.push("no estimate was recorded");
  document.getElementById("now").textContent = parts.join("  ·  ");
  document.getElementById("time").value = time_s;
  document.getElementById("time-text").textContent = `${time_s.toFixed(0)} of ${mission.duration_s.toFixed(0)} s`;
  const end = tick === ticks.t_s.length - 1;
  document.getElementById("sources-title").textContent = end ? "Sources" : `Sources at ${time_s.toFixed(0)} s`;
}

function showErrorChart(height) {
  const panel = document.getElementById("error-panel"), {ticks} = mission;
  panel.hidden = !mission.truth || ticks.t_s.length === 0;
  if (panel.hidden) return;
  const lines = mission.truth.sources.map((_, i) =>
      ({name: `S${i + 1}`, colour: categoryColour(i), t: ticks.t_s, y: ticks.nearest_m.map(row => row[i])}));
  lines.push({name: "RMSE", colour: "#111", width: 2.6, t: ticks.t_s, y: ticks.rmse_nearest_m});
  const high = Math.max(...ticks.nearest_m.flat(), 10);
  drawChart("error", {name: "Distance to the nearest estimate", t_max: spanS(), height, unit: "m", decimals: 2,
                      log: [0.05, 10 ** Math.ceil(Math.log10(high))], level: {y: 2, text: "found: within 2 m"}, lines, labels: true});
}

function showCountChart(height) {
  const {ticks} = mission, {truth} = mission;
  document.getElementById("progress").hidden = ticks.t_s.length === 0;
  if (ticks.t_s.length === 0) return;
  const t = [...ticks.t_s, mission.duration_s];
  const step = (name, colour, y, dash) => ({name, colour, t, y: [...y, y.at(-1) ?? null], step: true, dash, width: 2});
  const lines = [];
  if (truth) {
    lines.push(step("≤ 2 m", "#0072b2", ticks.found_2m), step("≤ 0.5 m", "#009e73", ticks.found_half_m, "6 3"),
               step("false", "#d55e00", ticks.false));
  } else {
    lines.push(step("reported", "#0072b2", ticks.estimates.map(list => list.length)));
  }
  document.getElementById("count-title").textContent = truth ? "Sources found, and false ones" : "Sources reported";
  const high = Math.max(truth ? truth.sources.length : 1, ...lines.flatMap(line => line.y)) + 0.5;
  drawChart("count", {name: "Sources found", t_max: spanS(), height, unit: "sources", counts: true, decimals: 0, high,
                      lines, labels: true});
}

function showCoverageChart(height) {
  const {t_s: t, coverage} = mission.ticks;
  if (t.length === 0) return;
  const line = {name: "searched", colour: "#0072b2", t, y: coverage.map(share => 100 * share), width: 2};
  drawChart("coverage", {name: "Area searched", t_max: spanS(), height, unit: "%", decimals: 0, high: 100, lines: [line]});
}

/** Counts of whole bins over their live time. */
function rateLine(drone, kind, colour, bin_s) {
  const bins = new Map();
  drone.rates.t_s.forEach((t_s, i) => {
    const key = Math.floor(t_s / bin_s + 1e-9), bin = bins.get(key) || {counts: 0, live_s: 0};
    bins.set(key, {counts: bin.counts + drone.rates[kind][i], live_s: bin.live_s + drone.rates.live_s[i]});
  });
  const keys = [...bins.keys()].sort((a, b) => a - b);
  return {name: `drone ${drone.mav}`, colour, t: keys.map(key => Math.max(0, (key + 0.5) * bin_s)),
          y: keys.map(key => bins.get(key).live_s > 0 ? bins.get(key).counts / bins.get(key).live_s : null)};
}

function showRates() {
  const bin_s = Math.max(1, Math.ceil(mission.duration_s / 30));
  for (const kind of ["singles", "pairs", "others"]) {
    const lines = mission.drones.map((drone, i) => rateLine(drone, kind, categoryColour(i), bin_s));
    const high = 1.05 * Math.max(0.1, ...lines.flatMap(line => line.y.filter(y => y !== null)));
    drawChart(`rate-${kind}`, {name: kind, t_max: spanS(), height: 130, unit: "1/s", decimals: 2, high, lines,
                               labels: true});
  }
}

/** The two charts beside the map share the height that the table of sources leaves. */
function chartHeights() {
  const taken = document.getElementById("sources").offsetHeight + 3 * 26 + 20;
  const left = Math.max(240, document.getElementById("map-panel").offsetHeight - taken);
  return [0.6, 0.4].map(share => Math.round(Math.min(340, share * left)));
}

/** Everything whose size depends on the window's. */
function layOut() {
  charts.length = 0;
  const height = Math.max(380, Math.min(innerHeight - 210, 760)), main = document.querySelector("main");
  const wanted = makeView(mission, 4000, height).full_width;
  main.style.setProperty("--map-width", `${Math.min(0.56 * main.clientWidth, wanted)}px`);
  view = makeView(mission, document.getElementById("map-panel").clientWidth, height);
  setTime(time_s);
  const [upper, lower] = chartHeights();
  showErrorChart(upper);
  showCountChart(lower);
  showCoverageChart(lower);
  showRates();
  setTime(time_s);
}

function setTime(t_s) {
  time_s = Math.min(mission.duration_s, Math.max(0, t_s));
  showMap();
  showNow();
  showSources(mission, lastTick());
  for (const setCursor of charts) setCursor(time_s);
}

let playing = null;  // of requestAnimationFrame

function play() {
  const from_s = time_s >= mission.duration_s ? 0 : time_s, started_ms = performance.now();
  const step = now_ms => {
    setTime(from_s + (now_ms - started_ms) / 1000 * mission.duration_s / REPLAY_S);
    if (time_s < mission.duration_s) playing = requestAnimationFrame(step); else stop();
  };
  document.getElementById("play").textContent = "❚❚";
  playing = requestAnimationFrame(step);
}

function stop() {
  if (playing !== null) cancelAnimationFrame(playing);
  playing = null;
  document.getElementById("play").textContent = "▶";
}

function timeOfAddress() {
  const match = location.hash.match(/^#t=([\d.]+)$/);
  return match ? Number(match[1]) : mission.duration_s;
}

function start() {
  showHead();
  showLayerBoxes();
  showShares(mission);
  showDrones(mission);
  showDaemons(mission);
  showRecording(mission);
  const slider = document.getElementById("time");
  slider.max = Math.ceil(mission.duration_s);
  slider.addEventListener("input", () => { stop(); setTime(Number(slider.value)); });
  slider.addEventListener("change", () => history.replaceState(null, "", `#t=${slider.value}`));
  document.getElementById("play").addEventListener("click", () => playing === null ? play() : stop());
  addEventListener("hashchange", () => { stop(); setTime(timeOfAddress()); });
  addEventListener("resize", layOut);
  time_s = timeOfAddress();
  layOut();
}

start();
