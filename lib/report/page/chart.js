// SPDX-License-Identifier: BSD-3-Clause
// Lines over mission time. All charts share the time of the page: they show it as a cursor, and a click sets it.

const charts = [];

function linearScale(low, high, from_px, to_px) {
  const scale = value => from_px + (value - low) / (high - low) * (to_px - from_px);
  const {steps, decimals} = niceSteps(low, high, 4);
  return Object.assign(scale, {ticks: steps.map(s => [s, s.toFixed(decimals)])});
}

function logScale(low, high, from_px, to_px) {
  const position = value => Math.log10(Math.max(value, low) / low) / Math.log10(high / low);
  const scale = value => from_px + position(value) * (to_px - from_px);
  const ticks = [];
  for (let power = Math.ceil(Math.log10(low) - 1e-9); 10 ** power <= high * 1.001; ++power) {
    ticks.push([10 ** power, power < 0 ? (10 ** power).toFixed(-power) : String(10 ** power)]);
  }
  return Object.assign(scale, {ticks});
}

/**
 * A chart in the element `id`. options: t_max, height, unit (of y), log ([low, high], else linear from 0 to high),
 * high, lines [{name, colour, width, t: [], y: [], step}], level {y, text}, decimals.
 */
function drawChart(id, options) {
  const box = document.getElementById(id);
  box.replaceChildren();
  const width = Math.max(200, box.clientWidth), height = options.height;
  const left = 36, right = options.labels ? 62 : 20, top = 16, bottom = 20;
  const x = linearScale(0, options.t_max, left, width - right);
  const y = options.log ? logScale(...options.log, height - bottom, top) :
      linearScale(0, options.high, height - bottom, top);
  const root = svg("svg", {width, height, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": options.name});
  drawAxes(root, options, x, y, {left, right: width - right, top, bottom: height - bottom});
  const cursor = svg("line", {y1: top, y2: height - bottom, stroke: "#1a1d21", "stroke-width": 1, opacity: 0.55});
  for (const line of options.lines) root.append(drawLine(line, x, y));
  if (options.labels) drawLabels(root, options.lines, y, width - right + 5, [top, height - bottom]);
  root.append(cursor);
  box.append(root);
  addPointer(root, options, {left, right: width - right});
  charts.push(t_s => { cursor.setAttribute("x1", x(t_s)); cursor.setAttribute("x2", x(t_s)); });
}

function drawAxes(root, options, x, y, area) {
  for (const [value, text] of y.ticks) {
    root.append(svg("line", {x1: area.left, x2: area.right, y1: y(value), y2: y(value), stroke: "#e4e7ea"}),
                svg("text", {x: area.left - 6, y: y(value) + 4, "text-anchor": "end", class: "axis"}, text));
  }
  x.ticks.forEach(([value, text], i) => {
    const last = i === x.ticks.length - 1;
    root.append(svg("text", {x: x(value), y: area.bottom + 15, "text-anchor": "middle", class: "axis"},
                    last ? `${text} s` : text));
  });
  root.append(svg("line", {x1: area.left, x2: area.right, y1: area.bottom, y2: area.bottom, stroke: "#5b626b"}),
              svg("text", {x: area.left - 6, y: 9, "text-anchor": "end", class: "axis"}, options.counts ? "" : options.unit));
  if (options.level) {
    const at = y(options.level.y);
    root.append(svg("line", {x1: area.left, x2: area.right, y1: at, y2: at, stroke: "#5b626b", "stroke-dasharray": "5 4"}),
                svg("text", {x: area.right - 4, y: at - 4, "text-anchor": "end", class: "axis halo"}, options.level.text));
  }
}

function drawLine(line, x, y) {
  const points = [];
  line.t.forEach((t_s, i) => {
    if (line.y[i] === null) return;
    if (line.step && points.length) points.push([x(t_s), points[points.length - 1][1]]);
    points.push([x(t_s), y(line.y[i])]);
  });
  return svg("path", {d: path(points), fill: "none", stroke: line.colour, "stroke-width": line.width || 1.6,
                      "stroke-linejoin": "round", "stroke-dasharray": line.dash || "none"});
}

/** Names at the lines' ends, moved apart so that none covers another, and back into the chart. */
function drawLabels(root, lines, y, x_px, [top, bottom]) {
  const gap = 13;
  const labels = lines.filter(line => line.y.some(value => value !== null)).map(
      line => ({line, at: y(line.y.filter(value => value !== null).at(-1))})).sort((a, b) => a.at - b.at);
  labels.forEach((label, i) => { label.at = Math.max(label.at, i ? labels[i - 1].at + gap : top); });
  for (let i = labels.length - 1; i >= 0; --i) {
    labels[i].at = Math.min(labels[i].at, i + 1 < labels.length ? labels[i + 1].at - gap : bottom);
  }
  for (const {line, at} of labels) {
    root.append(svg("text", {x: x_px, y: at + 4, style: `fill:${line.colour};font-weight:600`}, line.name));
  }
}

function addPointer(root, options, {left, right}) {
  const time = event => {
    const share = (event.clientX - root.getBoundingClientRect().left - left) / (right - left);
    return Math.min(1, Math.max(0, share)) * options.t_max;
  };
  root.style.cursor = "crosshair";
  root.addEventListener("click", event => setTime(time(event)));
  root.addEventListener("pointerleave", tip.hide);
  root.addEventListener("pointermove", event => {
    const t_s = time(event);
    const rows = options.lines.map(line => {
      const i = lastNotAbove(line.t, t_s);
      return i < 0 || line.y[i] === null ? null : `${line.name}: ${line.y[i].toFixed(options.decimals)} ${options.unit}`;
    });
    tip.show(event, [`${t_s.toFixed(0)} s`, ...rows.filter(row => row)].join("\n"));
  });
}
