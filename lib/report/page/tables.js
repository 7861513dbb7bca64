// SPDX-License-Identifier: BSD-3-Clause
// Tables: sources, shares of events, drones, daemons.

const PUBLISHED_SHARES = {singles: 0.934, pairs: 0.043, others: 0.023};  // Werner 2024, in flight

/** columns: [{head, unit, cell(row) -> text or element, number, title(row)}]. */
function table(columns, rows) {
  const alignment = column => column.number ? "number" : column.text ? "text" : "";
  const head = columns.map(column => html("th", {class: alignment(column), scope: "col"}, column.head,
                                          html("small", {}, column.unit || "\u00a0")));
  const units = columns.some(column => column.unit);
  if (!units) head.forEach(cell => cell.lastChild.remove());
  const body = rows.map(row => html("tr", {}, ...columns.map(column => {
    const cell = html("td", {class: alignment(column)}, column.cell(row));
    if (column.title && column.title(row)) cell.title = column.title(row);
    return cell;
  })));
  return html("table", {}, html("thead", {}, html("tr", {}, ...head)), html("tbody", {}, ...body));
}

function replace(id, ...children) {
  document.getElementById(id).replaceChildren(...children);
}

function droneBadge(mission, mav) {
  const index = mission.drones.findIndex(drone => drone.mav === mav);
  return html("span", {class: "badge", style: `background:${categoryColour(index)}`}, String(mav));
}

function sourceBadge(index) {
  return html("span", {class: "badge", style: `background:${categoryColour(index)}`}, `S${index + 1}`);
}

function plusMinus(value, sigma, text) {
  return sigma === null ? text(value) : `${text(value)} ± ${text(sigma)}`;
}

function placeText(x_m, y_m) {
  return `${x_m.toFixed(2)}, ${y_m.toFixed(2)}`.replaceAll("-", "−");
}

/** Every estimate with what its estimator tells of it, and the true source that it found. */
function estimateRows(mission, tick) {
  if (tick < 0) return [];
  const last = tick === mission.ticks.t_s.length - 1;
  return mission.ticks.estimates[tick].map(([x_m, y_m, activity_Bq, found], i) =>
      ({x_m, y_m, activity_Bq, found, detail: last ? mission.final_sources[i] : null}));
}

function showSources(mission, tick) {
  const estimates = estimateRows(mission, tick);
  if (!mission.truth) return showReported(estimates);
  const rows = mission.truth.sources.map((source, i) =>
      ({index: i, source, estimate: estimates.find(estimate => estimate.found === i),
        nearest_m: tick < 0 ? null : mission.ticks.nearest_m[tick][i]}));
  const list = table([
    {head: "Source", cell: row => sourceBadge(row.index)},
    {head: "True place", unit: "east, north, m", number: true,
     cell: row => placeText(row.source.x_m, row.source.y_m)},
    {head: "Found at", unit: "east, north, m", number: true, title: row => sigmaText(row.estimate),
     cell: row => row.estimate ? placeText(row.estimate.x_m, row.estimate.y_m) :
         html("span", {class: "missed"}, "not found")},
    {head: "Distance", unit: "m", number: true, cell: row => fixed(row.nearest_m, 2),
     title: () => "to the nearest estimate"},
    {head: "True activity", number: true, cell: row => activity(row.source.activity_Bq)},
    {head: "Found activity", number: true, title: row => sigmaText(row.estimate),
     cell: row => row.estimate ? activity(row.estimate.activity_Bq) : "–"},
    {head: "Ratio", number: true, title: () => "found activity / true activity",
     cell: row => row.estimate ? (row.estimate.activity_Bq / row.source.activity_Bq).toFixed(2) : "–"},
  ], rows);
  list.append(html("tfoot", {}, html("tr", {}, falseCell(estimates.filter(estimate => estimate.found < 0)))));
  replace("sources", list);
}

/** The estimates that are no true source's, on one line, so that nothing moves when their number changes. */
function falseCell(estimates) {
  if (estimates.length === 0) return html("td", {colspan: 7}, "no false estimate");
  const texts = estimates.map(estimate => `${activity(estimate.activity_Bq)} at ${placeText(estimate.x_m, estimate.y_m)}`);
  const count = html("span", {class: "missed"}, `${estimates.length} false`);
  const cell = html("td", {colspan: 7, class: "one-line"}, count, `: ${texts.join("; ")}`);
  cell.title = texts.join("\n");
  return cell;
}

function sigmaText(estimate) {
  const detail = estimate && estimate.detail;
  if (!detail || detail.sigma_x_m === null) return "";
  return `standard deviations: east ${fixed(detail.sigma_x_m, 3)} m, north ${fixed(detail.sigma_y_m, 3)} m, ` +
      `activity ${activity(detail.activity_sigma_Bq)}; gain in log likelihood ${fixed(detail.significance, 1)}`;
}

function showReported(estimates) {
  replace("sources", mission.ticks.t_s.length === 0 ? "No estimate was recorded." : table([
    {head: "Source", cell: row => String(estimates.indexOf(row) + 1)},
    {head: "Place", unit: "east, north, m", number: true, cell: row => placeText(row.x_m, row.y_m)},
    {head: "Standard deviation", unit: "east, north, m", number: true,
     cell: row => row.detail && row.detail.sigma_x_m !== null ? placeText(row.detail.sigma_x_m, row.detail.sigma_y_m) : "–"},
    {head: "Activity", number: true,
     cell: row => plusMinus(row.activity_Bq, row.detail ? row.detail.activity_sigma_Bq : null, activity)},
    {head: "Significance", unit: "log likelihood", number: true, cell: row => row.detail ? fixed(row.detail.significance, 1) : "–"},
  ], estimates));
}

