// SPDX-License-Identifier: BSD-3-Clause
// Puts the page of a campaign together.

const campaign = JSON.parse(document.getElementById("campaign").textContent);

function swatch(index) {
  return html("span", {class: `swatch${dashOf(index) === "none" ? "" : " dashed"}`, style: `border-color:${categoryColour(index)}`});
}

/** A time to success; null is one beyond the horizon. */
function successText(t_s) {
  return t_s === null ? `> ${campaign.horizon_s} s` : `${digits(t_s, t_s % 1 ? 3 : 1)} s`;
}

/** The quickest configuration: by its median, then by its worst run. */
function bestTeam() {
  const key = team => [team.success_median_s ?? Infinity, team.success_worst_s ?? Infinity];
  const order = campaign.teams.map((_, i) => i).sort((a, b) => {
    const [first, second] = [key(campaign.teams[a]), key(campaign.teams[b])];
    return first[0] === second[0] ? first[1] - second[1] || a - b : first[0] - second[0];
  });
  return order.length && campaign.teams[order[0]].success_median_s !== null ? order[0] : -1;
}

function showHead() {
  const {teams, area_m} = campaign, best = bestTeam();
  if (teams.length === 0) return;
  const winner = teams[best];
  document.getElementById("headline").textContent = best < 0 ? "No configuration succeeds in most of its runs" :
      `${winner.name}${teams.length > 1 ? " is quickest" : ""}: all ${campaign.sources} found, none false, after ` +
      `${successText(winner.success_median_s)} (worst run ${successText(winner.success_worst_s)})`;
  const facts = [campaign.scenario, `seeds ${campaign.seeds}`, plural(campaign.mavs, "drone"),
                 `${area_m[1] - area_m[0]} × ${area_m[3] - area_m[2]} m`, plural(campaign.sources, "source"),
                 `${campaign.horizon_s} s each`];
  document.getElementById("facts").textContent = facts.join("  ·  ");
  document.title = `${campaign.scenario} - Comptonaut campaign`;
}

function showCurves() {
  const {area_m, sources} = campaign;
  const all = campaign.teams.flatMap(team => team.rmse_m.lower.filter(value => value !== null && value > 0));
  const low = Math.min(1, Math.max(0.02, all.reduce((a, b) => Math.min(a, b), 1)));
  const high = Math.hypot(area_m[1] - area_m[0], area_m[3] - area_m[2]);
  drawQuartiles("rmse", campaign, {key: "rmse_m", name: "RMSE over time", unit: "m", decimals: 2,
      level: {y: 2, text: ""}, y: (bottom, top) => logScale(low, high, bottom, top)});
  drawQuartiles("found", campaign, {key: "found", name: "Sources found over time", unit: "", decimals: 1,
      y: (bottom, top) => wholeScale(Math.max(1, sources), bottom, top)});
  document.getElementById("found-title").textContent = `True sources found within 2 m, of ${sources}`;
  document.getElementById("curves").textContent =
      "Lines: median of the runs. Bands: from the lower to the upper quartile. Dashed: 2 m. Point at a curve for its numbers, at a row below to see it alone.";
}

/** Of counts: no ticks between whole numbers. */
function wholeScale(high, from_px, to_px) {
  const scale = value => from_px + value / high * (to_px - from_px), step = Math.max(1, Math.ceil(high / 5));
  const ticks = [];
  for (let value = 0; value <= high; value += step) ticks.push([value, String(value)]);
  return Object.assign(scale, {ticks});
}