function showShares(mission) {
  const sum = kind => mission.drones.reduce((total, drone) => total + drone[kind], 0);
  const kinds = [["Singles", "singles"], ["Compton pairs", "pairs"], ["Others", "others"]];
  const total = kinds.reduce((all, [, kind]) => all + sum(kind), 0);
  replace("shares", table([
    {head: "", cell: ([name]) => name},
    {head: "Events", number: true, cell: ([, kind]) => whole(sum(kind))},
    {head: "Share", number: true, cell: ([, kind]) => total ? percent(sum(kind) / total, 1) : "–"},
    {head: "Published", number: true, title: () => "Werner 2024, flight with three drones",
     cell: ([, kind]) => percent(PUBLISHED_SHARES[kind], 1)},
  ], kinds));
}

function showDrones(mission) {
  const pose = row => row.pose;
  replace("drones", mission.drones.length === 0 ? "None recorded." : table([
    {head: "Drone", cell: row => droneBadge(mission, row.mav)},
    {head: "Live time", unit: "s", number: true, cell: row => fixed(row.live_s, 1)},
    {head: "Flown", unit: "m", number: true, cell: row => whole(row.distance_m)},
    {head: "Mean speed", unit: "m/s", number: true, cell: row => fixed(row.speed_mean_m_s, 2)},
    {head: "Singles", number: true, cell: row => whole(row.singles)},
    {head: "Pairs", number: true, cell: row => whole(row.pairs)},
    {head: "Others", number: true, cell: row => whole(row.others)},
    {head: "Batches", unit: "missing", number: true, cell: row => faultText(row.batches_missing),
     title: row => `${whole(row.batches)} received, ${whole(row.batches_repeated)} repeated`},
    {head: "Messages", unit: "refused", number: true, cell: row => faultText(row.refused)},
    {head: "Pose sigma", unit: "mean, m", number: true, cell: row => fixed(pose(row).sigma_mean_m, 2),
     title: row => `${whole(pose(row).messages)} poses, worst quality ${pose(row).quality_worst_percent ?? "–"} %, ` +
         plural(pose(row).resets, "reset")},
    {head: "Pose error", unit: "rms, m", number: true, cell: row => fixed(pose(row).error_rms_m, 2)},
    {head: "Nearest drone", unit: "least distance, m", number: true,
     cell: row => row.nearest ? fixed(row.nearest.distance_m, 1) : "–",
     title: row => row.nearest ? `to drone ${row.nearest.mav} at ${row.nearest.t_s} s` : ""},
    {head: "Battery", unit: "%", number: true, cell: row => row.vehicle ? fixed(row.vehicle.battery_percent, 0) : "–"},
    {head: "At the end", text: true, cell: row => row.vehicle ? vehicleText(row.vehicle) : "–"},
  ], mission.drones));
}

function vehicleText(vehicle) {
  const state = vehicle.connected ? `${vehicle.mode || "no mode"}, ${vehicle.armed ? "armed" : "disarmed"}` : "not connected";
  return vehicle.hold_reason ? `${state}, holds: ${vehicle.hold_reason}` : state;
}

function faultText(count) {
  return count > 0 ? html("span", {class: "missed"}, whole(count)) : "0";
}

function counterText(counters) {
  return Object.entries(counters).map(([name, value]) => `${name}\u00a0${whole(value)}`).join(", ");
}

function counterDetails(counters) {
  const n = Object.keys(counters).length;
  if (n === 0) return "–";
  return html("details", {}, html("summary", {}, plural(n, "counter")), html("p", {}, counterText(counters)));
}

function showDaemons(mission) {
  replace("daemons", mission.daemons.length === 0 ? "No STATUS message was recorded." : table([
    {head: "Daemon", cell: row => row.name},
    {head: "State", cell: row => row.state || "–"},
    {head: "Faults", text: true, cell: row => Object.keys(row.faults).length === 0 ? "none" :
        html("span", {class: "missed"}, counterText(row.faults))},
    {head: "Counters", text: true, cell: row => counterDetails(row.counters)},
    {head: "Version", cell: row => row.version || "–"},
  ], mission.daemons));
}

/** What was recorded, in sentences. */
function showRecording(mission) {
  const {recording, coordinator, map} = mission, sentences = [];
  sentences.push(`${whole(recording.messages)} messages read.`);
  const others = Object.entries(recording.others);
  const names = others.map(([channel, n]) => `${channel} (${whole(n)})`).join(", ");
  if (others.length) sentences.push(`Not part of this report: ${names}.`);
  if (map) {
    const kept = map.frames.length === map.recorded ? "all" : `${map.frames.length}, evenly chosen,`;
    sentences.push(`${plural(map.recorded, "map")} of ${map.size[0]} × ${map.size[1]} cells of ${map.cell_m} m; ` +
                   `${kept} in the replay, the last one with exact values.`);
  }
  if (coordinator) {
    const leader = coordinator.sender === 0 ? "the ground station" : `drone ${coordinator.sender}`;
    sentences.push(`At the end ${leader} led, term ${coordinator.term} (${plural(coordinator.terms, "term")} seen), with ` +
                   `${whole(coordinator.cones)} cones and ${whole(coordinator.viewpoints)} viewpoints in use.`);
  }
  replace("recording", sentences.join(" "));
}