/** Each run's time to success as a dot, their median as a bar. */
function successStrip(team, index) {
  const width = 420, height = 22, right = 380, x = timeScale(campaign, 6, right), colour = categoryColour(index);
  const root = svg("svg", {width, height, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": "time to success of each run"});
  for (const [value] of x.ticks) root.append(svg("line", {x1: x(value), x2: x(value), y1: 0, y2: height, stroke: "#e4e7ea"}));
  for (const t_s of team.success_s) {
    if (t_s !== null) root.append(svg("circle", {cx: x(t_s), cy: height / 2, r: 4, fill: colour, opacity: 0.5}));
  }
  if (team.success_median_s !== null) {
    const at = x(team.success_median_s);
    root.append(svg("line", {x1: at, x2: at, y1: 2, y2: height - 2, stroke: colour, "stroke-width": 2.5}));
  }
  if (team.never) root.append(svg("text", {x: right + 8, y: height / 2 + 4, class: "axis"}, `+ ${team.never}`));
  return root;
}

function stripHead() {
  const width = 420, x = timeScale(campaign, 6, 380);
  const root = svg("svg", {width, height: 30, viewBox: `0 0 ${width} 30`});
  root.append(svg("text", {x: 0, y: 11, class: "axis"}, "each run, s"));
  for (const [value, text] of x.ticks) root.append(svg("text", {x: x(value), y: 27, "text-anchor": "middle", class: "axis"}, text));
  if (campaign.teams.some(team => team.never)) root.append(svg("text", {x: 384, y: 11, class: "axis"}, "never"));
  return root;
}

function distanceText(team) {
  return team.distance_min_m === null ? "–" : `${fixed(team.distance_min_m, 2)} m`;
}

/** Of the table: name, a word more, text of a team, whether that is bad. */
const COLUMNS = [
  ["median", "success", team => successText(team.success_median_s)],
  ["worst", "success", team => successText(team.success_worst_s)],
  ["never", "success", team => `${team.never} of ${team.runs}`],
  ["RMSE", "at the end", team => `${fixed(team.rmse_mean_m, 2)} m`],
  ["found", "at the end", team => fixed(team.found_mean, 2)],
  ["false", "at the end", team => fixed(team.false_mean, 2)],
  ["distance", "of drones, least", distanceText],
  ["collisions", "with obstacles", team => whole(team.collisions), team => team.collisions > 0],
  ["outside", "the fence", team => `${fixed(team.outside_s, 1)} s`, team => team.outside_s > 0],
  ["home", "at the end", team => `${team.at_home} of ${team.flights}`],
];

function showTable() {
  const head = html("tr", {}, html("th", {}, "configuration"), html("th", {class: "strip"}, stripHead()),
                    ...COLUMNS.map(([name, of]) => html("th", {class: "number"}, name, html("small", {}, of))));
  const best = bestTeam();
  const rows = campaign.teams.map((team, i) => {
    const row = html("tr", {class: i === best && campaign.teams.length > 1 ? "best" : ""}, html("td", {}, swatch(i), team.name),
                     html("td", {class: "strip"}, successStrip(team, i)),
                     ...COLUMNS.map(([, , text, bad]) => html("td", {class: bad?.(team) ? "number missed" : "number"}, text(team))));
    row.addEventListener("pointerenter", () => showAlone(i));
    row.addEventListener("pointerleave", () => showAlone(-1));
    return row;
  });
  document.getElementById("teams").replaceChildren(html("table", {}, head, ...rows));
  document.getElementById("success").textContent = "Time to success: from when on, until the end, every source is found within 2 m " +
      "and nothing false is reported. RMSE, found and false are means over the runs; the least distance is that of all runs; " +
      "collisions, time outside and drones that came home are summed over them.";
}

/** Fades the curves of all others; -1: none. */
function showAlone(index) {
  for (const part of document.querySelectorAll(".fades")) {
    part.classList.toggle("faded", index >= 0 && !part.classList.contains(`team-${index}`));
  }
}

function showMaps() {
  document.getElementById("maps-title").textContent = `One run, seed ${campaign.run}`;
  showMarks(document.getElementById("marks"), campaign);
  const shown = campaign.teams.map((team, i) => [team, i]).filter(([team]) => team.run.moments.length);
  document.getElementById("maps").replaceChildren(...shown.map(([team, i]) => mapRow(campaign, team, i)));
}

for (const team of campaign.teams) team.name = `${team.strategy} ${team.estimator}`;
showHead();
if (campaign.teams.length) {
  showCurves();
  showTable();
  showMaps();
  addEventListener("resize", showCurves);
}
